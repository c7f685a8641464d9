"""A quantity over one key, a line a run; a second, short one gives panels or lines."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.figures.axes import parts
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import GREY, LineStyle, figure_legend, run_styles
from contactstudy.plot.text import capital, label, number
from contactstudy.study.axes.axis import AxisOf, axis_of
from contactstudy.study.axes.shown import RUN, Shown
from contactstudy.study.kind import Marks

FEW = 4
"""Values of a second key for which there are panels or lines."""
_TOLD = 4  # lines whose smallest and largest values an abstract places
_MARKED = (("Dashed", (0, (4, 2))), ("Dotted", (0, (1, 2))))
MarksOf = Callable[[str], Sequence[Marks]]
"""What is marked along a key."""


def drawings(quantity: Shown, free: list[str], marks: MarksOf) -> list[Drawing]:
    """One figure."""
    long, *short = sorted(free, key=lambda dim: -quantity.data.sizes[dim])
    marked = _marked(quantity, long, marks)
    caption = _caption(quantity, long)
    for mark in marked:
        told = ", ".join(number(v, 3) for v in mark.at)
        caption += f" {_style_of(marked, mark)[0]}: {mark.caption}: {told}."
    draw = partial(_draw, quantity, long, short, marked)
    return [Drawing(quantity.file, caption, draw, _found(quantity, long, short))]


def _style_of(marked: list[Marks], mark: Marks) -> tuple[str, Any]:
    return _MARKED[marked.index(mark) % len(_MARKED)]


def _marked(quantity: Shown, long: str, marks: MarksOf) -> list[Marks]:
    """Those of the marks along a key that lie in the figure, in the axis's unit."""
    along = axis_of(quantity.data, long)
    if long not in quantity.data.coords or not along.numeric:
        return []
    values = np.asarray(quantity.data[long].values, dtype=float)
    factor = along.at[-1] / values[-1] if values[-1] else 1.0
    low, high = along.at.min(), along.at.max()
    found = []
    for mark in marks(long):
        inside = [factor * v for v in mark.at if low <= factor * v <= high]
        if inside:
            found.append(replace(mark, at=inside))
    return found


def _curves(
    quantity: Shown, long: str, short: list[str]
) -> dict[tuple[str, str], tuple[Array, Array]]:
    """(panel, line) -> values and half their confidence intervals along the long key."""
    over, found = parts.samples_of(quantity), {}
    names = axis_of(quantity.data, short[0]).names if short else ("",)
    for run in quantity.runs:
        mean, half = parts.averaged(quantity.of_run(run), over)
        mean = mean.transpose(*short, long)
        dims = [d for d in quantity.of_run(run).dims if d not in over]
        half = half.transpose([dims.index(d) for d in (*short, long)])
        rows = zip(np.atleast_2d(mean.values), np.atleast_2d(half), names, strict=True)
        for values, width, name in rows:
            place = ("", name) if len(quantity.runs) == 1 else (name, label(run))
            found[place] = values, width
    return found


def _draw(quantity: Shown, long: str, short: list[str], marked: list[Marks]) -> Figure:
    curves, along = _curves(quantity, long, short), axis_of(quantity.data, long)
    panels = list(dict.fromkeys(panel for panel, _ in curves))
    lines = list(dict.fromkeys(line for _, line in curves))
    of_runs = {label(run): style for run, style in parts.styles(quantity).items()}
    styles = of_runs if set(lines) <= set(of_runs) else run_styles(lines, None)
    figure, grid = parts.panels(len(panels), 2, (2.1, 0.6))
    logarithmic = parts.wide(np.concatenate([v for v, _ in curves.values()]))
    holes = along.at[parts.failed(quantity, [long])]
    for axes, panel in zip(grid.flat, panels, strict=False):
        for line in lines:
            _line(axes, along, *curves[panel, line], styles[line], line)
        parts.mark_failed(axes, holes)
        for mark in marked:
            _, style = _style_of(marked, mark)
            for k, at in enumerate(mark.at):
                axes.axvline(at, color=GREY, lw=0.8, ls=style, label=None if k else mark.name)
        parts.label_axis(axes, along, "x")
        axes.set_title(panel)
        axes.set_yscale("log" if logarithmic else "linear")
    figure.supylabel(quantity.title, fontsize=9)
    figure_legend(figure, grid.flat[0])
    return figure


def _line(
    axes: Axes, along: AxisOf, values: Array, half: Array, style: LineStyle, name: str
) -> None:
    order = np.argsort(along.at)
    x, y, width = along.at[order], values[order], half[order]
    marks: dict[str, Any] = {"marker": style.marker, "ms": 3.5, "mfc": "none"}
    look: dict[str, Any] = style.line if along.numeric else {"color": style.color, "ls": "none"}
    axes.plot(x, y, label=name or None, **look, **marks)
    if np.any(width > 0.0):
        axes.fill_between(x, y - width, y + width, color=style.color, alpha=0.18, lw=0)


def _head(quantity: Shown, long: str) -> str:
    text = f"{capital(quantity.title)} over the {axis_of(quantity.data, long).title}"
    if RUN in quantity.values.dims and len(quantity.runs) == 1:
        text += f", run {label(quantity.runs[0])}"
    return text


def _caption(quantity: Shown, long: str) -> str:
    text = f"{_head(quantity, long)}."
    if over := parts.samples_of(quantity):
        n = int(np.prod([quantity.data.sizes[d] for d in over]))
        text += f" Means of {n} samples, shaded: 95 % confidence interval of the mean."
    if parts.failed(quantity, [long]).any():
        text += " Crosses: variants that could not be computed."
    return text


def _found(quantity: Shown, long: str, short: list[str]) -> str:
    along, curves = axis_of(quantity.data, long), _curves(quantity, long, short)
    one_panel = len({panel for panel, _ in curves}) == 1 and len(curves) > 1
    if len(curves) > _TOLD:  # of each line all panels together
        lines: dict[str, list[Array]] = {}
        for (_, line), (values, _half) in curves.items():
            lines.setdefault(line, []).append(values)
        told = [f"{line} {parts.ends(np.concatenate(v), None)}" for line, v in lines.items()]
        return f"{_head(quantity, long)}: {'; '.join(told)}."
    told = [
        f"{', '.join(place[one_panel:]).removeprefix(', ')} {parts.ends(values, along.names)}"
        for place, (values, _half) in curves.items()
    ]
    return f"{_head(quantity, long)}: {'; '.join(told).strip(', ')}."

"""Convergence: distance from Richardson's limit over the size, with the observed order."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contactstudy.figures.axes import parts
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import TEXT_WIDTH, LineStyle, figure_legend, new_figure, run_styles
from contactstudy.plot.text import label, number
from contactstudy.study.axes.axis import axis_of, title_of
from contactstudy.study.axes.convergences import Line, convergences
from contactstudy.study.axes.refinement import sizes
from contactstudy.study.axes.shown import Shown

_LINES = 8


def drawings(quantities: Sequence[Shown]) -> list[Drawing]:
    """One figure of what changes along a design's refined key, with a panel a quantity.

    Where there are differences from the finest, of these alone.
    """
    if any("from_finest" in q.data for q in quantities):
        quantities = [q for q in quantities if q.quantity.variable == "from_finest"]
    found = [(q, lines) for q in quantities if (lines := convergences(q))]
    if not found:
        return []
    names = {line.name for line in sorted(found[0][1], key=_band, reverse=True)[:_LINES]}
    shown = [(q, [line for line in lines if line.name in names]) for q, lines in found]
    caption = _caption(found[0][0], len(found[0][1]))
    name = f"{found[0][0].data.attrs['design']}_convergence".replace(".", "_")
    return [Drawing(name, caption, lambda: _draw(shown))]


def _band(line: Line) -> float:
    return line.uncertainty if np.isfinite(line.uncertainty) else np.inf


def _draw(shown: Sequence[tuple[Shown, list[Line]]]) -> Figure:
    rows = -(-len(shown) // 2)
    width = TEXT_WIDTH if len(shown) > 1 else 5.4
    figure = new_figure(0.6 + 2.3 * rows, width)
    grid = figure.subplots(rows, min(len(shown), 2), squeeze=False)
    for axes in grid.flat[len(shown) :]:
        axes.set_visible(False)
    names = list(dict.fromkeys(line.name for _, lines in shown for line in lines))
    of_runs = {label(run): style for run, style in parts.styles(shown[0][0]).items()}
    styles = of_runs if set(names) <= set(of_runs) else run_styles(names, None)
    for axes, (quantity, lines) in zip(grid.flat, shown, strict=False):
        _panel(axes, quantity, lines, styles)
    for axes in grid[:, 0]:
        axes.set_ylabel("Distance from the limit")
    figure_legend(figure, max(grid.flat, key=lambda axes: len(axes.lines)))
    return figure


def _panel(axes: Axes, quantity: Shown, lines: list[Line], styles: dict[str, LineStyle]) -> None:
    along = axis_of(quantity.data, quantity.data.attrs["refined"])
    h = sizes(along.at)
    for line in lines:
        style, known = styles[line.name], np.isfinite(line.limit)
        error = np.abs(line.values - (line.limit if known else line.values[-1]))
        good = error > 0.0
        marks: dict[str, Any] = {"marker": style.marker, "ms": 4, "mfc": "none", "ls": "none"}
        axes.plot(h[good], error[good], color=style.color, label=line.name or None, **marks)
        if known and good.any():
            # log e = log C + p log h, p that of the fit
            fine = np.geomspace(h.min(), h.max(), 30)
            gain = np.exp(np.mean(np.log(error[good]) - line.order * np.log(h[good])))
            axes.plot(fine, gain * fine**line.order, **style.line)
    title = textwrap.fill(quantity.title, 34)
    axes.set(xscale="log", yscale="log", title=title)
    axes.set_xticks(h.tolist(), [name.partition(" ")[0] for name in along.names])
    axes.set_xticks([], minor=True)
    inverse = along.at[0] < along.at[-1]
    text = f"{along.title}, placed at the inverse" if inverse else along.title
    axes.set_xlabel(textwrap.fill(text, 40))


def _caption(quantity: Shown, lines: int) -> str:
    expected = quantity.data.attrs.get("expected_order")
    text = (
        f"Refinement of the {title_of(quantity.data.attrs['refined'])}: distance of the quantity "
        "from its limit (where there is no order, from the finest), and lines of the fitted order."
    )
    if lines > _LINES:
        text += f" Drawn are the {_LINES} of {lines} with the widest band at the finest."
    return text + (f" Expected order {number(expected, 2)}." if expected else "")

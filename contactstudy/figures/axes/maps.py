"""A quantity over two keys as a map with contours; over three, a panel a value of the shortest."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.figures.axes import parts
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, GREY
from contactstudy.plot.text import capital, label, number
from contactstudy.study.axes.axis import AxisOf, axis_of
from contactstudy.study.axes.effects import PANELS
from contactstudy.study.axes.shown import Shown

_LEVELS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)


@dataclass(frozen=True)
class Panel:
    """One map: values (ny, nx), and where variants failed."""

    title: str
    values: Array
    failed: Any


def drawings(quantity: Shown, free: list[str]) -> list[Drawing]:
    """A panel a run; of three keys a figure a run, with a panel a value of the shortest."""
    y, x, *third = sorted(free, key=lambda dim: -quantity.data.sizes[dim])
    x, y = (x, y) if quantity.axes.index(x) > quantity.axes.index(y) else (y, x)
    made = []
    if not third:
        panels = [_panel(quantity, run, x, y, {}, label(run)) for run in quantity.runs]
        for k in range(0, len(panels), PANELS):
            made.append(_drawing(quantity, x, y, panels[k : k + PANELS], ""))
    for run in quantity.runs if third else ():
        names = axis_of(quantity.data, third[0]).names[:PANELS]
        panels = [_panel(quantity, run, x, y, {third[0]: k}, name) for k, name in enumerate(names)]
        made.append(_drawing(quantity, x, y, panels, run))
    return made


def _panel(quantity: Shown, run: str, x: str, y: str, at: dict[str, int], title: str) -> Panel:
    over = parts.samples_of(quantity)
    mean = quantity.of_run(run).isel(at).mean(over)
    holes = parts.failed(quantity, [*at, y, x])
    return Panel(title, mean.transpose(y, x).values, holes[tuple(at.values())])


def _drawing(quantity: Shown, x: str, y: str, panels: list[Panel], run: str) -> Drawing:
    along, up = axis_of(quantity.data, x), axis_of(quantity.data, y)
    told = [f"{p.title} {_ends(p.values, along, up)}".strip() for p in panels]
    head = f"{capital(quantity.title)} over {along.title} and {up.title}"
    head += f", run {label(run)}" if run else ""
    text = f"{head}."
    if any(p.failed.any() for p in panels):
        text += " Hatched: variants that could not be computed."
    name = f"{quantity.file}_{run}" if run else quantity.file
    draw = partial(_draw, quantity, along, up, panels)
    return Drawing(name, text, draw, f"{head}: {'; '.join(told)}.")


def _ends(values: Array, along: AxisOf, up: AxisOf) -> str:
    names = tuple(f"{b}, {a}" for b in up.names for a in along.names)
    return parts.ends(values.ravel(), names)


def _draw(quantity: Shown, along: AxisOf, up: AxisOf, panels: list[Panel]) -> Figure:
    figure, grid = parts.panels(len(panels), 3 if len(panels) > 4 else 2, (2.4, 0.5))
    every = np.concatenate([p.values.ravel() for p in panels])
    there = every[np.isfinite(every)]
    log = parts.wide(every)
    norm: Normalize = (LogNorm if log else Normalize)(there.min(), there.max())
    mesh, x, y = None, edges(along), edges(up)
    for axes, panel in zip(grid.flat, panels, strict=False):
        mesh = axes.pcolormesh(x, y, panel.values, norm=norm, cmap="viridis_r", rasterized=True)
        _contours(axes, along, up, panel.values, log)
        hatch(axes, x, y, panel.failed)
        parts.label_axis(axes, along, "x")
        parts.label_axis(axes, up, "y")
        axes.label_outer()
        axes.grid(False)
        axes.set_title(panel.title)
    if mesh is not None:
        figure.colorbar(mesh, ax=grid.ravel().tolist(), label=quantity.title)
    return figure


def edges(along: AxisOf, logarithmic: bool | None = None) -> Array:
    """Edges (n + 1,) of cells about the values, half way (of logarithms on such an axis)."""
    log = along.logarithmic if logarithmic is None else logarithmic
    at = np.log(along.at) if log else along.at
    if len(at) == 1:
        return np.array([at[0] - 0.5, at[0] + 0.5])
    middle = 0.5 * (at[1:] + at[:-1])
    found = np.concatenate([[2 * at[0] - middle[0]], middle, [2 * at[-1] - middle[-1]]])
    return np.exp(found) if log else found


def _contours(axes: Axes, along: AxisOf, up: AxisOf, values: Array, log: bool) -> None:
    there = values[np.isfinite(values)]
    if min(values.shape) < 3 or not len(there) or np.ptp(there) == 0.0:
        return
    levels = [v for v in _LEVELS if there.min() < v < there.max()] if log else None
    if log and not levels:
        return
    lines = axes.contour(
        along.at,
        up.at,
        np.ma.masked_invalid(values),
        levels=levels or 6,
        colors=BLACK,
        linewidths=0.6,
    )
    axes.clabel(lines, fontsize=7, fmt=lambda v: number(v, 2))


def hatch(axes: Axes, x: Array, y: Array, where: Any) -> None:
    """Hatch the cells (ny, nx) of a map that are marked, between edges x (nx + 1,), y (ny + 1,)."""
    if where.any():
        holes = np.ma.masked_where(~where, np.ones(where.shape))
        axes.pcolor(x, y, holes, facecolor="none", hatch="////", edgecolor=GREY, lw=0)

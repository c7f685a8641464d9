"""What the figures of axes share: labels of axes, marks of what failed, means over samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.compare.statistics import spread
from contactstudy.plot.style import BLACK, TEXT_WIDTH, LineStyle, new_figure, run_styles
from contactstudy.plot.text import number
from contactstudy.study.axes.axis import AxisOf
from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.shown import Shown, drawn

if TYPE_CHECKING:
    import xarray as xr

WIDE = 20.0
"""Ratio of the largest to the smallest value from which a scale is logarithmic."""


def panels(
    number: int, beside: int, height: tuple[float, float], sharex: bool = True
) -> tuple[Figure, Any]:
    """Figure with a grid of panels, so many beside each other at most; those left over are hidden.

    Height of a row, and what comes to all rows, in inch. All have one scale, but for x if that is
    not shared.
    """
    columns = min(beside, number)
    rows = -(-number // columns)
    figure = new_figure(height[1] + height[0] * rows, 5.4 if columns == 1 else TEXT_WIDTH)
    grid = figure.subplots(rows, columns, sharex=sharex, sharey=True, squeeze=False)
    for axes in grid.flat[number:]:
        axes.set_visible(False)
    return figure, grid


def label_axis(axes: Axes, along: AxisOf, which: str) -> None:
    """Title, scale and ticks of the axis "x" or "y"."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    axis.set_label_text(along.title)
    if along.logarithmic:
        (axes.set_xscale if which == "x" else axes.set_yscale)("log")
    elif not along.numeric or len(along.at) <= 6:
        names = along.names if not along.numeric else [f"{v:g}" for v in along.at]
        axis.set_ticks(along.at.tolist(), list(names))


def wide(values: Array) -> bool:
    """Whether positive values ask for a logarithmic scale."""
    there = values[np.isfinite(values)]
    return bool(len(there) and there.min() > 0.0 and there.max() > WIDE * there.min())


def styles(quantity: Shown) -> dict[str, LineStyle]:
    """Line style of each run, the same for all quantities of a design."""
    all_runs = [str(run) for run in quantity.data["run"].values] if "run" in quantity.data else []
    known = run_styles(all_runs, quantity.reference)
    return {run: known.get(run) or run_styles([run], None)[run] for run in quantity.runs}


def samples_of(quantity: Shown) -> list[str]:
    """Dimensions that are samples."""
    return [dim for dim in quantity.axes if drawn(quantity.data, dim)]


def averaged(values: xr.DataArray, over: list[str]) -> tuple[xr.DataArray, Array]:
    """Mean over samples, and half its confidence interval (zero without samples)."""
    if not over:
        return values, np.zeros(values.shape)
    kept = values.transpose(..., *over)
    shape = kept.shape[: -len(over)]
    rows = kept.values.reshape(*shape, -1)
    found = np.array([spread(rows[i]).half_width for i in np.ndindex(shape)]).reshape(shape)
    return values.mean(over), found


def failed(quantity: Shown, free: list[str]) -> Array:
    """Where any variant failed, as an array in the free dimensions."""
    hole = quantity.data[FAILURE] != ""
    others = [d for d in hole.dims if d not in free]
    return np.asarray(hole.any(others).transpose(*free).values)


def mark_failed(axes: Axes, at: Array) -> None:
    """Crosses on the lower edge where variants failed."""
    if len(at):
        low = np.full(len(at), 0.03)
        axes.plot(
            at, low, "x", color=BLACK, ms=5, transform=axes.get_xaxis_transform(), label="failed"
        )


def ends(values: Array, names: tuple[str, ...] | None) -> str:
    """Smallest and largest of values (n,), and where they are if the places have names."""
    there = np.flatnonzero(np.isfinite(values))
    if not len(there):
        return "nowhere"
    low, high = there[np.argmin(values[there])], there[np.argmax(values[there])]
    if names is None:
        return " to ".join(dict.fromkeys(number(values[k]) for k in (low, high)))
    if low == high:
        return f"{number(values[low])} at {names[low]}"
    return f"{number(values[low])} (at {names[low]}) to {number(values[high])} (at {names[high]})"

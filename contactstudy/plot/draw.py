"""Draw curves that are given as data, in the one style."""

import math
from collections.abc import Sequence
from dataclasses import replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contactstudy.plot.curves import Plot
from contactstudy.plot.style import REFERENCE_STYLE, figure_legend, new_figure, run_styles
from contactstudy.plot.text import tick

_LEVELS = 9
"""So many values of an abscissa at most are its ticks, if they are short."""


def draw(plot: Plot) -> Figure:
    """One pair of axes; to be called within `contactstudy.plot.style.figure_style`."""
    figure = new_figure(3.1, 5.4)
    axes = figure.add_subplot()
    _draw(axes, plot)
    figure_legend(figure, axes)
    return figure


def draw_pairs(plots: Sequence[Plot]) -> Figure:
    """Two panels a row, all over one abscissa and with the curves of the first."""
    rows = -(-len(plots) // 2)
    figure = new_figure(0.6 + 1.8 * rows)
    grid = figure.subplots(rows, 2, sharex=True, squeeze=False)
    for axes, plot in zip(grid.flat, plots, strict=True):
        _draw(axes, plot)
    for axes in grid[:-1].flat:
        axes.set_xlabel("")
    figure_legend(figure, grid[0, 0])
    return figure


def _draw(axes: Axes, plot: Plot) -> None:
    labels = [c.label for c in plot.curves if c.style != "reference"]
    styles = run_styles(labels, None)
    black = run_styles([c.label for c in plot.curves if c.style == "reference"], None)
    for label, style in black.items():  # dashes tell several of them apart
        styles[label] = replace(REFERENCE_STYLE, linestyle=style.linestyle)
    for c in plot.curves:
        style = styles[c.label]
        line = style.line | {"label": c.label}
        if c.style == "points":
            line |= {"linestyle": "none"}
        if c.style in ("points", "both"):
            line |= {"marker": style.marker, "markersize": 4, "markerfacecolor": "none"}
        axes.plot(c.x, c.y, **line)
    axes.set(xscale=plot.x_scale, yscale=plot.y_scale, xlabel=plot.x_label, ylabel=plot.y_label)
    levels = sorted({x for c in plot.curves for x in c.x})
    short = all(math.isclose(x, float(f"{x:.3g}")) for x in levels)
    if plot.x_scale == "log" and short and len(levels) <= _LEVELS:
        axes.set_xticks(levels, [tick(x) for x in levels])
        axes.set_xticks([], minor=True)

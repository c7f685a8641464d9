"""Convergence: distance from Richardson's limit over the size, with the observed order."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import figure_legend, new_figure, run_styles
from contactstudy.plot.text import number
from contactstudy.study.axes.axis import axis_of, title_of
from contactstudy.study.axes.convergences import Line, convergences
from contactstudy.study.axes.refinement import sizes
from contactstudy.study.axes.shown import Shown

_LINES = 8


def drawings(quantity: Shown) -> list[Drawing]:
    """One figure of what changes along the refined key."""
    if "from_finest" in quantity.data and quantity.quantity.variable != "from_finest":
        return []
    lines = convergences(quantity)[:_LINES]
    if not lines:
        return []
    return [Drawing(quantity.file, _caption(quantity), lambda: _draw(quantity, lines))]


def _draw(quantity: Shown, lines: list[Line]) -> Figure:
    figure = new_figure(3.4, 5.4)
    axes = figure.add_subplot()
    along = axis_of(quantity.data, quantity.data.attrs["refined"])
    h = sizes(along.at)
    styles = run_styles([line.name for line in lines], None)
    for line in lines:
        style, known = styles[line.name], np.isfinite(line.limit)
        error = np.abs(line.values - (line.limit if known else line.values[-1]))
        good = error > 0.0
        text = f"{line.name}: {line.order_text}" if line.name else line.order_text
        marks: dict[str, Any] = {"marker": style.marker, "ms": 4, "mfc": "none", "ls": "none"}
        axes.plot(h[good], error[good], color=style.color, label=text, **marks)
        if known and good.any():
            # log e = log C + p log h, p that of the fit
            fine = np.geomspace(h.min(), h.max(), 30)
            gain = np.exp(np.mean(np.log(error[good]) - line.order * np.log(h[good])))
            axes.plot(fine, gain * fine**line.order, **style.line)
    axes.set(xscale="log", yscale="log", ylabel="Distance from the limit", title=quantity.title)
    axes.set_xticks(h.tolist(), [name.partition(" ")[0] for name in along.names])
    axes.set_xticks([], minor=True)
    inverse = along.at[0] < along.at[-1]
    axes.set_xlabel(f"{along.title}, placed at the inverse" if inverse else along.title)
    figure_legend(figure, axes)
    return figure


def _caption(quantity: Shown) -> str:
    expected = quantity.data.attrs.get("expected_order")
    text = (
        f"Refinement of the {title_of(quantity.data.attrs['refined'])}: distance of the quantity "
        "from its limit (where there is no order, from the finest), and lines of the fitted order."
    )
    return text + (f" Expected order {number(expected, 2)}." if expected else "")

"""The distribution of a quantity over a sample, and how its mean levels off as the sample grows."""

from __future__ import annotations

from functools import partial

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from contactstudy.arrays import Array
from contactstudy.compare.statistics import running, spread
from contactstudy.figures.axes import parts
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import figure_legend, new_figure
from contactstudy.plot.text import capital, label, number, resolved
from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.shown import Shown


def drawings(quantity: Shown) -> list[Drawing]:
    """One figure for a sample of two or more."""
    if quantity.data["variant"].size < 2:
        return []
    draw = partial(_draw, quantity)
    return [Drawing(quantity.file, _caption(quantity), draw, _found(quantity))]


def _caption(quantity: Shown) -> str:
    text = (
        f"{_head(quantity)}: left, the share of the sample up to each value; right, the mean of "
        "the first n with its 95 % confidence interval (Student)."
    )
    lost = int((quantity.data[FAILURE] != "").sum())
    return text + (f" {lost} of the variants could not be computed." if lost else "")


def _found(quantity: Shown) -> str:
    told = [f"{label(run)} {_range(quantity.of_run(run).values)}".strip() for run in quantity.runs]
    return f"{_head(quantity)}: {'; '.join(told)}."


def _head(quantity: Shown) -> str:
    return f"{capital(quantity.title)} in a sample of {quantity.data['variant'].size}"


def _range(values: Array) -> str:
    s = spread(values)
    if s.constant:
        return f"{number(s.mean, 4)} throughout"
    mean, low, high = (resolved(v, s.half_width) for v in (s.mean, s.low, s.high))
    return f"mean {mean} ± {number(s.half_width, 2)}, from {low} to {high}"


def _draw(quantity: Shown) -> Figure:
    figure = new_figure(2.6)
    left, right = figure.subplots(1, 2)
    every = quantity.values.values
    for run, style in parts.styles(quantity).items():
        values = quantity.of_run(run).values.ravel()
        ordered = np.sort(values[np.isfinite(values)])
        share = np.arange(len(ordered) + 1) / len(ordered)
        left.step(
            np.r_[ordered[:1], ordered], share, where="post", label=label(run) or None, **style.line
        )
        n, mean, half = running(values)
        right.plot(n, mean, **style.line)
        right.fill_between(n, mean - half, mean + half, color=style.color, alpha=0.18, lw=0)
    if parts.wide(every):
        left.set_xscale("log")
        right.set_yscale("log")
    low, high = np.nanmin(every), np.nanmax(every)
    margin = 0.08 * (high - low) or 1.0
    if not parts.wide(every):
        right.set_ylim(low - margin, high + margin)
    left.set(xlabel=quantity.title, ylabel="Share of the sample", ylim=(0, 1))
    _, unit = quantity.quantity_and_unit
    right.set(xlabel="Number of samples", ylabel=f"Mean ({unit})" if unit else "Mean")
    right.xaxis.set_major_locator(MaxNLocator(integer=True))
    figure_legend(figure, left)
    return figure

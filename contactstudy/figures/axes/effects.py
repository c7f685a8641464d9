"""A quantity over many keys: what each of them changes, whatever the others are."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from contactstudy.figures.axes import parts
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import figure_legend
from contactstudy.plot.text import capital, label, number
from contactstudy.study.axes.axis import axis_of, title_of
from contactstudy.study.axes.effects import SHARE, Effect, effects
from contactstudy.study.axes.shown import Shown


def drawings(quantity: Shown, free: list[str]) -> list[Drawing]:
    """One figure with a panel a key."""
    found = {run: effects(quantity, run, free) for run in quantity.runs}
    draw = partial(_draw, quantity, free, found)
    seen = _found(quantity, free, found)
    return [Drawing(quantity.file, _caption(quantity, free), draw, seen)]


def _draw(quantity: Shown, free: list[str], found: dict[str, dict[str, Effect]]) -> Figure:
    figure, grid = parts.panels(len(free), 2, (2.3, 0.7), sharex=False)
    logarithmic = parts.wide(quantity.values.values)
    styles = parts.styles(quantity)
    for axes, key in zip(grid.flat, free, strict=False):
        along = axis_of(quantity.data, key)
        order = np.argsort(along.at)
        for run, style in styles.items():
            effect = found[run][key]
            marks: dict[str, Any] = {"marker": style.marker, "ms": 3.5, "mfc": "none"}
            look: dict[str, Any] = style.line if along.numeric else {"color": style.color, "ls": ""}
            axes.plot(along.at[order], effect.median[order], label=label(run), **look, **marks)
            for edge in (effect.low, effect.high):
                edges: dict[str, Any] = (
                    {"lw": 0.4, "ls": ":"} if along.numeric else {"ls": "", "marker": "_"}
                )
                axes.plot(along.at[order], edge[order], color=style.color, **edges)
        parts.mark_failed(axes, along.at[parts.failed(quantity, [key])])
        parts.label_axis(axes, along, "x")
        axes.set_yscale("log" if logarithmic else "linear")
    figure.supylabel(quantity.title, fontsize=9)
    figure_legend(figure, grid.flat[0])
    return figure


def _caption(quantity: Shown, free: list[str]) -> str:
    text = (
        f"{capital(quantity.title)} over {len(free)} keys, one a panel: at each of its values the "
        f"median over all values of the other keys, dotted the range of {100 * SHARE:g} % of them. "
        "Effects of two keys together are not seen."
    )
    if parts.failed(quantity, [free[0]]).any():
        text += " Crosses: values at which variants could not be computed, which are left out."
    return text


def _found(quantity: Shown, free: list[str], found: dict[str, dict[str, Effect]]) -> str:
    told = []
    for run in quantity.runs:
        ranked = sorted(free, key=lambda key: found[run][key].change, reverse=True)
        changes = [f"{title_of(k)} {number(found[run][k].change)}" for k in ranked]
        told.append(f"{label(run)} {', '.join(changes)}".strip())
    return (
        f"{capital(quantity.title)}, by how much its median changes over the values of each key: "
        f"{'; '.join(told)}."
    )

"""What a figure shows as plain data: for a page on which it can be zoomed and values be read.

Whatever draws with matplotlib is understood here once, from what lies on its axes; so no figure is
drawn by two pieces of code.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.ticker import FixedLocator

from contactstudy.plot.looks import Shape, UnknownShapeError, key_of
from contactstudy.plot.shapes import shapes_of

_LOWERED = str.maketrans("rv0123456789", "ᵣᵥ₀₁₂₃₄₅₆₇₈₉")
_INCH = 96.0
"""Pixels of a page for an inch."""


@dataclass(frozen=True)
class Scale:
    """One axis of a panel; `ticks` are places with their texts, None for round numbers."""

    label: str
    low: float
    high: float
    logarithmic: bool
    ticks: tuple[tuple[float, str], ...] | None = None


@dataclass(frozen=True)
class Panel:
    """One pair of axes.

    Attributes
    ----------
    place : (4,) tuple of int
        First row, first column, number of rows and of columns in the figure's grid.
    height : float
        Of the drawn area, CSS pixels.
    above : tuple of (float, str)
        Ticks of a second scale on top, at places of the first; `above_label` is its name.
    shares : (2,) tuple of int
        The panels whose range along x and along y is also this one's.
    """

    title: str
    x: Scale
    y: Scale
    place: tuple[int, int, int, int]
    height: float
    equal: bool
    above: tuple[tuple[float, str], ...]
    above_label: str
    shares: tuple[int, int]
    shapes: tuple[Shape, ...]


@dataclass(frozen=True)
class Panels:
    """A figure: its panels, and the legend's entries, each with the look of its line."""

    panels: tuple[Panel, ...]
    legend: tuple[Shape, ...] = field(default=())


def panels_of(figure: Figure) -> Panels | None:
    """The panels of a figure that is laid out; None where something is no curve, area or map."""
    bars = {m.colorbar.ax for axes in figure.axes for m in axes.collections if m.colorbar}
    shown = [axes for axes in figure.axes if axes not in bars and axes.get_visible()]
    common = _entries(*figure.legends)
    legends = [common | _entries(axes.get_legend()) for axes in shown]
    try:
        made = [_panel(figure, a, shown, own) for a, own in zip(shown, legends, strict=True)]
    except UnknownShapeError:
        return None
    entries = {e["label"]: e for legend in (common, *legends) for e in legend.values()}
    return Panels(tuple(made), tuple(entries.values())) if made else None


def _panel(figure: Figure, axes: Axes, shown: list[Axes], legend: dict[Any, Shape]) -> Panel:
    spec = axes.get_subplotspec()
    if spec is None or not axes.axison:
        raise UnknownShapeError("axes without a place, or without a scale: a picture")
    rows, columns = spec.rowspan, spec.colspan
    x_like = [a for a in shown if a is axes or axes.get_shared_x_axes().joined(axes, a)]
    y_like = [a for a in shown if a is axes or axes.get_shared_y_axes().joined(axes, a)]
    above, above_label = _above(axes)
    size = axes.get_position().height * figure.get_size_inches()[1]
    return Panel(
        axes.get_title() or axes.get_title("left"),
        _scale(axes.xaxis, axes.get_xlim(), figure.get_supxlabel(), [a.xaxis for a in x_like]),
        _scale(axes.yaxis, axes.get_ylim(), figure.get_supylabel(), [a.yaxis for a in y_like]),
        (rows.start, columns.start, len(rows), len(columns)),
        float(_INCH * size),
        axes.get_aspect() != "auto",
        above,
        above_label,
        (shown.index(x_like[0]), shown.index(y_like[0])),
        tuple(shapes_of(axes, legend)),
    )


def _scale(axis: Axis, limits: tuple[float, float], common: str, like: list[Axis]) -> Scale:
    """One axis; inner ones of a grid are named as the outer ones that have their range."""
    name = next((name for a in (axis, *like) if (name := a.get_label_text())), "")
    text = _plain(" · ".join(part for part in (name, common) if part))
    low, high = (float(v) for v in limits)
    scale = axis.get_scale()
    if scale not in ("linear", "log"):
        raise UnknownShapeError(f"scale {scale}")
    given = isinstance(axis.get_major_locator(), FixedLocator)
    ticks = _ticks(axis, min(low, high), max(low, high)) if given else None
    return Scale(text, low, high, scale == "log", ticks)


def _ticks(axis: Axis, low: float, high: float) -> tuple[tuple[float, str], ...]:
    at = [float(v) for v in axis.get_majorticklocs()]
    texts = axis.get_major_formatter().format_ticks(at)
    return tuple((v, t) for v, t in zip(at, texts, strict=True) if low <= v <= high)


def _above(axes: Axes) -> tuple[tuple[tuple[float, str], ...], str]:
    """Ticks of a second scale along x, at the places of the first, and its name."""
    if not axes.child_axes:
        return (), ""
    second = axes.child_axes[0]
    low, high = sorted(second.get_xlim())
    to_first = second.transData - axes.transData
    return (
        tuple(
            (float(to_first.transform((at, 0.0))[0]), text)
            for at, text in _ticks(second.xaxis, low, high)
        ),
        _plain(second.get_xlabel()),
    )


def _entries(*legends: Legend | None) -> dict[Any, Shape]:
    """Entries of legends by the look of their lines."""
    found: dict[Any, Shape] = {}
    for legend in filter(None, legends):
        for handle, text in zip(legend.legend_handles, legend.get_texts(), strict=True):
            if (key := key_of(handle)) is not None:
                found[key] = {"label": text.get_text(), **dict(key)}
    return found


def _plain(text: str) -> str:
    """A label on one line, without the markup of formulas: "PSD $G_{rr}$" as "PSD Gᵣᵣ"."""

    def plain(formula: re.Match[str]) -> str:
        return re.sub(r"_\{?(\w+)\}?", lambda lower: lower[1].translate(_LOWERED), formula[1])

    return re.sub(r"\$([^$]*)\$", plain, text.replace("\n", " "))

"""Unloading and Y/Q of the wheels along a train, beside the limits of EN 14363."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from contactstudy.compare.running_safety import QUOTIENT, UNLOADING
from contactstudy.figures.signals import styles
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import GREY, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults

_PANELS = (
    ("unloading", "Unloading\n(%)", 100.0, UNLOADING),
    ("quotient", "Y/Q", 1.0, QUOTIENT),
)


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure where there are wheel forces of a train."""
    found = results.metrics.get("wheel_forces", {})
    if not any(len(one["unloading"]) > 1 for one in found.values()):
        return []
    return [Drawing("wheel_forces", _caption(found), partial(_draw, results, found))]


def _panels(found: dict[str, Any]) -> list[tuple[str, str, float, float]]:
    return [panel for panel in _PANELS if any(panel[0] in one for one in found.values())]


def _draw(results: StudyResults, found: dict[str, Any]) -> Figure:
    panels = _panels(found)
    figure = new_figure(0.9 + 1.5 * len(panels))
    rows = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    named = styles(results)
    for axes, (key, text, factor, limit) in zip(rows, panels, strict=True):
        highest = 0.0
        for name, one in found.items():
            if key not in one:
                continue
            values = factor * np.array(one[key])
            highest = max(highest, float(values.max()))
            style = named[name]
            axes.plot(
                one["behind"], values, ls="none", marker=style.marker, ms=3.5, mfc="none",
                color=style.color, label=label(name),
            )  # fmt: skip
        if highest > 0.5 * factor * limit:
            axes.axhline(factor * limit, color=GREY, lw=0.9, ls=(0, (4, 2)))
        axes.set_ylabel(text)
        axes.margins(y=0.15)
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    rows[-1].set_xlabel("Distance behind the first wheelset (m)")
    figure.align_ylabels()
    figure_legend(figure, rows[0])
    return figure


def _caption(found: dict[str, Any]) -> str:
    told = []
    for name, one in found.items():
        parts = [f"{number(100 * max(one['unloading']), 3)} %"]
        if "quotient" in one:
            parts.append(f"{number(max(one['quotient']), 3)}")
        told.append(f"{label(name)} {' and '.join(parts)}")
    lateral = any("quotient" in one for one in found.values())
    also = ", and largest Y/Q outwards as mean over 2 m" if lateral else ""
    limits = f"{100 * UNLOADING:g} %" + (f" and {QUOTIENT:g}" if lateral else "")
    return (
        f"Largest unloading (Q₀ − Q)/Q₀ of each wheel{also}, of forces up to 20 Hz. Largest of "
        f"all: {'; '.join(told)}. Limits of EN 14363: {limits} (dashed where near)."
    )

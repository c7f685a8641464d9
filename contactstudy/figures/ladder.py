"""The ladder: what each assumption costs, from the reference down to the simplest scheme."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, BLUE, ORANGE, SHADE, VERMILION, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults

DYNAMIC, IRREGULARITY = "relative_l2_dynamic", "relative_l2_irregularity"
PARTS = {
    "relative_l2": ("total", "o", BLUE),
    DYNAMIC: ("dynamic part", "s", VERMILION),
    IRREGULARITY: ("part of the irregularity", "^", ORANGE),
}
"""Norm of a comparison -> what it is of, marker and colour."""


@dataclass(frozen=True)
class Rung:
    """A run of a ladder: its error against the top, and against the rung above, in per cent."""

    name: str
    above: str
    from_top: Mapping[str, float]
    step: Mapping[str, float]


def ladder(results: StudyResults, signal: str = "contact_force") -> list[Rung]:
    """The rungs below the reference, in order; none where the study is no ladder."""
    rungs = []
    for name, step in results.metrics.get("rungs", {}).items():
        top = results.metrics["comparisons"].get(name, {})
        rungs.append(
            Rung(name, step["above"], _percent(top.get(signal)), _percent(step.get(signal)))
        )
    return rungs


def drawings(results: StudyResults) -> list[Drawing]:
    """The waterfall of the contact force, where the study is a ladder."""
    rungs = ladder(results)
    if not rungs:
        return []
    return [Drawing("ladder", _caption(rungs), lambda: _draw(results, rungs))]


def _percent(norms: Any) -> dict[str, float]:
    found = norms if isinstance(norms, Mapping) else {}
    return {k: 100.0 * v for k in PARTS if (v := found.get(k)) is not None}


def _caption(rungs: list[Rung]) -> str:
    text = (
        "Contact force on each rung of the ladder, which changes one assumption of the rung above. "
        "Markers: relative L₂ difference from the top. Bars: difference of the dynamic part from "
        "the rung above; steps do not add up, since differences may cancel."
    )
    steps = [r for r in rungs if DYNAMIC in r.step]
    if steps:
        largest = max(steps, key=lambda r: r.step[DYNAMIC])
        share = number(largest.step[DYNAMIC])
        text += f" The largest step, {share} %, is that to {label(largest.name)}."
    return text


def _draw(results: StudyResults, rungs: list[Rung]) -> Figure:
    figure = new_figure(0.9 + 0.32 * len(rungs))
    axes = figure.add_subplot()
    y = np.arange(len(rungs))
    bars = [r.step.get(DYNAMIC, np.nan) for r in rungs]
    values = [v for r in rungs for v in (*r.from_top.values(), *bars) if v > 0.0]
    low = 10 ** np.floor(np.log10(min(values))) if values else 0.1
    axes.barh(
        y, bars, 0.72, left=0.0, color=SHADE, edgecolor=BLACK, linewidth=0.5,
        label="dynamic part, from the rung above",
    )  # fmt: skip
    for key, (words, marker, color) in PARTS.items():
        at = [(r.from_top[key], i) for i, r in enumerate(rungs) if key in r.from_top]
        if at:
            x, rows = zip(*at, strict=True)
            axes.plot(
                x, rows, linestyle="none", marker=marker, color=color, markersize=5,
                markerfacecolor="white", label=f"{words}, from the top",
            )  # fmt: skip
    axes.set_xscale("log")
    axes.set_xlabel("Relative $L_2$ difference of the contact force (%)", parse_math=True)
    axes.set_xlim(left=low)
    axes.set_yticks(y, [label(r.name) for r in rungs])
    axes.set_ylim(len(rungs) - 0.4, -0.6)
    axes.grid(False, axis="y")
    axes.set_title(f"top: {label(str(results.reference))}", loc="left")
    figure_legend(figure, axes)
    return figure

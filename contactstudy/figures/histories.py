"""Signals of all runs over each other, and below their differences from the reference."""

from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contactstudy.compare.signals import position, values
from contactstudy.figures.signals import (
    SIGNALS,
    Signal,
    compared,
    fade_end,
    has_signal,
    styles,
    wheel_note,
)
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, SHADE, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults

ZOOM_LENGTH = 1.8  # m, three bays of the usual 0.6 m


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for each signal that all runs of a study with a reference carry."""
    if results.reference is None or len(results.runs) < 2:
        return []
    return [
        Drawing(s.name, _caption(results, s), partial(_draw, results, s))
        for s in SIGNALS
        if all(has_signal(run, s.name) for run in results.runs.values())
    ]


def _draw(results: StudyResults, signal: Signal) -> Figure:
    figure = new_figure(4.05)
    grid = figure.add_gridspec(3, 1, height_ratios=[1.1, 1.0, 1.0])
    whole = figure.add_subplot(grid[0])
    below = figure.add_subplot(grid[1], sharex=whole)
    zoom = figure.add_subplot(grid[2])
    start = fade_end(results)
    _curves(whole, results, signal)
    _differences(below, results, signal)
    _curves(zoom, results, signal)
    for axes in (whole, below):
        _shade_fade(axes, results, start)
    low, high = zoom_window(results, signal, start)
    zoom.set_xlim(low, high)
    _limit_to_view(zoom, low, high)
    whole.axvspan(low, high, facecolor="none", edgecolor=BLACK, lw=0.5, ls=":")
    whole.tick_params(labelbottom=False)
    whole.set_ylabel(f"{signal.axis}\n({signal.unit})")
    zoom.set_ylabel(f"{signal.axis}\n({signal.unit})")
    below.set_ylabel(f"Difference\n({signal.unit})")
    below.set_xlabel("Position X of the wheel (m)")
    zoom.set_xlabel("Position X of the wheel (m), dotted stretch enlarged")
    figure.align_ylabels()
    figure_legend(figure, whole)
    return figure


def _curves(axes: Axes, results: StudyResults, signal: Signal) -> None:
    for name, style in styles(results).items():
        run = results.runs[name]
        text = label(name) + (" (reference)" if name == results.reference else "")
        y = values(run, signal.name) * signal.scale
        order = 2.0 if name == results.reference else 2.5
        axes.plot(position(run), y, label=text, zorder=order, **style.line)
    axes.margins(x=0)


def _differences(axes: Axes, results: StudyResults, signal: Signal) -> None:
    axes.axhline(0.0, color=BLACK, lw=0.5)
    for name, style in styles(results).items():
        if name == results.reference:
            continue
        x, ours, theirs = compared(results, name, signal.name)
        axes.plot(x, (theirs - ours) * signal.scale, **style.line)
    axes.margins(x=0)


def _shade_fade(axes: Axes, results: StudyResults, end: float) -> None:
    start = min(float(position(run)[0]) for run in results.runs.values())
    if end > start:
        axes.axvspan(start, end, color=SHADE, lw=0, zorder=0)


def zoom_window(results: StudyResults, signal: Signal, start: float) -> tuple[float, float]:
    """Return the stretch [m] about the largest difference of any run after the fade-in."""
    reference = results.runs[str(results.reference)]
    first, last = start, float(position(reference)[-1])
    best, centre = -1.0, 0.5 * (first + last)
    for name in results.runs:
        if name == results.reference:
            continue
        x, ours, theirs = compared(results, name, signal.name, start)
        k = int(np.argmax(np.abs(theirs - ours)))
        if abs(theirs[k] - ours[k]) > best:
            best, centre = float(abs(theirs[k] - ours[k])), float(x[k])
    length = min(ZOOM_LENGTH, last - first)
    low = float(np.clip(centre - length / 2, first, last - length))
    return low, low + length


def _limit_to_view(axes: Axes, low: float, high: float) -> None:
    x, y = (np.concatenate(v) for v in zip(*(line.get_data() for line in axes.lines), strict=True))
    seen = y[(x >= low) & (x <= high)]
    if seen.size:
        bottom, top = seen.min(), seen.max()
        margin = 0.06 * (top - bottom) or 1.0
        axes.set_ylim(bottom - margin, top + margin)


def _caption(results: StudyResults, signal: Signal) -> str:
    reference = str(results.reference)
    start = fade_end(results)
    y = values(results.runs[reference], signal.name)
    y = y[position(results.runs[reference]) >= start] * signal.scale
    text = (
        f"{signal.label} of all runs over each other (top), their differences from "
        f"{label(reference)} (middle), and enlarged where the largest difference occurs (bottom). "
        "After the fade-in"
    )
    text += " (shaded)" if start > position(results.runs[reference])[0] else ""
    text += (
        f" the reference lies between {number(y.min(), 4)} and {number(y.max(), 4)} {signal.unit}; "
    )
    largest = []
    for name in results.runs:
        if name != reference:
            _, ours, theirs = compared(results, name, signal.name, start)
            largest.append((float(np.max(np.abs(theirs - ours))) * signal.scale, name))
    largest.sort()
    if len(largest) > 1:
        text += (
            f"the largest difference is smallest for {label(largest[0][1])} "
            f"({number(largest[0][0])} {signal.unit}) and largest for {label(largest[-1][1])} "
            f"({number(largest[-1][0])} {signal.unit})."
        )
    elif largest:
        text += f"{label(largest[0][1])} differs by at most {number(largest[0][0])} {signal.unit}."
    return text.removesuffix("; ") + wheel_note(results)

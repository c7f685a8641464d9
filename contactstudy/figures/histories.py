"""Signals of all runs over each other, and below their differences from the reference."""

from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.compare.signals import WITHOUT_STATIC, position
from contactstudy.figures.signals import (
    SIGNALS,
    Signal,
    compared,
    fade_end,
    from_rest,
    has_signal,
    leaves_track,
    others,
    styles,
)
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, SHADE, LineStyle, figure_legend, new_figure
from contactstudy.plot.text import between, label, number
from contactstudy.study.results import StudyResults

ZOOM_LENGTH = 1.8  # m, three bays of the usual 0.6 m
EXPLAINED = (
    "Figures of signals show all runs over each other (top), their differences from the reference "
    "(middle), and the stretch around the largest difference enlarged (bottom). The fade-in is "
    "shaded. A pale band is the range of a run that swings faster than lines can show."
)
"""What holds for all of these figures."""
_CELLS = 160
"""Parts of the way in each of which a band shows the range of a run that swings quickly."""
_QUICK = 0.3
"""A run swings quickly if the median range in such a part is more than this of all its range."""
_LOUD = 2.5
"""From so many times the next largest difference on, a run is left out of the panel of these."""


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for each signal that the reference and others carry."""
    return [
        Drawing(s.name, _caption(results, s), partial(_draw, results, s))
        for s in SIGNALS
        if _having(results, s)
    ]


def _having(results: StudyResults, signal: Signal) -> list[str]:
    """Runs whose signal is compared with the reference's."""
    known = others(results)
    if not known or not has_signal(results.runs[str(results.reference)], signal.name):
        return []
    return [name for name in known if has_signal(results.runs[name], signal.name)]


def _draw(results: StudyResults, signal: Signal) -> Figure:
    figure = new_figure(3.9)
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
    whole.set_xlim(right=leaves_track(results))
    low, high = zoom_window(results, signal, start)
    zoom.set_xlim(low, high)
    _limit_to_view(zoom, low, high)
    whole.axvspan(low, high, facecolor="none", edgecolor=BLACK, lw=0.5, ls=":")
    whole.tick_params(labelbottom=False)
    rest = "\nfrom rest" if signal.name in WITHOUT_STATIC else ""
    whole.set_ylabel(f"{signal.axis}{rest}\n({signal.unit})")
    zoom.set_ylabel(f"{signal.axis}{rest}\n({signal.unit})")
    below.set_ylabel(f"Difference\n({signal.unit})")
    below.set_xlabel("Position X of the wheel (m)")
    zoom.set_xlabel("Position X of the wheel (m), dotted stretch enlarged")
    figure.align_ylabels()
    figure_legend(figure, whole)
    return figure


def _curves(axes: Axes, results: StudyResults, signal: Signal) -> None:
    for name, style in styles(results).items():
        run = results.runs[name]
        if not has_signal(run, signal.name):
            continue
        text = label(name) + (" (reference)" if name == results.reference else "")
        y = from_rest(run, signal.name) * signal.scale
        order = 3.0 if name == results.reference else 2.5
        axes.plot(position(run), y, label=text, zorder=order, **style.line)
    axes.margins(x=0)


def _differences(axes: Axes, results: StudyResults, signal: Signal) -> None:
    """The quiet runs over the loud ones."""
    axes.axhline(0.0, color=BLACK, lw=0.5)
    found = {}
    for name in _having(results, signal):
        x, ours, theirs = compared(results, name, signal.name)
        found[name] = x, (theirs - ours) * signal.scale
    loud_first = sorted(found, key=lambda name: -float(np.abs(found[name][1]).max()))
    limit = shown_limit([float(np.abs(found[name][1]).max()) for name in loud_first])
    for k, name in enumerate(loud_first[limit is not None :]):
        _difference(axes, *found[name], styles(results)[name], 2.0 + 0.01 * k)
    if limit is not None:
        axes.set_ylim(-limit, limit)
    axes.margins(x=0)


def _difference(axes: Axes, x: Array, y: Array, style: LineStyle, order: float) -> None:
    if not swings_quickly(y):
        axes.plot(x, y, zorder=order, **style.line)
        return
    # where it can be zoomed, the line itself shows
    axes.plot(x, y, visible=False, zorder=order, **style.line)
    edges = np.linspace(0, len(y), _CELLS + 1).astype(int)[:-1]
    low, high = np.minimum.reduceat(y, edges), np.maximum.reduceat(y, edges)
    middle = x[np.minimum(edges + len(y) // (2 * _CELLS), len(x) - 1)]
    axes.fill_between(middle, low, high, color=style.color, alpha=0.35, lw=0, zorder=order)


def swings_quickly(y: Array) -> bool:
    """Whether a difference (n,) swings through much of its range in a small part of the way."""
    if len(y) < 4 * _CELLS or not np.ptp(y) > 0.0:
        return False
    edges = np.linspace(0, len(y), _CELLS + 1).astype(int)[:-1]
    ranges = np.maximum.reduceat(y, edges) - np.minimum.reduceat(y, edges)
    return bool(np.median(ranges) > _QUICK * np.ptp(y))


def shown_limit(largest: list[float]) -> float | None:
    """Where the panel of differences ends, given the largest of each run, falling; None: nowhere.

    One run that is much louder than all others would leave them a line.
    """
    if len(largest) < 2 or not largest[1] > 0.0 or largest[0] <= _LOUD * largest[1]:
        return None
    return 0.5 * _LOUD * largest[1]


def _shade_fade(axes: Axes, results: StudyResults, end: float) -> None:
    start = min(float(position(run)[0]) for run in results.runs.values())
    if end > start:
        axes.axvspan(start, end, color=SHADE, lw=0, zorder=0)


def zoom_window(results: StudyResults, signal: Signal, start: float) -> tuple[float, float]:
    """Return the stretch [m] about the largest difference of any run after the fade-in."""
    reference = results.runs[str(results.reference)]
    first, last = start, float(position(reference)[-1])
    best, centre = -1.0, 0.5 * (first + last)
    for name in _having(results, signal):
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
    y = from_rest(results.runs[reference], signal.name)
    y = y[position(results.runs[reference]) >= start] * signal.scale
    rest = ", counted from rest" if signal.name in WITHOUT_STATIC else ""
    told = [
        f"{signal.label}{rest}. After the fade-in that of {label(reference)} "
        f"{between(y.min(), y.max(), 4)} {signal.unit}."
    ]
    largest = []
    for name in _having(results, signal):
        _, ours, theirs = compared(results, name, signal.name, start)
        largest.append((float(np.max(np.abs(theirs - ours))) * signal.scale, name))
    largest.sort()
    if len(largest) > 1:
        told.append(
            f"The largest difference is smallest for {label(largest[0][1])} "
            f"({number(largest[0][0])} {signal.unit}) and largest for {label(largest[-1][1])} "
            f"({number(largest[-1][0])} {signal.unit})."
        )
    elif largest:
        told.append(
            f"{label(largest[0][1])} differs by at most {number(largest[0][0])} {signal.unit}."
        )
    whole = sorted(
        (-float(np.abs(np.subtract(*compared(results, n, signal.name)[1:])).max()), n)
        for _, n in largest
    )
    if shown_limit([-size for size, _ in whole]) is not None:
        told.append(
            f"{label(whole[0][1])} is left out of the panel of differences, beyond which it goes."
        )
    return " ".join(told)

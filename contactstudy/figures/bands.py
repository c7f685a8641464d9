"""Third-octave spectra of the contact force: levels and their differences from the reference."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from contactstudy.arrays import BoolArray
from contactstudy.compare.bands import CONTENT, least_content
from contactstudy.compare.signals import is_moving_force, speed, values
from contactstudy.figures.signals import compared, fade_end, has_signal, others, styles
from contactstudy.irregularity.estimate import ThirdOctaves, third_octave_levels
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, SHADE, figure_legend, new_figure
from contactstudy.plot.text import exact, label, listing, number
from contactstudy.study.results import StudyResults

HIGHEST = 2000.0  # Hz
SHOWN_RANGE = 80.0  # dB below the highest level
SIGNAL = "contact_force"


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure for a study with a reference whose runs carry the contact force."""
    if results.reference is None or len(results.runs) < 2:
        return []
    if not all(has_signal(run, SIGNAL) for run in results.runs.values()):
        return []
    pairs = level_pairs(results)
    if not pairs:
        return []
    return [Drawing("third_octaves", _caption(results, pairs), lambda: _draw(results, pairs))]


def level_pairs(results: StudyResults) -> dict[str, tuple[ThirdOctaves, ThirdOctaves]]:
    """Run -> levels of the reference and of the run, of the forces' dynamic parts, re 1 N.

    Both are taken at the positions that the two runs have in common behind the fade-in, over
    the whole record in one segment.
    """
    reference = results.runs[str(results.reference)]
    v = speed(reference)
    pairs = {}
    for name in others(results):
        run = results.runs[name]
        if is_moving_force(run):  # without a dynamic part
            continue
        x, ours, theirs = compared(results, name, SIGNAL, fade_end(results))
        spacing = float(x[-1] - x[0]) / (len(x) - 1) / v
        band = (1.0 / (spacing * len(x)), min(HIGHEST, 0.45 / spacing))
        levels = [
            third_octave_levels(signal - static, spacing, 1.0, band=band)
            for signal, static in (
                (ours, values(reference, SIGNAL)[0]),
                (theirs, values(run, SIGNAL)[0]),
            )
        ]
        if levels[0].centre.size and has_content(levels[0]).any():
            pairs[name] = (levels[0], levels[1])
    return pairs


def has_content(levels: ThirdOctaves) -> BoolArray:
    """Bands (n,) in which the reference holds enough to be compared."""
    return np.asarray(levels.mean_square > least_content(levels.mean_square), dtype=bool)


def _draw(results: StudyResults, pairs: dict[str, tuple[ThirdOctaves, ThirdOctaves]]) -> Figure:
    figure = new_figure(4.05)
    top, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.2, 1.0])
    below.axhline(0.0, color=BLACK, lw=0.5)
    first = next(iter(pairs.values()))[0]
    named = styles(results)
    style = named[str(results.reference)]
    text = f"{label(str(results.reference))} (reference)"
    top.plot(
        first.centre, first.level, marker=style.marker, ms=3, label=text, zorder=3, **style.line
    )
    for name, (ours, theirs) in pairs.items():
        style = named[name]
        marks = {"marker": style.marker, "ms": 3, **style.line}
        top.plot(theirs.centre, theirs.level, label=label(name), **marks)
        shown = has_content(ours) & np.isfinite(theirs.level)
        below.plot(theirs.centre[shown], theirs.level[shown] - ours.level[shown], **marks)
    empty = first.centre[~has_content(first)]
    if empty.size:
        # where the reference has content is one stretch but for holes, which are no bands' edge
        behind = first.centre[has_content(first)].max()
        for axes in (top, below):
            axes.axvspan(behind * 10**0.05, first.centre[-1] * 10**0.05, color=SHADE, lw=0)
    finite = [t.level[np.isfinite(t.level)] for pair in pairs.values() for t in pair]
    highest = max(float(level.max(initial=-np.inf)) for level in finite)
    lowest = min(float(level.min(initial=np.inf)) for level in finite)
    top.set_ylim(max(lowest, highest - SHOWN_RANGE) - 3, highest + 5)
    top.set_ylabel("Force level (dB re 1 N)")
    below.set(xlabel="Third-octave band centre (Hz)", ylabel="Difference (dB)", xscale="log")
    v = speed(results.runs[str(results.reference)])
    second = top.secondary_xaxis("top")
    second.set_xlabel("Wavelength (m)")
    _ticks(below, first, [f"{f:g}" for f in first.nominal])
    _ticks(second, first, [exact(v / f, 2) for f in first.centre])
    figure.align_ylabels()
    figure_legend(figure, top)
    return figure


def _ticks(axes: Axes, levels: ThirdOctaves, texts: list[str]) -> None:
    """Every third band labelled with its text."""
    chosen = slice((len(levels.centre) - 1) % 3, None, 3)
    axes.xaxis.set_major_locator(FixedLocator(list(levels.centre[chosen])))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xticklabels(texts[chosen])


def _caption(results: StudyResults, pairs: dict[str, tuple[ThirdOctaves, ThirdOctaves]]) -> str:
    v = speed(results.runs[str(results.reference)])
    text = (
        "Third-octave levels of the dynamic part of the contact force after the fade-in (top) and "
        f"their differences from {label(str(results.reference))} (bottom), at "
        f"{exact(round(v * 3.6, 3))} km/h."
    )
    parts, own = [], []
    for name, (ours, theirs) in pairs.items():
        heard = has_content(ours) & np.isfinite(theirs.level)
        if heard.any():
            difference = theirs.level[heard] - ours.level[heard]
            k = int(np.argmax(np.abs(difference)))
            parts.append(
                f"{label(name)} {number(difference[k], 2)} dB at {ours.nominal[heard][k]:g} Hz"
            )
        else:
            parts.append(f"{label(name)} has no band in common")
        spurious = ~has_content(ours) & (theirs.mean_square > least_content(ours.mean_square))
        if spurious.any():
            k = int(np.argmax(np.where(spurious, theirs.mean_square, 0.0)))
            own.append(f"{label(name)} ({theirs.level[k]:.0f} dB at {theirs.nominal[k]:g} Hz)")
    told = [text, f"Largest differences: {', '.join(parts)}."]
    if not all(has_content(ours).all() for ours, _ in pairs.values()):
        told.append(
            f"Bands in which the reference lies more than {CONTENT:g} dB below its highest (shaded "
            "at the end) hold nothing to compare."
        )
    if own:
        told.append(f"What is louder there is the model's own: {listing(own)}.")
    return " ".join(told)

"""The damping ratio that a deck has over frequency, by Rayleigh or of its modes."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure

from contactstudy.arrays import Array
from contactstudy.figures.deck import largest_station
from contactstudy.figures.resolved_track import bridge_of
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import BLACK, GREY, VERMILION, figure_legend, new_figure
from contactstudy.plot.text import number
from contactstudy.study.results import StudyResults
from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import realised_ratio
from contactstudy.track.deck_modes import deck_modes
from contactstudy.track.model import Track
from contactstudy.track.structure_nodes import nodes_of

_MODES = 3
_UP_TO = 100.0  # Hz, at least
_TICKS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure where all runs recorded a deck."""
    if largest_station(results) is None:
        return []
    bridge = bridge_of(results.config["track"])
    found = _ratios(bridge)
    return [Drawing("deck_damping", _caption(bridge, *found), partial(_draw, bridge, *found))]


def bending_frequencies(bridge: Bridge) -> Array:
    """First frequencies of the longest span in bending, simply supported, i^2 f_1 (n,) [Hz]."""
    first = bridge.deck.frequency(max(bridge.spans))
    return np.asarray(first * np.arange(1, _MODES + 1) ** 2)


def _ratios(bridge: Bridge) -> tuple[Array, Array]:
    """Frequencies [Hz] and damping ratios of the modes that are marked."""
    if (coefficients := bridge.rayleigh) is not None:
        frequencies = bending_frequencies(bridge)
        return frequencies, realised_ratio(coefficients, frequencies)
    up_to = bridge.damped_up_to
    assert up_to is not None
    # vertical modes of the longest deck, two beyond the limit
    nodes = nodes_of(Track(structure=bridge), "euler", 1)
    longest = max(range(len(bridge.decks)), key=lambda k: np.ptp(bridge.decks[k]))
    modes = deck_modes(nodes, longest, True, 4.0 * up_to)
    given = modes.frequencies <= up_to
    count = int(given.sum()) + 2
    ratios = modes.ratios + bridge.deck.damping_ratio * given
    return modes.frequencies[:count], ratios[:count]


def _draw(bridge: Bridge, modes: Array, ratios: Array) -> Figure:
    figure = new_figure(2.4)
    axes = figure.subplots()
    coefficients = bridge.rayleigh
    whose = "bending of the longest span" if coefficients else "vertical modes of the longest deck"
    frequency = np.geomspace(0.5 * modes[0], max(_UP_TO, 1.5 * modes[-1]), 200)
    if coefficients is not None:
        axes.plot(frequency, 100 * realised_ratio(coefficients, frequency), color=BLACK, lw=1.0)
    axes.plot(modes, 100 * ratios, ls="none", marker="s", ms=4, mfc="none", color=VERMILION,
              label=whose)  # fmt: skip
    axes.axhline(100 * bridge.deck.damping_ratio, color=GREY, lw=0.7, ls=(0, (4, 2)),
                 label="ratio asked for")  # fmt: skip
    axes.set(xscale="log", xlabel="Frequency (Hz)", ylabel="Damping ratio (%)")
    ticks = [t for t in _TICKS if frequency[0] <= t <= frequency[-1]]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.set_xticks([], minor=True)
    axes.set_ylim(bottom=0.0)
    axes.set_xlim(frequency[0], frequency[-1])
    figure_legend(figure, axes)
    return figure


def _told(frequencies: Array, ratios: Array) -> str:
    return "; ".join(
        f"{number(100 * float(ratio), 3)} % at {number(float(f), 3)} Hz"
        for f, ratio in zip(frequencies, ratios, strict=True)
    )


def _caption(bridge: Bridge, modes: Array, ratios: Array) -> str:
    asked = number(100 * bridge.deck.damping_ratio, 3)
    if bridge.damped_up_to is not None:
        return (
            "Damping ratio of the modes of the longest deck alone on its bearings, vertical: "
            f"{_told(modes, ratios)}. Every mode of a deck up to "
            f"{number(bridge.damped_up_to, 3)} Hz has the ratio that was asked for, "
            f"{asked} % (dashed), beside the dampers of its "
            "bearings; higher ones have those alone."
        )
    return (
        "Damping ratio of a deck over frequency, as Rayleigh's damping gives it: "
        f"ζ = a/(2ω) + bω/2. Squares: the first {_MODES} bending frequencies of the longest span, "
        f"simply supported: {_told(modes, ratios)}. Dashed: the "
        f"ratio that was asked for, {asked} %."
    )

"""How signals are taken from the labelled results, and how they are shown."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from contactstudy.arrays import Array
from contactstudy.compare.signals import (
    WITHOUT_STATIC,
    carries,
    dynamic,
    position,
    same_way,
    side_by_side,
    values,
)
from contactstudy.plot.style import LineStyle, run_styles
from contactstudy.study.results import StudyResults


@dataclass(frozen=True)
class Signal:
    """How the variable `name` of the dataset is shown: scale * SI value, in `unit`.

    `label` stands in captions and tables, `axis` on the axis.
    """

    name: str
    label: str
    axis: str
    unit: str
    scale: float


SIGNALS = (
    Signal("contact_force", "Contact force", "Force", "kN", 1e-3),
    Signal("wheel_displacement", "Wheel displacement", "Displacement", "mm", 1e3),
    Signal("wheel_acceleration", "Wheel acceleration", "Acceleration", "m/s²", 1.0),
    Signal("rail_displacement", "Rail displacement at the wheel", "Displacement", "mm", 1e3),
    Signal("rail_acceleration", "Rail acceleration under the wheel", "Acceleration", "m/s²", 1.0),
)
DECK = (
    Signal("deck_displacement", "Deck displacement", "Displacement", "mm", 1e3),
    Signal("deck_acceleration", "Deck acceleration", "Acceleration", "m/s²", 1.0),
)


def styles(results: StudyResults) -> dict[str, LineStyle]:
    """Line style of each run of a study."""
    return run_styles(list(results.runs), results.reference)


def has_signal(run: xr.Dataset, name: str) -> bool:
    """Whether the run carries the signal over time."""
    return carries(run, name) and "time" in run[name].dims


def fade_end(results: StudyResults) -> float:
    """Position in m from which the irregularity acts in full; the start when nothing fades."""
    start = min(float(position(run)[0]) for run in results.runs.values())
    journey = results.config.get("journey", {})
    return start + float(journey.get("fade_in", 0.0))


def others(results: StudyResults) -> list[str]:
    """Runs that are compared with the reference: all others that travel its way.

    None where the reference is none of the runs, as in a sweep, which keeps no histories.
    """
    reference = results.runs.get(str(results.reference))
    if reference is None:
        return []
    return [
        name
        for name, run in results.runs.items()
        if name != results.reference and same_way(run, reference)
    ]


def compared(
    results: StudyResults, name: str, signal: str, start: float = -np.inf
) -> tuple[Array, Array, Array]:
    """Return positions (k,) in m, the reference's signal (k,) there, and that of the run `name`.

    Taken as the norms take them: at equal positions of the leading wheel, from `start` [m] on, and
    counted from rest where they do that.
    """
    pair = results.runs[name], results.runs[str(results.reference)]
    x, own, reference = side_by_side(*pair, lambda run: from_rest(run, signal), start)
    return x, reference, own


def from_rest(run: xr.Dataset, signal: str) -> Array:
    """A signal (time,) as it is compared: less its value at rest where the norms take that off."""
    return (dynamic if signal in WITHOUT_STATIC else values)(run, signal)


def wheel_note(results: StudyResults) -> str:
    """Return a sentence that names the wheel when there are several, else nothing."""
    several = any("wheel" in run["position"].dims for run in results.runs.values())
    if not several:
        return ""
    until = ", up to the end of the track" if leaves_track(results) is not None else ""
    return f" Of several wheels the leading one is shown{until}."


def leaves_track(results: StudyResults) -> float | None:
    """Position [m] at which the leading wheel leaves the track; None if it stays on it."""
    length = results.config.get("track", {}).get("length")
    if length is None or all(position(run)[-1] <= length for run in results.runs.values()):
        return None
    return float(length)

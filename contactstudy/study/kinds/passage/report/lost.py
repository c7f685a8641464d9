"""Where runs lose contact, or where a spring pulls, in words."""

from collections.abc import Container, Iterator
from dataclasses import dataclass

import numpy as np
import xarray as xr

from contactstudy.compare.signals import position, values
from contactstudy.figures.signals import fade_end
from contactstudy.plot.text import label, listing, number
from contactstudy.study.results import StudyResults

_FORCE = "contact_force"


@dataclass(frozen=True)
class Lost:
    """How a run is out of contact behind the fade-in.

    Attributes
    ----------
    share : float
        Part of the way.
    start, end : float
        The longest stretch, m.
    lift : float
        Largest height of the wheel above the running surface, m; nan where it is not known.
    for_good : bool
        Whether the run ends out of contact, on its longest stretch.
    """

    share: float
    start: float
    end: float
    lift: float
    for_good: bool


def flown_off(results: StudyResults) -> list[str]:
    """Which wheels are off the rail for good, for the terminal."""
    lost = _lost(results, _pulled(results))
    return [_flown_off(name, one) for name, one in lost.items() if one.for_good]


def sentences(results: StudyResults) -> Iterator[str]:
    """What is to be said of contact that is lost, of pulling springs, and of nothing of both."""
    pulled = _pulled(results)
    lost = _lost(results, pulled)
    if not pulled and not lost:
        yield "Contact is never lost."
    if lost:
        yield f"Contact is lost at times in {listing([label(n) for n in lost])}."
    for name, one in lost.items():
        if one.for_good:
            yield f"{_flown_off(label(name), one)}."
        elif one.share > 0.05:
            yield (
                f"{label(name)} is without contact on {number(100 * one.share, 2)} % of the way, "
                f"for the longest from X = {number(one.start, 4)} to {number(one.end, 4)} m"
                f"{_height(one)}."
            )
    for name, low in pulled.items():
        yield (
            f"The linear spring of {label(name)} pulls where the wheel would lift off, with up to "
            f"{number(-1e-3 * low)} kN: there its force has no meaning."
        )


def lost_contact(run: xr.Dataset, start: float) -> Lost | None:
    """How a run is out of contact from the position `start` [m] on; None if it never is."""
    x, force = position(run), values(run, _FORCE)
    x, open_ = x[x >= start], force[x >= start] <= 0.0
    if not open_.any():
        return None
    edges = np.flatnonzero(np.diff(np.r_[False, open_, False]))
    stretches = edges.reshape(-1, 2)  # first and behind the last sample of each
    first, last = stretches[np.argmax(stretches[:, 1] - stretches[:, 0])]
    lift = np.nan
    if {"wheel_displacement", "rail_displacement", "irregularity"} <= set(run.variables):
        gap = values(run, "wheel_displacement") - values(run, "rail_displacement")
        gap = (gap - values(run, "irregularity"))[position(run) >= start]
        lift = float(gap[open_].max())
    return Lost(
        float(np.mean(open_)), float(x[first]), float(x[last - 1]), lift, last == len(open_)
    )


def _pulled(results: StudyResults) -> dict[str, float]:
    """Runs whose spring pulls, with their least force [N]."""
    return {n: low for n, run in results.runs.items() if (low := _pull(results, run)) < 0.0}


def _lost(results: StudyResults, pulled: Container[str]) -> dict[str, Lost]:
    """Runs that lose contact, but for those whose spring pulls instead."""
    return {
        n: found
        for n, run in results.runs.items()
        if n not in pulled and (found := lost_contact(run, fade_end(results))) is not None
    }


def _pull(results: StudyResults, run: xr.Dataset) -> float:
    """Least force in N behind the fade-in."""
    return float(np.min(values(run, _FORCE)[position(run) >= fade_end(results)], initial=0.0))


def _height(one: Lost) -> str:
    return f", up to {number(1e3 * one.lift, 2)} mm above it" if np.isfinite(one.lift) else ""


def _flown_off(name: str, one: Lost) -> str:
    return (
        f"In {name} the wheel flies off at X = {number(one.start, 4)} m and is not back on the "
        f"rail at the end of the run{_height(one)}"
    )

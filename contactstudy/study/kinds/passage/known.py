"""The tables of a study as far as they could be read, for the rules that relate them."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.irregularity import Irregularity
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.on_bridge import vehicle_on
from contactstudy.study.kinds.passage.record import MeasuredRecord
from contactstudy.study.kinds.passage.runs import Run
from contactstudy.study.kinds.passage.scan import ScanFiles
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.study.kinds.passage.wheelset import WheelsetPosition
from contactstudy.track.model import Track
from contactstudy.validation import UnreadError
from contactstudy.vehicle import Vehicle, VehicleTable


@dataclass(frozen=True)
class Known:
    """Tables of a study, None for those that failed; `made` is the vehicle of its table."""

    irregularity: Irregularity | None
    track: Track | None
    journey: Journey | None
    vehicle: VehicleTable | None
    solid: Solid | None
    wheelset: WheelsetPosition | None
    scan: ScanFiles | None
    measured: MeasuredRecord | None
    made: Vehicle | None
    runs: Mapping[str, Run]

    @property
    def meshed(self) -> bool:
        """Whether a run needs the meshed section."""
        return any(_needs_solid(run) for run in self.runs.values())


def known_of(tables: Mapping[str, Any], runs: Mapping[str, Run]) -> Known:
    """What can be related; of journeys that lead nowhere and wrong vehicles is complained already.

    A vehicle is made first, and asked for its radius then.
    """
    found: dict[str, Any] = {key: tables.get(key) for key in Known.__annotations__}
    found |= {"made": None, "runs": runs}
    journey, vehicle, track = found["journey"], found["vehicle"], found["track"]
    if not _leads(journey):
        found["journey"] = None
    if vehicle is not None:
        try:
            with suppress(UnreadError):
                found["made"] = vehicle.vehicle() if track is None else vehicle_on(track, vehicle)
            with suppress(UnreadError):
                _ = vehicle.wheel_radius
        except InputError:
            found["vehicle"] = None
    return Known(**found)


def _leads(journey: Journey | None) -> bool:
    with suppress(UnreadError):
        return journey is not None and journey.start < journey.end
    return False


def _needs_solid(run: Run) -> bool:
    with suppress(UnreadError):
        return run.needs_solid
    return False

"""What is different where the track of a passage stands on a bridge."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from contactstudy.irregularity import Irregularity
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.run import Run
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.track.model import Track
from contactstudy.validation import asked, complaint
from contactstudy.vehicle import Train, Vehicle, VehicleTable
from contactstudy.vehicle.axles import Axles


def vehicle_on(track: Track, table: VehicleTable) -> Vehicle:
    """The vehicle on a track: on both rails of a bridge, on the one rail of any other track.

    A single wheel column, wheel or bogie stands on both rails as one.
    """
    if track.structure is not None and isinstance(table, Train | Axles):
        return table.vehicle(rails=2)
    return table.vehicle()


def planar_on(track: Track, vehicle: Vehicle) -> bool:
    """Whether a track on a bridge moves vertically only under a vehicle."""
    assert track.structure is not None
    return track.structure.planar_under(vehicle.contact_directions)


def journey_on(track: Track, vehicle: Vehicle, journey: Journey) -> Journey:
    """The journey, on a bridge with what was left out fitted to it."""
    if track.structure is None:
        return journey
    return journey.over_bridge(track.length, -float(vehicle.contact_offsets.min()))


def problems_of_runs(
    track: Track,
    vehicle: Vehicle | None,
    runs: Mapping[str, Run],
    irregularity: Irregularity | None,
) -> Iterator[str]:
    """Runs and vehicles that are not possible on a bridge; None for a vehicle that failed."""
    if track.structure is None:
        for name, run in runs.items():
            yield from asked(_on_ground, name, run)
        yield from [] if vehicle is None else vehicle.problems_on_one_rail()
        return
    if vehicle is not None:
        yield from asked(_under, track, vehicle)
    for name, run in runs.items():
        yield from asked(_on_bridge, track, vehicle, name, run, irregularity)


def _on_ground(name: str, run: Run) -> Iterator[str]:
    if isinstance(run, PointRun) and run.travel == "backward":
        yield complaint(f"runs.{name}.travel", run.travel, 'needs track.structure = "bridge"')


def _under(track: Track, vehicle: Vehicle) -> Iterator[str]:
    assert track.structure is not None
    planar = planar_on(track, vehicle)
    if not planar and vehicle.planar:
        yield (
            'track.motion = "space": needs a vehicle on two rails, such as vehicle.type = "train"'
            ' or "axle_loads"'
        )
    if planar and "Y" in vehicle.contact_directions:
        yield 'track.motion = "planar": needs vehicle.model = "planar"'
    if not planar:
        for name in track.structure.deck.missing:
            yield f"track.deck_{name}: is missing; a run in space needs it"


def _on_bridge(
    track: Track, vehicle: Vehicle | None, name: str, run: Run, irregularity: Irregularity | None
) -> Iterator[str]:
    if not isinstance(run, PointRun) or run.needs_solid:
        yield f"runs.{name}: needs a meshed rail; the rails of a bridge are beams"
        return
    for key, holds in {
        "local_compliance": run.local_compliance,
        "bay_compliance": run.bay_compliance,
        "direction": run.direction == "Y",
    }.items():
        if holds:
            allowed = "is not possible on a bridge"
            yield complaint(f"runs.{name}.{key}", getattr(run, key), allowed)
    if run.presses:
        yield (
            f"runs.{name}: needs the static press of a meshed rail; the rails of a bridge are "
            'beams: use k_r in N/m or "hertz_tangent", or law = "hertz" with '
            'hertz_constant = "closed_form"'
        )
    if vehicle and run.rigid and planar_on(track, vehicle) and not vehicle.planar:
        allowed = "must give way on a planar bridge, where both wheels of a wheelset are one"
        yield complaint(f"runs.{name}.k_r", run.k_r, allowed)
    if run.travel == "backward" and irregularity is not None and irregularity.rail_defect:
        yield f'runs.{name}.travel: must be "forward" with irregularity.rail_defect'

"""What is impossible only in combination: tables of a study against each other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.irregularity import Irregularity
from contactstudy.irregularity.depth_map import DepthMap
from contactstudy.irregularity.flats import LocalDefect
from contactstudy.profiles.wheel_file import wheel_dimensions, wheel_sections
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.on_bridge import problems_of_runs, vehicle_on
from contactstudy.study.kinds.passage.record import MeasuredRecord
from contactstudy.study.kinds.passage.relations import Related
from contactstudy.study.kinds.passage.runs import PointRun, Run, SurfaceRun
from contactstudy.study.kinds.passage.scan import ScanFiles
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.study.kinds.passage.wheelset import WheelsetPosition, problems_of
from contactstudy.track.model import Track
from contactstudy.validation import asked, complaint, parameters
from contactstudy.validation.base import naming
from contactstudy.vehicle import Vehicle, VehicleTable

_SLACK = 1e-9  # relative, for lengths that were given in decimal


def combined(tables: Mapping[str, Any], runs: Mapping[str, Run]) -> list[str]:
    """Complaints about values that are fine alone.

    Tables that failed are left out; what of others could not be read ends only the rules that need
    it.
    """
    known: dict[str, Any] = {key: tables.get(key) for key in _RELATED}
    known |= {"made": None, "runs": runs}
    # their own complaints are enough
    if (journey := known["journey"]) is not None and not asked(_leads, journey):
        known["journey"] = None
    if known["vehicle"] is not None:
        try:
            known["made"] = next(iter(asked(_vehicle, **known)), None)
            asked(lambda: [known["vehicle"].wheel_radius])
        except InputError:
            known["vehicle"] = None
    return [problem for rule in _RULES for problem in asked(rule, **known)]


def _leads(journey: Journey) -> Iterator[bool]:
    if journey.start < journey.end:
        yield True


def _vehicle(track: Track | None, vehicle: VehicleTable, **_: Any) -> list[Vehicle]:
    return [vehicle.vehicle() if track is None else vehicle_on(track, vehicle)]


def _of_runs(
    track: Track | None,
    made: Vehicle | None,
    irregularity: Irregularity | None,
    runs: Mapping[str, Run],
    **_: Any,
) -> Iterator[str]:
    if made is not None and runs:
        yield from asked(_wheels, made, irregularity, runs)
    if track is not None and runs:
        yield from asked(problems_of_runs, track, made, runs, irregularity)


def _of_journey(
    journey: Journey | None,
    track: Track | None,
    made: Vehicle | None,
    vehicle: VehicleTable | None,
    irregularity: Irregularity | None,
    runs: Mapping[str, Run],
    **_: Any,
) -> Iterator[str]:
    if journey is None:
        return
    for name, run in runs.items():
        yield from asked(_step, journey, name, run)
    if track is not None:
        yield from asked(
            journey.problems_on, track, made if runs else None, naming(Journey, "journey")
        )
    if irregularity is not None and runs and vehicle is not None:
        yield from asked(_defects, irregularity, journey, vehicle)
    radius = 0.43 if vehicle is None else vehicle.wheel_radius
    related = Related(journey, track, made, radius, irregularity, runs, {})
    yield from (finding.text for finding in related.findings() if finding.wrong)


def _step(journey: Journey, name: str, run: Run) -> list[str]:
    if run.time_step is None:
        return []
    return journey.problems_of_step(f"runs.{name}.time_step", run.step(journey.time_step))


def _of_record(
    measured: MeasuredRecord | None,
    journey: Journey | None,
    track: Track | None,
    made: Vehicle | None,
    runs: Mapping[str, Run],
    **_: Any,
) -> list[str]:
    if measured is None or journey is None or not measured.used or not runs:
        return []
    return measured.problems_on(journey, track, made)


def _of_solid(
    solid: Solid | None,
    track: Track | None,
    vehicle: VehicleTable | None,
    wheelset: WheelsetPosition | None,
    runs: Mapping[str, Run],
    **_: Any,
) -> Iterator[str]:
    meshed = _meshed(runs)
    points = [run for run in runs.values() if isinstance(run, PointRun)]
    pressed = [run for run in points if any(asked(_presses, run))]
    if solid is None or not (meshed or pressed):
        return
    if track is not None:
        more = any(any(asked(_needs_profile, run)) for run in pressed)
        yield from asked(solid.problems_on, track, meshed or more)
        yield from asked(_unsupported, track, runs)
    if vehicle is not None:
        yield from asked(_wheel, solid, vehicle)
    if wheelset is not None:
        yield from asked(_wheelset, solid, wheelset, track, vehicle)


def _of_section(
    solid: Solid | None,
    scan: ScanFiles | None,
    irregularity: Irregularity | None,
    runs: Mapping[str, Run],
    **_: Any,
) -> Iterator[str]:
    if solid is None or not solid.half:
        return
    if scan is not None and scan.used:
        yield 'scan: applies only with solid.section = "whole" (here "half")'
    if irregularity is not None and _meshed(runs):
        yield from _mirrored(irregularity)


def _of_fields(
    solid: Solid | None, journey: Journey | None, runs: Mapping[str, Run], **_: Any
) -> list[str]:
    if solid is None or journey is None or not _meshed(runs):
        return []
    return _solid_on_journey(solid, journey)


def _meshed(runs: Mapping[str, Run]) -> bool:
    return any(any(asked(_needs_solid, run)) for run in runs.values())


def _needs_solid(run: Run) -> Iterator[bool]:
    yield run.needs_solid


def _presses(run: PointRun) -> Iterator[bool]:
    yield run.bay_compliance
    yield run.presses


def _needs_profile(run: PointRun) -> Iterator[bool]:
    yield run.law != "linear"
    yield run.bay_compliance
    yield run.patch_of_press


_RELATED = (
    "irregularity", "track", "journey", "vehicle", "solid", "wheelset", "scan", "measured",
)  # fmt: skip
_RULES: tuple[Callable[..., Iterable[str]], ...] = (
    _of_runs,
    _of_journey,
    _of_record,
    _of_solid,
    _of_section,
    _of_fields,
)


def _wheels(
    vehicle: Vehicle, irregularity: Irregularity | None, runs: Mapping[str, Run]
) -> list[str]:
    """Runs and defects that need one wheel, beside a vehicle with more."""
    problems = list[str]()
    if vehicle.n_wheels == 1:
        return problems
    needs = f"needs a vehicle with one wheel (here {vehicle.n_wheels})"
    for name, run in runs.items():
        if isinstance(run, SurfaceRun):
            problems.append(complaint(f"runs.{name}.solver", "surface", needs))
        elif isinstance(run, PointRun) and run.wheel == "modal":
            problems.append(complaint(f"runs.{name}.wheel", "modal", needs))
    if irregularity is not None and irregularity.wheel_defect is not None:
        problems.append(f"irregularity.wheel_defect: {needs}, for it would be on all of them")
    return problems


def _unsupported(track: Track, runs: Mapping[str, Run]) -> list[str]:
    """Contact stiffnesses that are pressed on a rail which bends as a whole.

    Bending compresses the head along the rail, so that it swells by some ``nu M z^2 / 2 EI``: up to
    all of the approach, which a press would count as stiffness of the contact.
    """
    if track.support is not None or track.rail.profile_name is None:
        return []
    return [
        f"runs.{name}: takes its contact stiffness from the static press, but track.support ="
        ' "none", and the bending of an unsupported rail would count as stiffness of the contact; '
        'give k_r in N/m or as "hertz_tangent", or law = "hertz" with hertz_constant = '
        '"closed_form"'
        for name, run in runs.items()
        if isinstance(run, PointRun) and run.law_of_press
    ]


def _defects(irregularity: Irregularity, journey: Journey, vehicle: VehicleTable) -> list[str]:
    """Defects that lie in the fade-in, where they would be in full, or are never met."""
    rail, wheel = irregularity.rail_defect, irregularity.wheel_defect
    places, problems = dict[str, tuple[float, float]](), list[str]()
    if rail is not None:
        places["rail_defect_at"] = rail.at, rail.half_length
    try:
        if isinstance(wheel, LocalDefect):
            places["wheel_defect_at"] = wheel.at, wheel.half_length(vehicle.wheel_radius)
    except InputError as error:
        problems = [f"irregularity.wheel_defect_file: {problem}" for problem in error.problems]
    end = journey.start + journey.fade_in
    return problems + [
        complaint(
            f"irregularity.{key}",
            at,
            f"must be {end + reach:.6g} to {journey.end:g} m: behind the fade-in with the whole "
            "defect, and met",
        )
        for key, (at, reach) in places.items()
        if not end + reach - _SLACK <= at <= journey.end
    ]


def _mirrored(irregularity: Irregularity) -> list[str]:
    """A depth map that a half section cannot have."""
    wheel = irregularity.wheel_defect
    try:
        if not isinstance(wheel, DepthMap) or wheel.read.mirrored:
            return []
    except InputError:
        return []  # complained about
    return [
        "irregularity.wheel_defect_file: the map is not the same at y and -y; needs "
        'solid.section = "whole" (here "half")'
    ]


def _wheel(solid: Solid, vehicle: VehicleTable) -> list[str]:
    try:
        dimensions = wheel_dimensions(solid.wheel_section)
    except InputError as error:
        return [f"solid.wheel_section: {problem}" for problem in error.problems]
    radius = vehicle.wheel_radius
    if solid.wheel_section in wheel_sections():  # these are stretched to any radius
        try:
            dimensions.with_radius(radius)
        except InputError as error:
            return [f"vehicle.wheel_radius = {radius:g} m: {p}" for p in error.problems]
    elif abs(dimensions.radius - radius) > _SLACK:
        allowed = f"must be that of the wheel's section file, {dimensions.radius:g} m"
        return [complaint("vehicle.wheel_radius", radius, allowed)]
    return []


def _wheelset(
    solid: Solid,
    wheelset: WheelsetPosition,
    track: Track | None,
    vehicle: VehicleTable | None,
) -> list[str]:
    if solid.half:
        return [
            f'wheelset.{key}: applies only with solid.section = "whole" (here "half")'
            for key in sorted(p.key for p in parameters(WheelsetPosition) if wheelset.given(p.name))
        ]
    if track is None or vehicle is None or track.rail.profile_name is None:
        return []
    return problems_of(wheelset, track.rail.profile_name, vehicle.wheel_radius)


def _solid_on_journey(solid: Solid, journey: Journey) -> list[str]:
    problems = [
        problem
        for key in ("pressure_at", "animation_span")
        for problem in journey.not_passed(f"solid.{key}", getattr(solid, key))
    ]
    span = solid.animation_span
    if span and not (len(span) == 2 and span[0] < span[1]):
        allowed = "must be two increasing positions, from and to (m), or be left out"
        problems.append(complaint("solid.animation_span", list(span), allowed))
    return problems

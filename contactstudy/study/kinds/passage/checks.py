"""What is impossible only in combination: tables of a study against each other."""

from __future__ import annotations

from collections.abc import Mapping
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
from contactstudy.validation import complaint, parameters
from contactstudy.validation.base import naming
from contactstudy.vehicle import Vehicle, VehicleTable

_SLACK = 1e-9  # relative, for lengths that were given in decimal


def combined(tables: Mapping[str, Any], runs: Mapping[str, Run]) -> list[str]:
    """Complaints about values that are fine alone; tables that failed are left out."""
    problems: list[str] = []
    irregularity: Irregularity | None = tables.get("irregularity")
    track: Track | None = tables.get("track")
    journey: Journey | None = tables.get("journey")
    vehicle: VehicleTable | None = tables.get("vehicle")
    solid: Solid | None = tables.get("solid")
    wheelset: WheelsetPosition | None = tables.get("wheelset")
    scan: ScanFiles | None = tables.get("scan")
    if journey is not None and journey.start >= journey.end:
        journey = None  # its own complaint is enough
    made = None
    try:
        if vehicle is not None:
            made = vehicle.vehicle() if track is None else vehicle_on(track, vehicle)
    except InputError:
        vehicle = None  # complained about
    if made is not None and runs:
        problems += _wheels(made, irregularity, runs)
        problems += problems_of_runs(track, made, runs, irregularity) if track is not None else ()
    if journey is not None:
        for name, run in runs.items():
            if run.time_step is not None:
                problems += journey.problems_of_step(
                    f"runs.{name}.time_step", run.step(journey.time_step)
                )
        if track is not None:
            of_runs = made if runs else None
            problems += journey.problems_on(track, of_runs, naming(Journey, "journey"))
        radius = 0.43 if vehicle is None else vehicle.wheel_radius
        related = Related(journey, track, made, radius, irregularity, runs, {})
        problems += [finding.text for finding in related.findings() if finding.wrong]
        if irregularity is not None and runs and vehicle is not None:
            problems += _defects(irregularity, journey, vehicle.wheel_radius)
        record: MeasuredRecord | None = tables.get("measured")
        if record is not None and record.used and runs:
            problems += record.problems_on(journey, track, made)
    if solid is None:
        return problems
    meshed = any(run.needs_solid for run in runs.values())
    points = [run for run in runs.values() if isinstance(run, PointRun)]
    pressed = [run for run in points if run.presses or run.bay_compliance]
    if meshed or pressed:
        if track is not None:
            more = any(p.patch_of_press or p.bay_compliance or p.law != "linear" for p in pressed)
            problems += solid.problems_on(track, meshed or more)
            problems += _unsupported(track, runs)
        if vehicle is not None:
            problems += _wheel(solid, vehicle.wheel_radius)
        if wheelset is not None:
            problems += _wheelset(solid, wheelset, track, vehicle)
    if scan is not None and scan.used and solid.half:
        problems.append('scan: applies only with solid.section = "whole" (here "half")')
    if irregularity is not None and meshed and solid.half:
        problems += _mirrored(irregularity)
    if journey is not None and meshed:
        problems += _solid_on_journey(solid, journey)
    return problems


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


def _defects(irregularity: Irregularity, journey: Journey, radius: float) -> list[str]:
    """Defects that lie in the fade-in, where they would be in full, or are never met."""
    rail, wheel = irregularity.rail_defect, irregularity.wheel_defect
    places, problems = dict[str, tuple[float, float]](), list[str]()
    if rail is not None:
        places["rail_defect_at"] = rail.at, rail.half_length
    try:
        if isinstance(wheel, LocalDefect):
            places["wheel_defect_at"] = wheel.at, wheel.half_length(radius)
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


def _wheel(solid: Solid, radius: float) -> list[str]:
    try:
        dimensions = wheel_dimensions(solid.wheel_section)
    except InputError as error:
        return [f"solid.wheel_section: {problem}" for problem in error.problems]
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

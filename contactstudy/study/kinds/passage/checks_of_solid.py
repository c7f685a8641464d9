"""What the meshed wheel and rail of a study cannot be together with its other tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

from contactstudy.exceptions import InputError
from contactstudy.irregularity import Irregularity
from contactstudy.irregularity.depth_map import DepthMap
from contactstudy.profiles.wheel_file import wheel_dimensions, wheel_sections
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.known import Known
from contactstudy.study.kinds.passage.runs import PointRun, Run
from contactstudy.study.kinds.passage.solid import Solid
from contactstudy.study.kinds.passage.wheelset import WheelsetPosition, problems_of
from contactstudy.track.model import Track
from contactstudy.validation import UnreadError, asked, complaint, parameters
from contactstudy.vehicle import VehicleTable

_SLACK = 1e-9  # relative, for lengths that were given in decimal


def problems_of_solid(known: Known) -> Iterator[str]:
    """With track, vehicle and wheelset, where a run needs it."""
    solid, track, runs = known.solid, known.track, known.runs
    pressed = [run for run in runs.values() if isinstance(run, PointRun) and _presses(run)]
    if solid is None or not (known.meshed or pressed):
        return
    if track is not None:
        more = any(_needs_profile(run) for run in pressed)
        yield from asked(solid.problems_on, track, known.meshed or more)
        yield from asked(_unsupported, track, runs)
    if known.vehicle is not None:
        yield from asked(_wheel, solid, known.vehicle)
    if known.wheelset is not None:
        yield from asked(_wheelset, solid, known.wheelset, track, known.vehicle)


def problems_of_section(known: Known) -> Iterator[str]:
    """What a half section cannot have."""
    if known.solid is None or not known.solid.half:
        return
    if known.scan is not None and known.scan.used:
        yield 'scan: applies only with solid.section = "whole" (here "half")'
    if known.irregularity is not None and known.meshed:
        yield from _mirrored(known.irregularity)


def problems_of_fields(known: Known) -> list[str]:
    """Places of pressure and animation that the journey does not pass."""
    if known.solid is None or known.journey is None or not known.meshed:
        return []
    return _solid_on_journey(known.solid, known.journey)


def _presses(run: PointRun) -> bool:
    with suppress(UnreadError):
        return run.bay_compliance or run.presses
    return False


def _needs_profile(run: PointRun) -> bool:
    with suppress(UnreadError):
        return run.law != "linear" or run.bay_compliance or run.patch_of_press
    return False


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

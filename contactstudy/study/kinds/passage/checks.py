"""What is impossible only in combination: keys against each other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.profiles.wheel_file import wheel_dimensions, wheel_sections
from contactstudy.study.kinds.passage.runs import PointRun, RunTable
from contactstudy.study.kinds.passage.scan import ScanTable
from contactstudy.study.kinds.passage.tables import (
    IrregularityTable,
    JourneyTable,
    SolidTable,
    TrackTable,
    VehicleTable,
)
from contactstudy.study.kinds.passage.wheelset import WheelsetTable, problems_of
from contactstudy.study.messages import complaint
from contactstudy.study.section import Section

_SLACK = 1e-9  # relative, for lengths that were given in decimal
# what the meshes of wheel and rail allow; the rail's reaches further by `placing.RAIL_MARGIN`
_ZONES = {"contact_half_length": 0.040, "contact_half_width": 0.023}


def inapplicable(path: str, section: Section) -> list[str]:
    """Complaints about keys that were given but mean nothing beside the other values."""
    problems = []
    for key in sorted(section.model_fields_set):
        if not section.applicable(key):
            decider, values = section.applies[key]
            quoted = " or ".join(f'"{v}"' for v in values)
            chosen = getattr(section, decider)
            text = f"applies only with {decider} = {quoted} (here {chosen!r})".replace("'", '"')
            problems.append(f"{path}.{key}: {text}")
    return problems


def combined(sections: Mapping[str, Any], runs: Mapping[str, RunTable]) -> list[str]:
    """Complaints about values that are fine alone; tables that failed are left out."""
    problems: list[str] = []
    track: TrackTable | None = sections.get("track")
    journey: JourneyTable | None = sections.get("journey")
    solid: SolidTable | None = sections.get("solid")
    irregularity: IrregularityTable | None = sections.get("irregularity")
    if irregularity is not None:
        problems += _irregularity(irregularity)
    if track is not None:
        problems += _track(track)
    if journey is not None:
        problems += _journey(journey, runs)
    if journey is not None and track is not None:
        problems += _journey_on_track(journey, track)
    meshed = any(r.needs_solid for r in runs.values())
    pressed = any(isinstance(r, PointRun) and r.k_r == "tangent" for r in runs.values())
    if solid is not None and track is not None and (meshed or pressed):
        problems += _solid_on_track(solid, track, meshed)
    vehicle: VehicleTable | None = sections.get("vehicle")
    if solid is not None and vehicle is not None and (meshed or pressed):
        problems += _wheel(solid, vehicle)
    wheelset: WheelsetTable | None = sections.get("wheelset")
    if solid is not None and wheelset is not None and (meshed or pressed):
        problems += _wheelset(solid, wheelset, sections)
    scan: ScanTable | None = sections.get("scan")
    if scan is not None:
        problems += scan.problems()
    if scan is not None and scan.used and solid is not None and solid.section == "half":
        problems.append('scan: applies only with solid.section = "whole" (here "half")')
    if solid is not None and journey is not None and meshed and journey.start < journey.end:
        problems += _solid_on_journey(solid, journey)
    return problems


def _increasing(path: str, pair: tuple[float, float], unit: str) -> list[str]:
    if pair[0] < pair[1]:
        return []
    return [complaint(path, list(pair), f"must increase, lowest first ({unit})")]


def _irregularity(table: IrregularityTable) -> list[str]:
    problems = _increasing("irregularity.band", table.band, "rad/m")
    problems += _increasing("irregularity.wavelengths", table.wavelengths, "m")
    if table.spectrum == "measured" and not table.file:
        problems.append(
            "irregularity.file: is missing; a measured irregularity needs a CSV file "
            "(--set irregularity.file=PATH)"
        )
    if table.measured_file and not table.level_column:
        problems.append(
            "irregularity.level_column: is missing; name the column of the CSV with the level"
        )
    return problems


def _whole(ratio: float) -> bool:
    return ratio > 0.5 and abs(ratio - round(ratio)) <= _SLACK * ratio


def _track(track: TrackTable) -> list[str]:
    problems = []
    if track.support == "discrete":
        if not _whole(track.length / track.spacing):
            allowed = f"must be a whole number of support spacings of {track.spacing:g} m"
            problems.append(complaint("track.length", track.length, f"{allowed} (m)"))
        if track.pad_length >= track.spacing:
            allowed = f"must be below the support spacing, {track.spacing:g} m"
            problems.append(complaint("track.pad_length", track.pad_length, allowed))
    if track.support == "none" and track.ends == "free":
        problems.append(complaint("track.ends", "free", "nothing holds a rail without support"))
    return problems


def _journey(journey: JourneyTable, runs: Mapping[str, RunTable]) -> list[str]:
    if journey.start >= journey.end:
        allowed = f"must be beyond journey.from, {journey.start:g} m"
        return [complaint("journey.to", journey.end, allowed)]
    problems = []
    distance = journey.end - journey.start
    if journey.fade_in >= distance:
        allowed = f"must be below the distance run, {distance:g} m"
        problems.append(complaint("journey.fade_in", journey.fade_in, allowed))
    duration = distance / journey.speed
    steps = {"journey.time_step": journey.time_step}
    steps |= {f"runs.{n}.time_step": r.time_step for n, r in runs.items() if r.time_step}
    for path, step in steps.items():
        if step > duration / 2:
            allowed = f"must be at most half the duration of the run, {duration / 2:.3g} s"
            problems.append(complaint(path, step, allowed))
    return problems


def _journey_on_track(journey: JourneyTable, track: TrackTable) -> list[str]:
    where = f"must lie on the track, 0 to {track.length:g} m"
    points = {"journey.from": journey.start, "journey.to": journey.end}
    points |= {f"journey.stations.{i}": x for i, x in enumerate(journey.stations)}
    return [complaint(k, x, where) for k, x in points.items() if x > track.length]


def _solid_on_track(solid: SolidTable, track: TrackTable, meshed: bool) -> list[str]:
    problems = []
    if track.rail == "given" and not meshed:
        return []  # the tangent then is Hertz's
    if track.rail == "given":
        problems.append(
            complaint("track.rail", "given", 'surface contact needs a rail with a profile: "60E1"')
        )
    spacing = track.spacing if track.support == "discrete" else track.length
    if not _whole(spacing / solid.cell_length):
        allowed = f"must divide {spacing:g} m into whole cells (m)"
        problems.append(complaint("solid.cell_length", solid.cell_length, allowed))
    elif solid.cell_length < 4 * solid.mesh_size:
        allowed = f"must be at least 4 elements of solid.mesh_size, {4 * solid.mesh_size:g} m"
        problems.append(complaint("solid.cell_length", solid.cell_length, allowed))
    if solid.coarse_mesh_size < solid.mesh_size:
        allowed = f"must be at least solid.mesh_size, {solid.mesh_size:g} m"
        problems.append(complaint("solid.coarse_mesh_size", solid.coarse_mesh_size, allowed))
    for key, most in _ZONES.items():
        if not solid.mesh_size <= (half := getattr(solid, key)) <= most:
            allowed = f"must be at least solid.mesh_size, {solid.mesh_size:g} m, and at most {most}"
            problems.append(complaint(f"solid.{key}", half, f"{allowed} m"))
    return problems


def _wheel(solid: SolidTable, vehicle: VehicleTable) -> list[str]:
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


def _wheelset(solid: SolidTable, wheelset: WheelsetTable, sections: Mapping[str, Any]) -> list[str]:
    if solid.section == "half":
        return [
            f'wheelset.{key}: applies only with solid.section = "whole" (here "half")'
            for key in sorted(wheelset.model_fields_set)
        ]
    problems = []
    if solid.interface_modes < 6:
        allowed = "must be at least 6, the rigid motions of a whole section"
        problems.append(complaint("solid.interface_modes", solid.interface_modes, allowed))
    track: TrackTable | None = sections.get("track")
    vehicle: VehicleTable | None = sections.get("vehicle")
    if track is not None and vehicle is not None and track.rail != "given":
        problems += problems_of(wheelset, track.rail, vehicle.wheel_radius)
    return problems


def _solid_on_journey(solid: SolidTable, journey: JourneyTable) -> list[str]:
    where = f"the wheel must pass it, {journey.start:g} to {journey.end:g} m"
    problems = [
        complaint(f"solid.{key}.{i}", x, where)
        for key in ("pressure_at", "animation_span")
        for i, x in enumerate(getattr(solid, key))
        if not journey.start <= x <= journey.end
    ]
    span = solid.animation_span
    if span and not (len(span) == 2 and span[0] < span[1]):
        allowed = "must be two increasing positions, from and to (m), or be left out"
        problems.append(complaint("solid.animation_span", list(span), allowed))
    return problems


def runs(tables: Mapping[str, RunTable]) -> list[str]:
    """Complaints about keys of one run against each other."""
    problems = []
    for name, run in tables.items():
        if not isinstance(run, PointRun):
            continue
        path = f"runs.{name}"
        if run.rail == "solid" and run.direction == "Y":
            problems.append(complaint(f"{path}.direction", "Y", 'must be "Z" on the solid rail'))
        if run.law == "hertz" and run.direction == "Y":
            problems.append(complaint(f"{path}.direction", "Y", 'must be "Z" with law = "hertz"'))
        rigid = run.law == "linear" and run.k_r == "rigid"
        undamped = run.stepper == "average_acceleration" or run.rho_inf > 1.0 - 1e-6
        if rigid and undamped:
            allowed = 'must be "generalised_alpha" with rho_inf below 1 where k_r = "rigid"'
            problems.append(complaint(f"{path}.integrator", run.stepper, allowed))
    return problems

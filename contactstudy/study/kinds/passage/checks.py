"""What is impossible only in combination: tables of a study against each other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from contactstudy.exceptions import gathered
from contactstudy.irregularity import Irregularity
from contactstudy.irregularity.flats import LocalDefect
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.checks_of_solid import (
    problems_of_fields,
    problems_of_section,
    problems_of_solid,
)
from contactstudy.study.kinds.passage.known import Known, known_of
from contactstudy.study.kinds.passage.on_bridge import problems_of_runs
from contactstudy.study.kinds.passage.relations import Related
from contactstudy.study.kinds.passage.runs import PointRun, Run, SurfaceRun
from contactstudy.validation import asked, complaint
from contactstudy.validation.base import naming
from contactstudy.vehicle import Vehicle, VehicleTable

_SLACK = 1e-9  # relative, for lengths that were given in decimal


def combined(tables: Mapping[str, Any], runs: Mapping[str, Run]) -> list[str]:
    """Complaints about values that are fine alone.

    Tables that failed are left out; what of others could not be read ends only the rules that need
    it.
    """
    known = known_of(tables, runs)
    return [problem for rule in _RULES for problem in asked(rule, known)]


def _of_runs(known: Known) -> Iterator[str]:
    if known.made is not None and known.runs:
        yield from asked(_wheels, known.made, known.irregularity, known.runs)
    if known.track is not None and known.runs:
        yield from asked(problems_of_runs, known.track, known.made, known.runs, known.irregularity)


def _of_journey(known: Known) -> Iterator[str]:
    journey, irregularity, runs = known.journey, known.irregularity, known.runs
    if journey is None:
        return
    for name, run in runs.items():
        yield from asked(_step, journey, name, run)
    if known.track is not None:
        made = known.made if runs else None
        yield from asked(journey.problems_on, known.track, made, naming(Journey, "journey"))
    if irregularity is not None and runs and known.vehicle is not None:
        yield from asked(_defects, irregularity, journey, known.vehicle)
    radius = 0.43 if known.vehicle is None else known.vehicle.wheel_radius
    related = Related(journey, known.track, known.made, radius, irregularity, runs, {})
    yield from (finding.text for finding in related.findings() if finding.wrong)


def _step(journey: Journey, name: str, run: Run) -> list[str]:
    if run.time_step is None:
        return []
    return journey.problems_of_step(f"runs.{name}.time_step", run.step(journey.time_step))


def _of_record(known: Known) -> list[str]:
    measured, journey, track = known.measured, known.journey, known.track
    if measured is None or journey is None or not measured.used or not known.runs:
        return []
    return measured.problems_on(journey, track, known.made)


_RULES: tuple[Callable[[Known], Iterable[str]], ...] = (
    _of_runs,
    _of_journey,
    _of_record,
    problems_of_solid,
    problems_of_section,
    problems_of_fields,
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


def _defects(irregularity: Irregularity, journey: Journey, vehicle: VehicleTable) -> list[str]:
    """Defects that lie in the fade-in, where they would be in full, or are never met."""
    rail, wheel = irregularity.rail_defect, irregularity.wheel_defect
    places, problems = dict[str, tuple[float, float]](), list[str]()
    if rail is not None:
        places["rail_defect_at"] = rail.at, rail.half_length
    with gathered(problems, "irregularity.wheel_defect_file: "):
        if isinstance(wheel, LocalDefect):
            places["wheel_defect_at"] = wheel.at, wheel.half_length(vehicle.wheel_radius)
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

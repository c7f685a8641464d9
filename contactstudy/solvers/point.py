"""The point-contact solver: the paper's section 3.1, and its nonlinear and rigid relatives."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from contactstudy.contact.filters import ContactFilter
from contactstudy.contact.laws import LATERAL_STIFFNESS, ContactLaw
from contactstudy.contact.patch_laws import PatchLaw
from contactstudy.contact.point_wheel import PointWheel
from contactstudy.dynamics.statics import held_by_springs, static_start
from contactstudy.dynamics.stepper import Integrator
from contactstudy.exceptions import ContactStudyError, NumericalError
from contactstudy.irregularity import Profile
from contactstudy.irregularity.rails import RailProfiles
from contactstudy.solvers.histories import Histories
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.lanes import LaneRun, LaneStepper, in_lanes
from contactstudy.solvers.observers import Observer, ReportProgress
from contactstudy.solvers.point_case import PointCase, ReadyCase
from contactstudy.solvers.point_described import warn_beyond
from contactstudy.solvers.run import described, run_through
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.model import Track
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr


def point_contact(
    track: Track | DiscreteTrack,
    vehicle: Vehicle,
    irregularity: Profile | RailProfiles,
    journey: Journey,
    *,
    law: ContactLaw | PatchLaw,
    contact_filter: ContactFilter | None = None,
    wheel: PointWheel | None = None,
    lateral_stiffness: float = LATERAL_STIFFNESS,
    observers: Sequence[Observer] = (),
    integrator: Integrator | None = None,
) -> xr.Dataset:
    """Run wheels over a track with a contact law at a point under each.

    Parameters
    ----------
    track : Track or DiscreteTrack
        A discretised track, such as `BeamTrack(Track(), "timoshenko", elements_per_bay=8)`, a
        `SolidTrack` or a `StructureTrack`. A `Track` gets the paper's beam, `BeamTrack(track)`, or
        with a bridge a `StructureTrack`. In the lateral direction (`BeamTrack(track,
        direction="Y")`) there is no static load and the contact holds in tension.
    irregularity : Profile or RailProfiles
        r(X), positive raises the running surface; on two rails that of both, or of each. It is
        faded in from each wheel's start.
    contact_filter : ContactFilter, optional
        What the contact makes of the irregularity, see `contactstudy.contact.filters`.
    wheel : PointWheel, optional
        Elastic modes of the vehicle's one wheel.
    lateral_stiffness : float
        k_y of the linear spring of lateral contacts beside vertical ones [N/m].
    observers : sequence of Observer
        Watch the run, such as `solvers.observers.ReportProgress`.
    integrator : Integrator, optional
        Average acceleration when not given; for a rigid contact generalised-alpha with spectral
        radius `RIGID_SPECTRAL_RADIUS`. A rigid contact is a constraint on displacements (an
        index-3 problem): under average acceleration errors of its force never die out but grow
        linearly, so it needs an integrator with numerical damping (A. Cardona and M. Geradin,
        Comput. Struct. 33 (1989) 801). Which one ran is in the dataset.

    Returns
    -------
    xarray.Dataset
        See `contactstudy.solvers.dataset`.

    Raises
    ------
    InputError
        Listing everything about the arguments that is impossible.
    NumericalError
        When the computation breaks down, with step, time and position.
    """
    case = PointCase(
        track,
        vehicle,
        irregularity,
        journey,
        law,
        contact_filter,
        wheel,
        integrator,
        lateral_stiffness,
        [observer for observer in observers if not isinstance(observer, ReportProgress)],
    )
    reports = [o.report for o in observers if isinstance(o, ReportProgress)]
    (found,) = point_contacts([case], lambda done, of: [report(done, of) for report in reports])
    if isinstance(found, ContactStudyError):
        raise found
    return found


def point_contacts(
    cases: Sequence[PointCase], report: Callable[[int, int], object] | None = None
) -> list[xr.Dataset | ContactStudyError]:
    """Several runs as `point_contact`, of each its dataset, or the error that ended it.

    Runs on one track with equal vehicles, integrators and time steps are stepped side by side in
    compiled code. A run's numbers do not depend on the others, nor on how many there are.
    `report` is called with steps done and steps in all.
    """
    found: list[xr.Dataset | ContactStudyError | None] = [None] * len(cases)
    groups: dict[Any, list[tuple[int, ReadyCase]]] = {}
    for number, case in enumerate(cases):
        try:
            ready = case.ready()
        except ContactStudyError as error:
            found[number] = error
        else:
            groups.setdefault(ready.system_key, []).append((number, ready))
    total = sum(ready.passage.journey.n_steps for own in groups.values() for _, ready in own)
    done = 0

    def tell(steps: int) -> None:
        nonlocal done
        done += steps
        if report is not None:
            report(done, total)

    for own in groups.values():
        runs = [ready for _, ready in own]
        results = _side_by_side(runs, tell) if runs[0].for_lanes else _one_by_one(runs, tell)
        for (number, _), result in zip(own, results, strict=True):
            found[number] = result
    return [one for one in found if one is not None]


def _side_by_side(
    runs: Sequence[ReadyCase], tell: Callable[[int], object]
) -> list[xr.Dataset | ContactStudyError]:
    """Run what shares the factor of S; `tell` is told of steps that were done."""
    import xarray as xr

    began = time.perf_counter()
    passage, integrator = runs[0].passage, runs[0].integrator
    system, external, wheels = passage.system, passage.external, passage.wheels
    found: dict[int, xr.Dataset | ContactStudyError] = {}
    ready: dict[int, LaneRun] = {}
    try:
        stepper = LaneStepper(system, external, integrator, passage.journey.time_step)
        held = held_by_springs(system, wheels)
    except NumericalError as error:
        return [error] * len(runs)
    for number, run in enumerate(runs):
        try:
            start = static_start(system, run.coupling, external, wheels, held)
        except NumericalError as error:
            found[number] = error
            continue
        histories = Histories(run.passage)
        histories.see(start)
        ready[number] = LaneRun(run.passage, run.coupling, start, histories)
    setup = (time.perf_counter() - began) / len(runs)
    numbers = list(ready)
    for lanes, group in in_lanes(list(ready.values())):
        began = time.perf_counter()
        own = [numbers[k] for k in group]
        broken = stepper.step([ready[k] for k in own], lanes, tell)
        stepping = (time.perf_counter() - began) / len(own)
        for number, broke in zip(own, broken, strict=True):
            run = runs[number]
            if broke:  # by single states, which say where
                found[number] = _by_states(run)
                continue
            seconds = run.setup + setup, stepping
            attrs = {**run.told, **described(run.passage, integrator, *seconds)}
            found[number] = data = ready[number].histories.into(xr.Dataset(attrs=attrs))
            warn_beyond(run.case.law, data)
    return [found[number] for number in range(len(runs))]


def _one_by_one(
    runs: Sequence[ReadyCase], tell: Callable[[int], object]
) -> list[xr.Dataset | ContactStudyError]:
    """Run what needs its states in sight."""
    found = []
    for run in runs:
        told = [0]

        def report(done: int, _: int, told: list[int] = told) -> None:
            tell(done - told[0])
            told[0] = done

        found.append(_by_states(run, [ReportProgress(report)]))
    return found


def _by_states(
    run: ReadyCase, observers: Sequence[Observer] = ()
) -> xr.Dataset | ContactStudyError:
    """Run with all states in sight; its dataset, or the error that ended it."""
    observers = [*run.case.observers, *observers]
    try:
        data = run_through(run.passage, run.coupling, run.integrator, observers, run.told)
    except ContactStudyError as error:
        return error
    data.attrs["seconds_setup"] += run.setup
    warn_beyond(run.case.law, data)
    return data

"""The point-contact solver: the paper's section 3.1, and its nonlinear and rigid relatives."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.contact.laws import ContactLaw, HertzSpring, LinearSpring, RigidContact
from contactstudy.contact.point import PointCoupling
from contactstudy.dynamics.stepper import Integrator, average_acceleration, generalised_alpha
from contactstudy.exceptions import InputError
from contactstudy.irregularity import Profile, faded
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.run import Assembly, Progress, run
from contactstudy.track.beam import BeamTrack, RailTheory
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.model import Direction, Track
from contactstudy.validation import raise_if
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr

RIGID_SPECTRAL_RADIUS = 0.5
"""Spectral radius of the integrator that a rigid contact gets when none is asked for."""


def point_contact(
    track: Track | DiscreteTrack,
    vehicle: Vehicle,
    irregularity: Profile,
    journey: Journey,
    *,
    rail_theory: RailTheory = "euler",
    elements_per_bay: int = 4,
    local_compliance: bool = False,
    law: ContactLaw,
    direction: Direction = "Z",
    integrator: Integrator | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Run wheels over a track with a contact law at a point under each.

    Parameters
    ----------
    track : Track or DiscreteTrack
        A `Track` gets a beam rail by the three options below; any discretised track (the solid
        rail) is taken as it is.
    vehicle : Vehicle
    irregularity : Profile
        r(X), positive raises the running surface. It is faded in from each wheel's start.
    journey : Journey
    rail_theory : {"euler", "timoshenko"}
    elements_per_bay : int
    local_compliance : bool
        Whether the loaded element's own compliance acts in series with the contact.
    law : LinearSpring, RigidContact, HertzSpring or MovingForce
    direction : {"Z", "Y"}
        In "Y" there is no static load and the contact holds in tension.
    integrator : Integrator, optional
        Average acceleration when not given; for a rigid contact generalised-alpha with spectral
        radius `RIGID_SPECTRAL_RADIUS`. A rigid contact is a constraint on displacements (an
        index-3 problem): under average acceleration errors of its force never die out but grow
        linearly, so it needs an integrator with numerical damping (A. Cardona and M. Geradin,
        Comput. Struct. 33 (1989) 801). Which one ran is in the dataset.
    progress : callable, optional
        Called with (steps done, steps).

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
    began = time.perf_counter()
    if integrator is None:
        rigid = isinstance(law, RigidContact)
        integrator = generalised_alpha(RIGID_SPECTRAL_RADIUS) if rigid else average_acceleration()
    problems: list[str] = []
    if isinstance(track, Track):
        described = track
        try:
            discrete: DiscreteTrack = BeamTrack(
                track, rail_theory, elements_per_bay, local_compliance, direction
            )
        except InputError as error:
            problems += error.problems
    else:
        described, discrete = track.track, track
        if direction != "Z":
            problems.append(f"direction = {direction!r}: this track is discretised for 'Z' only")
    problems += journey.problems_on(described, vehicle)
    problems += _law_problems(law, direction, integrator)
    raise_if(problems)

    assembly = Assembly(discrete, vehicle, direction)
    coupling, r = point_coupling(assembly, irregularity, journey, law)
    return run(
        assembly,
        coupling,
        journey,
        integrator,
        r,
        setup_began=began,
        attrs={"solver": "point", **_describe_rail(discrete), **_describe_law(law)},
        progress=progress,
        local_compliance=coupling.local_compliance,
    )


def point_coupling(
    assembly: Assembly, irregularity: Profile, journey: Journey, law: ContactLaw
) -> tuple[PointCoupling, np.ndarray]:
    """Join a law to all wheel positions of a journey.

    Returns
    -------
    coupling : PointCoupling
    irregularity : ndarray
        (n_times, n_wheels) r under each wheel, faded in from each wheel's start [m].
    """
    positions = journey.wheel_positions(assembly.vehicle.wheel_offsets)
    r = np.column_stack(
        [faded(irregularity, x[0], journey.fade_in)(x) for x in np.ascontiguousarray(positions.T)]
    )
    shape = positions.shape
    rail_dofs, rail_weights = assembly.track.rail_rows(positions.ravel())
    coupling = PointCoupling(
        law,
        assembly.wheel_dofs,
        rail_dofs.reshape(*shape, -1),
        rail_weights.reshape(*shape, -1),
        assembly.track.local_compliance(positions.ravel()).reshape(shape),
        r,
        assembly.static_loads,
        bilateral=assembly.direction == "Y",
    )
    return coupling, r


def _law_problems(law: ContactLaw, direction: Direction, integrator: Integrator) -> list[str]:
    problems = []
    if not isinstance(law, ContactLaw):
        problems.append(
            f"law = {law!r}: must be a LinearSpring, RigidContact, HertzSpring or MovingForce"
        )
    if direction == "Y" and isinstance(law, HertzSpring):
        problems.append("law = HertzSpring with direction = 'Y': Hertz's law is vertical only")
    if isinstance(law, RigidContact) and integrator.constraint_radius > 1.0 - 1e-6:
        problems.append(
            f"integrator = {integrator.name!r} with law = RigidContact: without numerical damping"
            " the force of a rigid contact is unstable; use generalised_alpha with a spectral"
            " radius below 1"
        )
    return problems


def _describe_rail(track: DiscreteTrack) -> dict[str, object]:
    if not isinstance(track, BeamTrack):
        return {"rail": "solid"}
    return {
        "rail": track.theory,
        "elements_per_bay": track.elements_per_bay,
        "local_compliance": int(track.element_compliance),
    }


def _describe_law(law: ContactLaw) -> dict[str, object]:
    match law:
        case LinearSpring(stiffness=stiffness):
            return {"law": "linear", "k_r": stiffness}
        case HertzSpring(stiffness=stiffness):
            return {"law": "hertz", "k_H": stiffness}
        case RigidContact():
            return {"law": "rigid"}
        case _:
            return {"law": "moving force"}

"""The point-contact solver: the paper's section 3.1, and its nonlinear and rigid relatives."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.filters import ContactFilter
from contactstudy.contact.laws import ContactLaw, HertzSpring, LinearSpring, RigidContact
from contactstudy.contact.point_coupling import PointCoupling, PointGaps
from contactstudy.contact.point_wheel import PointWheel
from contactstudy.dynamics.stepper import Integrator, average_acceleration, generalised_alpha
from contactstudy.irregularity import Profile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import Observer
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.run import run_through
from contactstudy.track.beam import BeamTrack
from contactstudy.track.discrete import DiscreteTrack, not_discrete
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
    law: ContactLaw,
    contact_filter: ContactFilter | None = None,
    wheel: PointWheel | None = None,
    observers: Sequence[Observer] = (),
    integrator: Integrator | None = None,
) -> xr.Dataset:
    """Run wheels over a track with a contact law at a point under each.

    Parameters
    ----------
    track : Track or DiscreteTrack
        A discretised track, such as `BeamTrack(Track(), "timoshenko", elements_per_bay=8)` or a
        `SolidTrack`. A `Track` gets the paper's beam, `BeamTrack(track)`. In the lateral
        direction (`BeamTrack(track, direction="Y")`) there is no static load and the contact
        holds in tension.
    irregularity : Profile
        r(X), positive raises the running surface. It is faded in from each wheel's start.
    contact_filter : ContactFilter, optional
        What the contact makes of the irregularity, see `contactstudy.contact.filters`.
    wheel : PointWheel, optional
        Elastic modes of the vehicle's one wheel.
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
    began = time.perf_counter()
    if integrator is None:
        rigid = isinstance(law, RigidContact)
        integrator = generalised_alpha(RIGID_SPECTRAL_RADIUS) if rigid else average_acceleration()
    discrete = BeamTrack(track) if isinstance(track, Track) else track
    raise_if(not_discrete(discrete))
    problems = journey.problems_on(discrete.track, vehicle)
    problems += _law_problems(law, discrete.direction, integrator)
    for observer in observers:
        problems += observer.problems_on(journey)
    raise_if(problems)

    moving = vehicle if wheel is None else wheel.on(vehicle)
    passage = Passage(discrete, moving, irregularity, journey)
    coupling = point_coupling(passage, law, contact_filter, wheel)
    setup = time.perf_counter() - began
    told = {"solver": "point", **_describe_rail(discrete), **_describe_law(law)}
    if wheel is not None:
        told |= {"wheel": "modal", "wheel_modes": len(wheel.shapes)}
    data = run_through(passage, coupling, integrator, observers, told)
    data.attrs["seconds_setup"] += setup
    return data


def point_coupling(
    passage: Passage[DiscreteTrack],
    law: ContactLaw,
    contact_filter: ContactFilter | None = None,
    wheel: PointWheel | None = None,
) -> PointCoupling:
    """Join a law to all wheel positions of a passage."""
    track, x, shape = passage.track, passage.positions.ravel(), passage.positions.shape
    dofs, weights = track.rail_rows(x)
    # a spring gives back no more than it stands for
    top = np.maximum(track.top_load_compliance(x), -law.softness)
    gaps = PointGaps(
        *PointGaps.rows(
            *_wheel_rows(passage, wheel), dofs.reshape(*shape, -1), weights.reshape(*shape, -1)
        ),
        (track.local_compliance(x) + top).reshape(shape),
        passage.felt(contact_filter),
    )
    return PointCoupling(law, gaps, passage.static_loads, bilateral=track.direction == "Y")


def _wheel_rows(
    passage: Passage[DiscreteTrack], wheel: PointWheel | None
) -> tuple[IntArray, Array]:
    """Dofs and weights (nw, j) of the wheels' displacement at the contact, up."""
    dofs = passage.wheel_dofs[:, None]
    if wheel is None:
        return dofs, np.ones(dofs.shape)
    n, m = passage.n_dofs, len(wheel.shapes)
    return np.hstack([dofs, np.arange(n - m, n)[None]]), np.r_[1.0, wheel.shapes][None]


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

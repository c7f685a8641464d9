"""The point-contact solver: the paper's section 3.1, and its nonlinear and rigid relatives."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.filters import ContactFilter
from contactstudy.contact.laws import (
    ContactLaw,
    HertzSpring,
    PressSpring,
    RigidContact,
)
from contactstudy.contact.patch_laws import PatchLaw
from contactstudy.contact.point_coupling import PointCoupling, PointGaps
from contactstudy.contact.point_wheel import PointWheel
from contactstudy.contact.two_directions import LATERAL_STIFFNESS
from contactstudy.dynamics.stepper import Integrator, average_acceleration, generalised_alpha
from contactstudy.irregularity import Profile
from contactstudy.irregularity.rails import RailProfiles
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import Observer
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point_described import described_law, described_rail, warn_beyond
from contactstudy.solvers.run import run_through
from contactstudy.track.beam import BeamTrack
from contactstudy.track.discrete import DiscreteTrack, not_discrete
from contactstudy.track.model import Direction, Track
from contactstudy.track.structure import StructureTrack
from contactstudy.validation import positive, raise_if
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr


RIGID_SPECTRAL_RADIUS = 0.5
"""Spectral radius of the integrator that a rigid contact gets when none is asked for."""


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
    began = time.perf_counter()
    if integrator is None:
        rigid = isinstance(law, RigidContact)
        integrator = generalised_alpha(RIGID_SPECTRAL_RADIUS) if rigid else average_acceleration()
    discrete = _discretised(track, vehicle) if isinstance(track, Track) else track
    raise_if(not_discrete(discrete))
    problems = journey.problems_on(discrete.track, vehicle) + problems_of_rails(
        discrete, vehicle, law
    )
    problems += positive("lateral_stiffness", lateral_stiffness, "N/m")
    problems += _law_problems(law, contact_filter, discrete.direction, integrator)
    for observer in observers:
        problems += observer.problems_on(journey)
    raise_if(problems)

    moving = vehicle if wheel is None else wheel.on(vehicle)
    passage = Passage(discrete, moving, irregularity, journey)
    coupling = point_coupling(passage, law, contact_filter, wheel, lateral_stiffness)
    setup = time.perf_counter() - began
    told = {"solver": "point", **described_rail(discrete), **described_law(law)}
    if wheel is not None:
        told |= {"wheel": "modal", "wheel_modes": len(wheel.shapes)}
    data = run_through(passage, coupling, integrator, observers, told)
    data.attrs["seconds_setup"] += setup
    warn_beyond(law, data)
    return data


def _discretised(track: Track, vehicle: Vehicle) -> DiscreteTrack:
    """The paper's beam, or the track on a bridge in the motions that the vehicle has."""
    if track.structure is None:
        return BeamTrack(track)
    return StructureTrack(track, planar="Y" not in vehicle.contact_directions)


def problems_of_rails(track: DiscreteTrack, vehicle: Vehicle, law: object) -> list[str]:
    """Complaints about a vehicle with contacts that the track's rails cannot have."""
    if not isinstance(track, StructureTrack):
        return vehicle.problems_on_one_rail()
    if track.planar and not vehicle.planar and isinstance(law, RigidContact):
        return ["law = RigidContact: both wheels of a wheelset are one on a planar track"]
    if track.planar and "Y" in vehicle.contact_directions:
        return ["vehicle: has lateral contacts; a planar track moves vertically only"]
    if not track.planar and vehicle.planar:
        return ["vehicle: has contacts on one rail; a track in space needs them on both"]
    return []


def point_coupling(
    passage: Passage[DiscreteTrack],
    law: ContactLaw | PatchLaw,
    contact_filter: ContactFilter | None = None,
    wheel: PointWheel | None = None,
    lateral_stiffness: float = LATERAL_STIFFNESS,
) -> PointCoupling:
    """Join a law to all wheel positions of a passage."""
    track, x, shape = passage.track, passage.positions.ravel(), passage.positions.shape
    felt, along = passage.felt(contact_filter), np.zeros((*shape, 0))
    if isinstance(law, PatchLaw):
        felt, along = passage.seen(law)
    # a spring gives back no more than it stands for
    top = np.maximum(track.top_load_compliance(x), -law.softness)
    gaps = PointGaps(
        _wheel_rows(passage, wheel),
        passage.rail_rows.at,
        (track.local_compliance(x) + top).reshape(shape),
        felt,
        along,
    )
    lateral = passage.lateral if passage.lateral.any() else None
    return PointCoupling(
        law, gaps, passage.static_loads, track.direction == "Y", lateral, lateral_stiffness
    )


def _wheel_rows(
    passage: Passage[DiscreteTrack], wheel: PointWheel | None
) -> tuple[IntArray, Array]:
    """Dofs and weights (nc, j) of the wheels' displacement at the contact."""
    dofs, weights = passage.wheels
    if wheel is None:
        return dofs, weights
    n, m = passage.n_dofs, len(wheel.shapes)
    return np.hstack([dofs, np.arange(n - m, n)[None]]), np.hstack([weights, wheel.shapes[None]])


def _law_problems(
    law: ContactLaw | PatchLaw,
    contact_filter: ContactFilter | None,
    direction: Direction,
    integrator: Integrator,
) -> list[str]:
    problems = []
    name = type(law).__name__
    if not isinstance(law, ContactLaw | PatchLaw):
        problems.append(
            f"law = {law!r}: must be a LinearSpring, RigidContact, HertzSpring, PressSpring, "
            "MovingForce, WinklerBedding or FollowingPatch"
        )
    if direction == "Y" and isinstance(law, HertzSpring | PressSpring | PatchLaw):
        problems.append(f"law = {name} with direction = 'Y': this law is vertical only")
    if contact_filter is not None and isinstance(law, PatchLaw):
        problems.append(f"contact_filter with law = {name}: this law is a filter itself")
    if isinstance(law, RigidContact) and integrator.constraint_radius > 1.0 - 1e-6:
        problems.append(
            f"integrator = {integrator.name!r} with law = RigidContact: without numerical damping"
            " the force of a rigid contact is unstable; use generalised_alpha with a spectral"
            " radius below 1"
        )
    return problems

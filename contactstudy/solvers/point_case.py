"""Runs with contact at points: their arguments, checked, and the law joined to all positions."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.filters import ContactFilter
from contactstudy.contact.laws import (
    LATERAL_STIFFNESS,
    ContactLaw,
    HertzSpring,
    PressSpring,
    RigidContact,
)
from contactstudy.contact.many_contacts import FEWEST
from contactstudy.contact.patch_laws import PatchLaw
from contactstudy.contact.point_coupling import PointCoupling
from contactstudy.contact.point_gaps import PointGaps
from contactstudy.contact.point_wheel import PointWheel
from contactstudy.dynamics.stepper import Integrator, average_acceleration, generalised_alpha
from contactstudy.irregularity import Profile
from contactstudy.irregularity.rails import RailProfiles
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import Observer
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point_described import described_law, described_rail
from contactstudy.track.beam import BeamTrack
from contactstudy.track.crown import Crown
from contactstudy.track.discrete import DiscreteTrack, not_discrete
from contactstudy.track.model import Direction, Track
from contactstudy.track.solid import SolidTrack
from contactstudy.track.structure import StructureTrack
from contactstudy.validation import positive, raise_if
from contactstudy.vehicle import Vehicle

RIGID_SPECTRAL_RADIUS = 0.5
"""Spectral radius of the integrator that a rigid contact gets when none is asked for."""

NARROW = 32
"""Half bandwidth up to which steps by rows in lanes are faster than those by blocks of rows."""


@dataclass(frozen=True, eq=False)
class PointCase:
    """A run of `point_contact`, with its arguments; observers make it step state by state."""

    track: Track | DiscreteTrack
    vehicle: Vehicle
    irregularity: Profile | RailProfiles
    journey: Journey
    law: ContactLaw | PatchLaw
    contact_filter: ContactFilter | None = None
    wheel: PointWheel | None = None
    integrator: Integrator | None = None
    lateral_stiffness: float = LATERAL_STIFFNESS
    observers: Sequence[Observer] = ()

    def ready(self) -> ReadyCase:
        """Check the arguments and join the law to all wheel positions."""
        began = time.perf_counter()
        law, journey, vehicle, integrator = self.law, self.journey, self.vehicle, self.integrator
        if integrator is None:
            integrator = average_acceleration()
            if isinstance(law, RigidContact):
                integrator = generalised_alpha(RIGID_SPECTRAL_RADIUS)
        track = self.track
        discrete = _discretised(track, vehicle) if isinstance(track, Track) else track
        raise_if(not_discrete(discrete))
        problems = journey.problems_on(discrete.track, vehicle)
        problems += problems_of_rails(discrete, vehicle, law)
        problems += positive("lateral_stiffness", self.lateral_stiffness, "N/m")
        problems += _law_problems(law, self.contact_filter, discrete.direction, integrator)
        for observer in self.observers:
            problems += observer.problems_on(journey)
        raise_if(problems)
        moving = vehicle if self.wheel is None else self.wheel.on(vehicle)
        passage = Passage(discrete, moving, self.irregularity, journey)
        coupling = point_coupling(
            passage, law, self.contact_filter, self.wheel, self.lateral_stiffness
        )
        return ReadyCase(self, passage, coupling, integrator, time.perf_counter() - began)


@dataclass(frozen=True, eq=False)
class ReadyCase:
    """A run whose arguments are checked, with its coupling; setup took some seconds."""

    case: PointCase
    passage: Passage[DiscreteTrack]
    coupling: PointCoupling
    integrator: Integrator
    setup: float

    @property
    def system_key(self) -> Any:
        """What runs have in common that share the factor of S."""
        passage, vehicle = self.passage, self.passage.vehicle
        matrices = (vehicle.mass, vehicle.damping, vehicle.stiffness, passage.external)
        track = passage.track
        return (
            track if isinstance(track, BeamTrack) else id(track),
            tuple(np.asarray(matrix).tobytes() for matrix in matrices),
            *(part.tobytes() for part in passage.wheels),
            self.integrator,
            passage.journey.time_step,
        )

    @property
    def for_lanes(self) -> bool:
        """Whether it is stepped in lanes: few contacts in one direction, a beam's narrow band.

        What is seen of a structure or a meshed rail, or by observers, takes all states.
        """
        track, lateral = self.passage.track, self.coupling.lateral
        by_states = isinstance(track, StructureTrack | SolidTrack)
        if self.case.observers or lateral is not None or by_states:
            return False
        rows, columns = track.stiffness.nonzero()
        few = len(self.coupling.static_loads) < FEWEST
        return few and int(np.abs(rows - columns).max()) <= NARROW

    @property
    def told(self) -> dict[str, object]:
        """Attributes of the dataset."""
        told = {
            "solver": "point",
            **described_rail(self.passage.track),
            **described_law(self.case.law),
        }
        if self.case.wheel is not None:
            told |= {"wheel": "modal", "wheel_modes": len(self.case.wheel.shapes)}
        return told


def _discretised(track: Track, vehicle: Vehicle) -> DiscreteTrack:
    """The paper's beam, or the track on a bridge, in the motions it says or the vehicle has."""
    if track.structure is None:
        return BeamTrack(track)
    return StructureTrack(track, planar=track.structure.planar_under(vehicle.contact_directions))


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
    if isinstance(law, PatchLaw):
        felt, along = passage.seen(law)
    else:
        felt, along = passage.felt(contact_filter), np.zeros((*shape, 0))
    # a spring gives back no more than it stands for: a stiff one presses on the centre line
    top = np.maximum(track.top_load_compliance(x), -law.softness)
    rows, compliance = passage.rail_rows, track.local_compliance(x) + top
    deflection = compliance
    if isinstance(track, SolidTrack) and law.softness > 0.0:
        crown = Crown(track)
        if (given := crown.compliance(x)).min() >= -law.softness:
            rows, compliance, deflection = passage.rows_of(crown), given, crown.residual(x)
    gaps = PointGaps(
        _wheel_rows(passage, wheel),
        rows.at,
        compliance.reshape(shape),
        deflection.reshape(shape),
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

"""Wheels that run over a track: what both solvers start from."""

from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.filters import ContactFilter
from contactstudy.contact.patch_laws import PatchLaw
from contactstudy.dynamics.banded import LinearSystem
from contactstudy.irregularity import Profile, faded
from contactstudy.solvers.journey import Journey
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.vehicle import Vehicle

T = TypeVar("T", bound=DiscreteTrack, covariant=True)


@dataclass(frozen=True)
class Passage(Generic[T]):
    """A vehicle on a track, not yet in contact, and its journey.

    Parameters
    ----------
    track : DiscreteTrack
        Static loads act in its direction "Z" only.
    irregularity : Profile
        r(X), positive raises the running surface, before it is faded in.
    """

    track: T
    vehicle: Vehicle
    irregularity: Profile
    journey: Journey

    @property
    def system(self) -> LinearSystem:
        """Matrices of the track's dofs followed by the vehicle's."""
        return LinearSystem.stacked(self.track, self.vehicle)

    @property
    def n_dofs(self) -> int:
        """Number of dofs of track and vehicle."""
        return self.track.n_dofs + self.vehicle.n_dofs

    @property
    def wheel_dofs(self) -> IntArray:
        """(nw,) dofs of the system that are wheels."""
        return self.track.n_dofs + np.asarray(self.vehicle.wheel_dofs, dtype=np.int64)

    @property
    def static_loads(self) -> Array:
        """(nw,) static load of each wheel in the direction of the analysis [N]."""
        loads = np.asarray(self.vehicle.static_loads, dtype=float)
        return loads if self.track.direction == "Z" else np.zeros_like(loads)

    @property
    def external(self) -> Array:
        """(n_dofs,) constant load: minus the static load on each wheel."""
        load = np.zeros(self.n_dofs)
        np.add.at(load, self.wheel_dofs, -self.static_loads)
        return load

    @cached_property
    def positions(self) -> Array:
        """X of each wheel at each state, (n_times, nw) m."""
        return self.journey.wheel_positions(self.vehicle.wheel_offsets)

    @cached_property
    def roughness(self) -> Array:
        """(n_times, nw) r under each wheel, faded in from its start [m]."""
        return self.felt()

    def felt(self, contact_filter: ContactFilter | None = None) -> Array:
        """(n_times, nw) what each wheel feels of the faded irregularity [m]; r without a filter."""
        felt = contact_filter or (lambda level, x: level(x))
        ways = np.ascontiguousarray(self.positions.T)
        return np.column_stack([felt(self.faded(k), x) for k, x in enumerate(ways)])

    def seen(self, law: PatchLaw) -> tuple[Array, Array]:
        """What each wheel feels at first touch (n_times, nw), the shape (n_times, nw, m) [m]."""
        ways = np.ascontiguousarray(self.positions.T)
        seen = [law.seen(self.faded(k), x) for k, x in enumerate(ways)]
        m = max(shape.shape[1] for _, shape in seen)
        # where a bedding reaches less far: never touched
        shapes = [
            np.pad(shape, ((0, 0), (0, m - shape.shape[1])), constant_values=-1.0)
            for _, shape in seen
        ]
        return np.column_stack([felt for felt, _ in seen]), np.stack(shapes, axis=1)

    def faded(self, wheel: int) -> Profile:
        """The irregularity as a wheel meets it, faded in from its start."""
        return faded(self.irregularity, float(self.positions[0, wheel]), self.journey.fade_in)

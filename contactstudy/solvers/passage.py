"""Wheels that run over a track: what both solvers start from."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.contact.filters import ContactFilter
from contactstudy.contact.patch_laws import PatchLaw
from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.rows import add_rows
from contactstudy.irregularity import Profile, SmoothRail, faded
from contactstudy.irregularity.fade import SharedProfile
from contactstudy.irregularity.mirrored import mirrored
from contactstudy.irregularity.rails import RailProfiles
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.travelling import TravellingRows, UnderWheels
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.rail import Direction
from contactstudy.vehicle import Vehicle, turned

T = TypeVar("T", bound=DiscreteTrack, covariant=True)


@dataclass(frozen=True)
class Passage(Generic[T]):
    """A vehicle on a track, not yet in contact, and its journey.

    Parameters
    ----------
    track : DiscreteTrack
        Static loads act in its direction "Z" only.
    irregularity : Profile or RailProfiles
        r(X), positive raises the running surface, before it is faded in; of each rail and
        direction, or of the vertical one of both rails.
    """

    track: T
    vehicle: Vehicle
    irregularity: Profile | RailProfiles
    journey: Journey

    @property
    def system(self) -> LinearSystem:
        """Matrices of the track's dofs followed by the vehicle's."""
        return LinearSystem.stacked(self.track, self.vehicle)

    @property
    def n_dofs(self) -> int:
        """Number of dofs of track and vehicle."""
        return self.track.n_dofs + self.vehicle.n_dofs

    @cached_property
    def _running(self) -> Vehicle:
        """The vehicle as it stands on the track."""
        return turned(self.vehicle) if self.journey.travel == "backward" else self.vehicle

    @cached_property
    def wheels(self) -> tuple[IntArray, Array]:
        """Dofs of the system and weights (nc, j) of the tread's displacement at each contact."""
        rows = self._running.contact_rows
        most = max(1, int(np.count_nonzero(rows, axis=1).max()))
        dofs = np.argsort(rows == 0.0, axis=1, kind="stable")[:, :most]
        return self.track.n_dofs + dofs, np.take_along_axis(rows, dofs, axis=1)

    @cached_property
    def directions(self) -> tuple[Direction, ...]:
        """Direction of each contact; of a planar vehicle the track's."""
        vehicle = self.vehicle
        if vehicle.planar:
            return (self.track.direction,) * vehicle.n_contacts
        return tuple("Y" if one == "Y" else "Z" for one in vehicle.contact_directions)

    @cached_property
    def lateral(self) -> BoolArray:
        """(nc,) contacts beside the rail, where others are on top of it."""
        there = np.array([one == "Y" for one in self.directions])
        return there if not there.all() else np.zeros_like(there)

    @property
    def static_loads(self) -> Array:
        """(nc,) static load of each contact in the direction of the analysis [N]."""
        loads = np.asarray(self.vehicle.static_loads, dtype=float)
        return loads if self.track.direction == "Z" else np.zeros_like(loads)

    @property
    def external(self) -> Array:
        """(n_dofs,) constant load: minus the static load on each wheel."""
        load = np.zeros(self.n_dofs)
        add_rows(*self.wheels, -self.static_loads, load)
        return load

    @cached_property
    def way(self) -> Array:
        """Way of each contact from the end of the track where it enters, (n_times, nc) m."""
        return self.journey.wheel_positions(self.vehicle.contact_offsets)

    @cached_property
    def positions(self) -> Array:
        """X of each contact at each state, (n_times, nc) m."""
        if self.journey.travel == "backward":
            return self.track.track.length - self.way
        return self.way

    @property
    def rails(self) -> IntArray:
        """(nc,) rail of the track under each contact."""
        return np.asarray(self._running.contact_rails)

    @cached_property
    def rail_rows(self) -> TravellingRows:
        """Rows of the rail under each contact."""
        return self.rows_of(self.track)

    def rows_of(self, under: UnderWheels) -> TravellingRows:
        """Rows of what is under each contact."""
        return TravellingRows(under, self.positions, self.rails, self.directions)

    @cached_property
    def roughness(self) -> Array:
        """(n_times, nc) r at each contact, faded in from its start [m]."""
        return self._each(lambda contact, x: self.faded(contact)(x))

    def felt(self, contact_filter: ContactFilter | None = None) -> Array:
        """(n_times, nc) what each contact feels of the faded irregularity [m]; r without a filter.

        Lateral contacts have no filter.
        """
        if contact_filter is None:
            return self.roughness

        def along(contact: int, x: Array) -> Array:
            level = self.faded(contact)
            return level(x) if self.directions[contact] == "Y" else contact_filter(level, x)

        return self._each(along)

    def _each(self, along: Callable[[int, Array], Array]) -> Array:
        """A function of contact and way (n_times,), once for contacts on one rail at one place."""
        found = np.empty(self.way.shape)
        rails, known = self.vehicle.contact_rails, dict[tuple[object, ...], int]()
        for k, x in enumerate(np.ascontiguousarray(self.way.T)):
            same = int(rails[k]), self.directions[k], float(x[0])
            if isinstance(self.irregularity, RailProfiles) or same[1] == "Y":
                first = known.setdefault(same, k)
            else:
                first = known.setdefault(same[1:], k)
            found[:, k] = along(k, x) if first == k else found[:, first]
        return found

    def seen(self, law: PatchLaw) -> tuple[Array, Array]:
        """What each wheel feels at first touch (n_times, nw), the shape (n_times, nw, m) [m]."""
        ways = np.ascontiguousarray(self.way.T)
        seen = [law.seen(self.faded(k), x) for k, x in enumerate(ways)]
        m = max(shape.shape[1] for _, shape in seen)
        # where a bedding reaches less far: never touched
        shapes = [
            np.pad(shape, ((0, 0), (0, m - shape.shape[1])), constant_values=-1.0)
            for _, shape in seen
        ]
        # contacts beside the rail have a law of their own
        felt = np.where(self.lateral, self.roughness, np.column_stack([one for one, _ in seen]))
        return felt, np.stack(shapes, axis=1)

    def faded(self, contact: int) -> Profile:
        """The irregularity over the way of a contact, faded in from its start on the track.

        There is none on ground beyond the ends of a track.
        """
        profile, start = self._profile(contact), max(float(self.way[0, contact]), 0.0)
        length, backward = self.track.track.length, self.journey.travel == "backward"
        if backward:
            profile = mirrored(profile, length)
        level = faded(profile, start, self.journey.fade_in)
        if self.track.track.structure is None:
            return level
        return SharedProfile(level, lambda x: self.track.on_track(length - x if backward else x))

    def _profile(self, contact: int) -> Profile:
        rails, direction = self._running.contact_rails, self.directions[contact]
        if isinstance(self.irregularity, RailProfiles):
            return self.irregularity.of(int(rails[contact]), direction)
        if direction == "Y" and self.lateral[contact]:
            return SmoothRail()
        return self.irregularity

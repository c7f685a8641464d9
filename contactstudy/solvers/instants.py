"""Fields that a surface-contact run keeps at chosen instants: the patch, deformed sections."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.surface_coupling import PatchState, SurfaceCoupling
from contactstudy.dynamics.stepper import Coupling, State
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import Observer, Watch
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.patch_fields import (
    node_coordinates,
    node_fields,
    point_fields,
    stress_variables,
    surface_of,
)
from contactstudy.track.discrete import DiscreteTrack

if TYPE_CHECKING:
    import xarray as xr

Kept = TypeVar("Kept")


class KeptStates(Watch, Generic[Kept]):
    """Keeps something of the states at some steps of a surface-contact run.

    Attributes
    ----------
    dim : str
        Dimension of what is kept, one entry a state.
    kept : list
        Position of the wheel [m], time [s] and what is kept of each state.
    """

    dim: ClassVar[str]

    def __init__(
        self, passage: Passage[DiscreteTrack], coupling: SurfaceCoupling, steps: IntArray
    ) -> None:
        self.coupling, self.kept = coupling, list[tuple[float, float, Kept]]()
        self._passage, self._steps = passage, set(steps.tolist())

    @abstractmethod
    def keep(self, state: State, patch: PatchState, position: float) -> Kept:
        """What is kept of a state, the wheel at `position` [m]."""

    @abstractmethod
    def add(self, data: xr.Dataset) -> xr.Dataset:
        """Add what was kept to the dataset of the run."""

    def see(self, state: State) -> None:
        """Keep of the state if it is one of those wanted."""
        if state.step in self._steps and state.contact is not None:
            x = float(self._passage.positions[state.step, 0])
            self.kept.append((x, state.time, self.keep(state, state.contact.state, x)))

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add what was kept, and where and when."""
        if not self.kept:
            return data
        at, times, _ = zip(*self.kept, strict=True)
        time = {"units": "s", "long_name": "time"}
        where = {"units": "m", "long_name": "position of the wheel"}
        return self.add(data).assign_coords(
            node_coordinates(self.coupling.wheel.points)
            | {
                f"{self.dim}_time": (self.dim, np.array(times), time),
                f"{self.dim}_position": (self.dim, np.array(at), where),
            }
        )


@dataclass(frozen=True)
class AtPositions(Observer):
    """Keeps something of surface contact at the steps nearest to positions of the wheel [m]."""

    at: tuple[float, ...]

    key: ClassVar[str]  # what complaints call `at`
    watching: ClassVar[type[KeptStates[Any]]]

    def problems_on(self, journey: Journey) -> list[str]:
        """Positions that the wheel does not pass."""
        return journey.not_passed(self.key, self.at)

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        return self.watching(passage, surface_of(coupling), passage.journey.steps_at(self.at))


@dataclass(frozen=True)
class _Contact:
    wheel: Array  # displacements of the hub and of its modes
    patch: PatchState
    rail: Array  # displacement (k, 2) of the section's nodes


class _Instants(KeptStates[_Contact]):
    dim = "instant"

    def keep(self, state: State, patch: PatchState, position: float) -> _Contact:
        """The contact and the sections there."""
        section = self.coupling.section(position)
        moved = section.map @ state.u[section.dofs] - section.residual @ patch.surface_load
        return _Contact(state.u[self.coupling.wheel.dofs], patch, moved)

    def add(self, data: xr.Dataset) -> xr.Dataset:
        """Add the fields of the patch, stress maxima and deformed sections."""
        wheel, kept = self.coupling.wheel, [contact for _, _, contact in self.kept]
        points, body, dim = wheel.points, wheel.body, self.dim
        fields = node_fields(
            points, [k.patch.forces for k in kept], [k.patch.gap for k in kept], dim
        )
        pressure = np.asarray(fields["pressure"].values)
        fields |= point_fields(points, [k.patch.forces for k in kept], dim)
        poisson_ratio = self.coupling.track.recipe.poisson_ratio
        section = self.coupling.section(self.kept[0][0])
        moved = wheel.section_displacement(kept[0].patch.forces, kept[0].wheel)
        metre = {"units": "m"}
        plane = metre | {"section_position": section.position}
        data = data.assign(fields | stress_variables(points, pressure, poisson_ratio, dim))
        return data.assign(
            section_wheel_nodes=(("wheel_node", "axis"), body.section_nodes, metre),
            section_wheel_quads=(("wheel_quad", "corner"), body.section_quads),
            section_wheel_displacement=(("wheel_node", "axis"), moved, metre),
            section_rail_nodes=(("rail_node", "axis"), section.nodes, metre),
            section_rail_quads=(("rail_quad", "corner"), section.quads),
            section_rail_displacement=(("rail_node", "axis"), kept[0].rail, plane),
        )


@dataclass(frozen=True)
class Instants(AtPositions):
    """Keeps the contact at the steps nearest to positions of the wheel [m].

    Surface contact only; the dataset gets `pressure`, `gap` and `contact_status`
    (instant, point) at the tread nodes, `contact_pressure` (instant, contact_point) at the contact
    points, the largest stresses below the patch, `von_mises` and `maximum_shear` (instant) with
    `_depth`, `_x` and `_y`, and the deformed sections of wheel and rail at the first instant.
    """

    key: ClassVar = "pressure_at"
    watching: ClassVar = _Instants

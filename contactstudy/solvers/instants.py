"""Fields that a surface-contact run keeps at chosen instants: the patch, deformed sections."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

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
    stress_variables,
    surface_of,
)
from contactstudy.track.discrete import DiscreteTrack

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Instants(Observer):
    """Keeps the contact at the steps nearest to positions of the wheel [m].

    Surface contact only; the dataset gets `pressure`, `gap` and `contact_status`
    (instant, point) at the tread nodes, the largest stresses below the patch, `von_mises` and
    `maximum_shear` (instant) with `_depth`, `_x` and `_y`, and the deformed sections of wheel
    and rail at the first instant.
    """

    at: tuple[float, ...]

    def problems_on(self, journey: Journey) -> list[str]:
        """Positions that the wheel does not pass."""
        return journey.not_passed("pressure_at", self.at)

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        return _Instants(passage, surface_of(coupling), passage.journey.steps_at(self.at))


@dataclass(frozen=True)
class _Kept:
    position: float
    time: float
    wheel: Array  # displacements of the hub and of its modes
    patch: PatchState
    rail: Array  # displacement (k, 2) of the section's nodes


class _Instants(Watch):
    def __init__(
        self, passage: Passage[DiscreteTrack], coupling: SurfaceCoupling, steps: IntArray
    ) -> None:
        self._passage, self._coupling = passage, coupling
        self._steps = set(steps.tolist())
        self._kept: list[_Kept] = []

    def see(self, state: State) -> None:
        """Keep the contact of the state if it is one of those wanted."""
        if state.step not in self._steps or state.contact is None:
            return
        x, patch = float(self._passage.positions[state.step, 0]), state.contact.state
        section = self._coupling.section(x)
        moved = section.map @ state.u[section.dofs] - section.residual @ patch.surface_load
        wheel = state.u[self._coupling.wheel.dofs]
        self._kept.append(_Kept(x, state.time, wheel, patch, moved))

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add the fields of the patch, stress maxima and deformed sections."""
        if not self._kept:
            return data
        wheel, kept = self._coupling.wheel, self._kept
        points, body = wheel.points, wheel.body
        forces, gaps = [k.patch.forces for k in kept], [k.patch.gap for k in kept]
        fields = node_fields(points, forces, gaps, "instant")
        pressure = np.asarray(fields["pressure"].values)
        poisson_ratio = self._coupling.track.recipe.poisson_ratio
        first = kept[0]
        section = self._coupling.section(first.position)
        moved = wheel.section_displacement(first.patch.forces, first.wheel)
        metre = {"units": "m"}
        plane = metre | {"section_position": section.position}
        data = data.assign(fields | stress_variables(points, pressure, poisson_ratio, "instant"))
        data = data.assign(
            section_wheel_nodes=(("wheel_node", "axis"), body.section_nodes, metre),
            section_wheel_quads=(("wheel_quad", "corner"), body.section_quads),
            section_wheel_displacement=(("wheel_node", "axis"), moved, metre),
            section_rail_nodes=(("rail_node", "axis"), section.nodes, metre),
            section_rail_quads=(("rail_quad", "corner"), section.quads),
            section_rail_displacement=(("rail_node", "axis"), first.rail, plane),
        )
        times = {"units": "s", "long_name": "time"}
        where = metre | {"long_name": "position of the wheel"}
        return data.assign_coords(
            node_coordinates(points)
            | {
                "instant_time": ("instant", np.array([k.time for k in kept]), times),
                "instant_position": ("instant", np.array([k.position for k in kept]), where),
            }
        )

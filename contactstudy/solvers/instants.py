"""Fields that a surface-contact run keeps at chosen instants: the patch, deformed sections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.surface import PatchState, SurfaceCoupling
from contactstudy.dynamics.stepper import State
from contactstudy.geometry.points import ContactPoints
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.solids.wheel_modes import WheelModes, residual_flexibility
from contactstudy.solvers.patch_fields import node_coordinates, node_fields, stress_variables
from contactstudy.track.solid import SolidTrack
from contactstudy.track.unreduced import UnreducedTrack

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class _Kept:
    position: float
    time: float
    wheel: Array  # displacements of the hub and of its modes
    state: PatchState
    rail: Array  # displacement (k, 2) of the section's nodes
    plane: float  # X of that section


class Instants:
    """Keeps the contact at the steps nearest to given positions.

    Parameters
    ----------
    coupling : SurfaceCoupling
        Of the run.
    track : SolidTrack or UnreducedTrack
    positions : ndarray (n_times,)
        X of the wheel at every state in m.
    at : sequence of float
        Positions wanted in m.
    """

    def __init__(
        self,
        coupling: SurfaceCoupling,
        track: SolidTrack | UnreducedTrack,
        positions: Array,
        at: Sequence[float],
    ) -> None:
        self._coupling, self._track, self._positions = coupling, track, positions
        self._steps = {int(np.argmin(np.abs(positions - x))) for x in at}
        self._kept: list[_Kept] = []

    def __call__(self, state: State) -> None:
        """See a state of the run; keep it if it is one of those wanted."""
        if state.step not in self._steps:
            return
        x, last = float(self._positions[state.step]), self._coupling.last
        section = self._track.section(x, self._coupling.half_length)
        self._kept.append(
            _Kept(
                x,
                state.time,
                state.u[self._coupling.wheel_dofs],
                last,
                section.map @ state.u[section.dofs] - section.residual @ last.surface_load,
                section.position,
            )
        )

    def into(
        self,
        data: xr.Dataset,
        points: ContactPoints,
        wheel: WheelFlexibility,
        modes: WheelModes | None = None,
    ) -> xr.Dataset:
        """Add the fields of the patch, stress maxima and deformed sections to a dataset."""
        if not self._kept:
            return data
        n = len(wheel.x) * len(wheel.y)
        tread = points.wheel_rows.matrix(n)
        fields = node_fields(
            points,
            [k.state.forces for k in self._kept],
            [k.state.gap for k in self._kept],
            "instant",
        )
        stresses = stress_variables(
            points,
            np.asarray(fields["pressure"].values),
            self._track.recipe.poisson_ratio,
            "instant",
        )
        first = self._kept[0]
        body = wheel if modes is None else residual_flexibility(wheel, modes)
        moved = body.section_response @ (tread.T @ first.state.forces) + [0.0, first.wheel[0]]
        if modes is not None:
            moved += np.einsum("m,mkc->kc", first.wheel[1:], modes.section_shapes)
        section = self._track.section(first.position, self._coupling.half_length)
        metre = {"units": "m"}

        def coordinate(values: Array, unit: str, text: str, dim: str) -> tuple:
            return (dim, values, {"units": unit, "long_name": text})

        data = data.assign(fields | stresses)
        data = data.assign(
            section_wheel_nodes=(("wheel_node", "axis"), wheel.section_nodes, metre),
            section_wheel_quads=(("wheel_quad", "corner"), wheel.section_quads),
            section_wheel_displacement=(("wheel_node", "axis"), moved, metre),
            section_rail_nodes=(("rail_node", "axis"), section.nodes, metre),
            section_rail_quads=(("rail_quad", "corner"), section.quads),
            section_rail_displacement=(
                ("rail_node", "axis"),
                first.rail,
                metre | {"section_position": first.plane},
            ),
        )
        data = data.assign_coords(node_coordinates(points))
        return data.assign_coords(
            instant_time=coordinate(np.array([k.time for k in self._kept]), "s", "time", "instant"),
            instant_position=coordinate(
                np.array([k.position for k in self._kept]), "m", "position of the wheel", "instant"
            ),
        )

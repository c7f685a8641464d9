"""The wheel's side of surface contact: how its dofs and forces move the contact points."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.geometry.points import ContactPoints
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.solids.wheel_modes import WheelModes


@dataclass(frozen=True, eq=False)
class MovingWheel:
    """A wheel as the contact points on its tread see it.

    Parameters
    ----------
    body : WheelFlexibility
        Its quasi-static flexibility relative to the hub, without the share of the modes.
    dofs : ndarray of int (1 + m,)
        Dofs of the system that are the displacement of the hub, up, and the elastic modes.
    modes : WheelModes or None
        The m modes; None: m = 0.
    """

    points: ContactPoints
    body: WheelFlexibility
    dofs: IntArray
    modes: WheelModes | None = None

    @cached_property
    def tread(self) -> Array:
        """Interpolation from the tread nodes to the points, (n, nodes)."""
        return self.points.wheel_rows.matrix(len(self.body.flexibility))

    @cached_property
    def map(self) -> Array:
        """G, (n, 1 + m): the gap grows by ``G w`` with the displacements w of the dofs."""
        normal = self.points.normal_z[:, None]
        return (
            normal if self.modes is None else np.hstack([normal, self.tread @ self.modes.shapes.T])
        )

    @cached_property
    def flexibility(self) -> Array:
        """Of the points relative to the dofs, (n, n) [m/N]."""
        return self.tread @ self.body.flexibility @ self.tread.T

    def peak_pressure(self, forces: Array) -> float:
        """Largest pressure at a tread node in Pa for forces (n,) at the points in N."""
        return float((self.tread.T @ forces / self._node_area).max())

    @cached_property
    def _node_area(self) -> Array:
        return self.tread.T @ self.points.area

    def section_displacement(self, forces: Array, w: Array) -> Array:
        """Displacement (k, 2) of the section's nodes in m under forces at the points."""
        moved = self.body.section_response @ (self.tread.T @ forces) + [0.0, w[0]]
        if self.modes is not None:
            moved += np.einsum("m,mkc->kc", w[1:], self.modes.section_shapes)
        return np.asarray(moved)

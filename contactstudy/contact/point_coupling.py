"""Point contact: a law between the wheel and the rail at the wheel's position.

The paper's eqs (4)-(6) put k_r between the wheel and the interpolated rail, with shape
functions N at the wheel: the gap row is B = (+1 on the wheel, -N on the rail), and

    g = B u + c lambda - r(X),

c being the compliance of the loaded element itself, which N leaves out (0 in the paper). A
positive r raises the running surface. Literal eq. (6), f_r = (N, -1) k_r r, pushes the rail up
and the wheel down for positive r, so its positive r is a dip: r here is minus the paper's.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.contact.laws import Law, MovingForce, point_forces
from contactstudy.contact.many_contacts import FEWEST, AttachedMany
from contactstudy.contact.two_directions import forces_in_two_directions
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import LocalColumns, add_columns, compliance
from contactstudy.dynamics.rows import add_rows, row_values
from contactstudy.dynamics.stepper import ContactStep


@dataclass(frozen=True)
class PointGaps:
    """Gap of every contact at every state, g = B u + c lambda - r, r (n_times, nc) in m.

    Parameters
    ----------
    wheels : tuple of ndarray
        Dofs and weights (nc, j) of the wheels at the contact: +1 for a displacement, then those
        of elastic modes.
    rail : callable
        From the step to dofs and weights (nc, k) of the rail's row N.
    compliance : ndarray (n_times, nc)
        c [m/N]. Two wheels within one element do not share it: each feels its own.
    shape : ndarray (n_times, nc, m)
        Of the profile under each wheel, for the laws of `contact.patch_laws` [m]; else m = 0.
    """

    wheels: tuple[IntArray, Array]
    rail: Callable[[int], tuple[IntArray, Array]]
    compliance: Array
    irregularity: Array
    shape: Array

    def rows(self, step: int) -> tuple[IntArray, Array]:
        """Dofs and weights (nc, j + k) of B at a step."""
        return self.joined(*self.rail(step))

    def joined(self, rail_dofs: IntArray, rail: Array) -> tuple[IntArray, Array]:
        """Those of B from the rail's (..., nc, k): the wheels' less the rail's."""
        # B = (1, -N)
        (wheel_dofs, wheel), shape = self.wheels, (*rail.shape[:-1], self.wheels[0].shape[-1])
        dofs = np.concatenate((np.broadcast_to(wheel_dofs, shape), rail_dofs), axis=-1)
        return dofs, np.concatenate((np.broadcast_to(wheel, shape), -rail), axis=-1)


@dataclass(frozen=True)
class PointCoupling:
    """One point under every wheel, with all positions known in advance; it has no memory.

    Parameters
    ----------
    static_loads : ndarray
        (nc,) [N].
    bilateral : bool
        The contacts hold in tension (a lateral analysis).
    lateral : ndarray of bool, optional
        (nc,) contacts beside the rail, by the linear spring `lateral_stiffness` [N/m].
    """

    law: Law
    gaps: PointGaps
    static_loads: Array
    bilateral: bool = False
    lateral: BoolArray | None = None
    lateral_stiffness: float = math.inf

    @property
    def accuracy(self) -> float:
        """Relative accuracy of the forces: rounding."""
        return 1e-11

    def start(self) -> None:
        """No state."""

    def attached(self, factor: Factor, scale: float) -> "AttachedPoint | AttachedMany":
        """Join to a system."""
        made = AttachedPoint if len(self.static_loads) < FEWEST else AttachedMany
        return made(self, factor, scale)

    def forces(self, step: int, compliance: Array, free_gap: Array) -> Array:
        """Forces (nc,) at the end of a step, for W and g*."""
        law, shape, loads = self.law, self.gaps.shape[step], self.static_loads
        if self.lateral is None:
            return point_forces(law, compliance, free_gap, loads, self.bilateral, shape)
        if isinstance(law, MovingForce):
            return loads
        top = ~self.lateral
        return forces_in_two_directions(
            self.lateral,
            self.lateral_stiffness,
            compliance,
            free_gap,
            lambda W, g: point_forces(law, W, g, loads[top], False, shape[top]),
        )


class AttachedPoint:
    """A `PointCoupling` on the system with the compliance scale * S^-1.

    Between calls it keeps the columns of S^-1 near the wheels, and no state of the contact.
    """

    def __init__(self, coupling: PointCoupling, factor: Factor, scale: float) -> None:
        self._coupling, self._scale = coupling, scale
        self._columns, self._work = LocalColumns(factor), np.zeros(factor.n)

    def compliance(self, step: int) -> Array:
        """W (nc, nc) at a step [m/N]."""
        return self._compliance(step, *self._coupling.gaps.rows(step))

    def _compliance(self, step: int, dofs: IntArray, weights: Array) -> Array:
        columns = self._columns.at(dofs)
        # W_ij = (1-af) B_i S^-1 B_j^T, and the loaded element's own share on the diagonal
        W: Array = self._scale * compliance(columns, dofs, weights, self._work)
        W.flat[:: len(dofs) + 1] += self._coupling.gaps.compliance[step]
        return W

    def __call__(self, step: int, u_free: Array, state: None) -> ContactStep:
        """Forces at the end of a step; every row adds up, two wheels in one element too."""
        coupling, gaps = self._coupling, self._coupling.gaps
        dofs, weights = gaps.rows(step)
        W = self._compliance(step, dofs, weights)
        free_gap = row_values(dofs, weights, u_free) - gaps.irregularity[step]
        force = coupling.forces(step, W, free_gap)
        load, increment = np.zeros_like(u_free), np.zeros_like(u_free)
        add_rows(dofs, weights, force, load)
        columns = self._columns.at(dofs)
        add_columns(columns, dofs, weights, self._scale * force, increment)
        residual = -gaps.compliance[step] * force
        return ContactStep(load, increment, {"contact_force": force, "rail_residual": residual})

"""Point contact: a law between the wheel and the rail at the wheel's position.

The paper's eqs (4)-(6) put k_r between the wheel and the interpolated rail, with shape
functions N at the wheel: the gap row is B = (+1 on the wheel, -N on the rail), and

    g = B u + c lambda - r(X),

c being the compliance of the loaded element itself, which N leaves out (0 in the paper). A
positive r raises the running surface. Literal eq. (6), f_r = (N, -1) k_r r, pushes the rail up
and the wheel down for positive r, so its positive r is a dip: r here is minus the paper's.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.laws import Law, point_forces
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import LocalColumns, add_columns, compliance
from contactstudy.dynamics.rows import add_rows, row_values
from contactstudy.dynamics.stepper import ContactStep


@dataclass(frozen=True)
class PointGaps:
    """Gap of every wheel at every state, g = B u + c lambda - r, r (n_times, nw) in m.

    Parameters
    ----------
    dofs, weights : ndarray (n_times, nw, k)
        Rows B.
    compliance : ndarray (n_times, nw)
        c [m/N]. Two wheels within one element do not share it: each feels its own.
    shape : ndarray (n_times, nw, m)
        Of the profile under each wheel, for the laws of `contact.patch_laws` [m]; else m = 0.
    """

    dofs: IntArray
    weights: Array
    compliance: Array
    irregularity: Array
    shape: Array

    @staticmethod
    def rows(
        wheel_dofs: IntArray, wheel_weights: Array, rail_dofs: IntArray, rail_weights: Array
    ) -> tuple[IntArray, Array]:
        """B from the wheels' rows (nw, j), j = 1 without modes, less the rail's (n_times, nw, k-j).

        Weights of a wheel: +1 for its displacement, then those of its modes at the contact.
        """
        shape = (*rail_dofs.shape[:2], wheel_dofs.shape[1])
        dofs = np.concatenate((np.broadcast_to(wheel_dofs, shape), rail_dofs), axis=2)
        wheel = np.broadcast_to(wheel_weights, shape)
        return dofs, np.concatenate((wheel, -rail_weights), axis=2)


@dataclass(frozen=True)
class PointCoupling:
    """One point under every wheel, with all positions known in advance; it has no memory.

    Static loads (nw,) in N; bilateral: the contact holds in tension (lateral direction).
    """

    law: Law
    gaps: PointGaps
    static_loads: Array
    bilateral: bool = False

    @property
    def accuracy(self) -> float:
        """Relative accuracy of the forces: rounding."""
        return 1e-11

    def start(self) -> None:
        """No state."""

    def attached(self, factor: Factor, scale: float) -> "AttachedPoint":
        """Join to a system."""
        return AttachedPoint(self, factor, scale)


class AttachedPoint:
    """A `PointCoupling` on the system with the compliance scale * S^-1.

    Between calls it keeps the columns of S^-1 near the wheels, and no state of the contact.
    """

    def __init__(self, coupling: PointCoupling, factor: Factor, scale: float) -> None:
        self._coupling, self._scale = coupling, scale
        self._columns, self._work = LocalColumns(factor), np.zeros(factor.n)

    def __call__(self, step: int, u_free: Array, state: None) -> ContactStep:
        """Forces at the end of a step; every row adds up, two wheels in one element too."""
        coupling, gaps = self._coupling, self._coupling.gaps
        dofs, weights, local = gaps.dofs[step], gaps.weights[step], gaps.compliance[step]
        columns = self._columns.at(dofs)
        # W_ij = (1-af) B_i S^-1 B_j^T, and the loaded element's own share on the diagonal
        W = self._scale * compliance(columns, dofs, weights, self._work)
        W.flat[:: len(dofs) + 1] += local
        free_gap = row_values(dofs, weights, u_free) - gaps.irregularity[step]
        loads, bilateral = coupling.static_loads, coupling.bilateral
        force = point_forces(coupling.law, W, free_gap, loads, bilateral, gaps.shape[step])
        load, increment = np.zeros_like(u_free), np.zeros_like(u_free)
        add_rows(dofs, weights, force, load)
        add_columns(columns, dofs, weights, self._scale * force, increment)
        return ContactStep(
            load, increment, {"contact_force": force, "rail_residual": -local * force}
        )

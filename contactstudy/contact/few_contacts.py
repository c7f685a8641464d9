"""Few contacts on one system: what they move comes from columns of S^-1."""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.point_gaps import PointContacts
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import LocalColumns, add_columns, compliance
from contactstudy.dynamics.rows import add_rows, row_values
from contactstudy.dynamics.stepper import ContactStep


class AttachedFew:
    """Contacts at points on the system with the compliance scale * S^-1.

    Between calls it keeps the columns of S^-1 near the wheels, and no state of the contact.
    """

    def __init__(self, coupling: PointContacts, factor: Factor, scale: float) -> None:
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
        residual = -gaps.deflection[step] * force
        return ContactStep(load, increment, {"contact_force": force, "rail_residual": residual})

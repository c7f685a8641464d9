"""Many contacts on one system: nearby ones share a compliance, one solution moves everything.

What the forces of a long train move is a matter of one banded solution a step, however many wheels
there are. What the contacts need beforehand, W = B S^-1 B^T, is local: in one time step a load on a
rail is felt some metres away (5 m away 4e-9 of it at 0.2 ms, 4e-7 at 0.5 ms on a track of 60E1 on
a concrete box). So columns of S^-1 are cut where they fall below `CUT` of their largest value, and
what that leaves out is seen afterwards, for the solution has all of it: with the gaps that it
shows the forces are found again if the law is missed by more than `TOLERANCE`.
"""

from __future__ import annotations

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled
from contactstudy.contact.point_gaps import PointContacts
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import Columns, LocalColumns
from contactstudy.dynamics.rows import add_rows, row_values
from contactstudy.dynamics.stepper import ContactStep
from contactstudy.exceptions import NumericalError

FEWEST = 12
"""Contacts from which on one more banded solution costs less than adding up columns."""
CUT = 1e-8
"""Of the largest value of a column, where it ends."""
TOLERANCE = 1e-7
"""Error of a gap, relative to the largest change that the contact forces make of one."""
_MEMORY = 512e6  # bytes of columns: those under a train of 300 m on two rails
_WIDE = 256e6  # bytes of columns that are not worth keeping: of a static system, which are global
_MOST = 50  # solutions


class AttachedMany:
    """Many contacts at points on the system with the compliance scale * S^-1.

    Between calls it keeps columns of S^-1, and no state of the contact.
    """

    def __init__(self, coupling: PointContacts, factor: Factor, scale: float) -> None:
        self._coupling, self._factor, self._scale = coupling, factor, scale
        self._columns = LocalColumns(factor, _MEMORY, CUT)
        self._exact: tuple[int, Array] | None = None
        dofs, weights = coupling.gaps.rows(0)
        used = np.unique(dofs[weights != 0.0])
        probe = used[:: max(1, len(used) // 8)]
        width = int(self._columns.at(probe).width[probe].max())
        self._global = len(used) * width * 8 > _WIDE

    def compliance(self, step: int) -> Array:
        """W (nc, nc) at a step, but for what far contacts do to each other [m/N]."""
        return self._compliance(step, *self._coupling.gaps.rows(step))

    def _compliance(self, step: int, dofs: IntArray, weights: Array) -> Array:
        if self._global:
            W = self._solved(step, dofs, weights)
        else:
            W = nearby_compliance(
                self._columns.at(dofs), dofs, weights, self._coupling.gaps.wheels[0].shape[1]
            )
        W = self._scale * W
        W.flat[:: len(dofs) + 1] += self._coupling.gaps.compliance[step]
        return W

    def _solved(self, step: int, dofs: IntArray, weights: Array) -> Array:
        """B S^-1 B^T with one solution a contact; kept, as a static start asks for one step."""
        if self._exact is None or self._exact[0] != step:
            W = np.empty((len(dofs), len(dofs)))
            for k in range(len(dofs)):
                load = np.zeros(self._factor.n)
                add_rows(dofs[k : k + 1], weights[k : k + 1], np.ones(1), load)
                W[:, k] = row_values(dofs, weights, self._factor.solve(load))
            self._exact = step, 0.5 * (W + W.T)
        return self._exact[1]

    def __call__(self, step: int, u_free: Array, state: None) -> ContactStep:
        """Forces at the end of a step, and what they move."""
        coupling, gaps = self._coupling, self._coupling.gaps
        dofs, weights = gaps.rows(step)
        W, local = self._compliance(step, dofs, weights), gaps.compliance[step]
        free_gap = row_values(dofs, weights, u_free) - gaps.irregularity[step]
        far = np.zeros(len(free_gap))
        for _ in range(_MOST):
            force = coupling.forces(step, W, free_gap + far)
            load = np.zeros_like(u_free)
            add_rows(dofs, weights, force, load)
            increment = self._scale * self._factor.solve(load)
            moved = row_values(dofs, weights, increment) + local * force
            # what W leaves out of the gaps that these forces make
            before, far = far, moved - W @ force
            if np.abs(far - before).max() <= TOLERANCE * np.abs(moved).max():
                residual = -gaps.deflection[step] * force
                record = {"contact_force": force, "rail_residual": residual}
                return ContactStep(load, increment, record)
            if not np.all(np.isfinite(force)):
                break
        raise NumericalError(
            f"contact of {len(free_gap)} wheels: far wheels move each other by"
            f" {np.abs(far - before).max():.3g} m, which does not settle"
        )


@compiled
def nearby_compliance(columns: Columns, dofs: IntArray, weights: Array, of_vehicle: int) -> Array:
    """B S^-1 B^T (m, m) for rows B given by dofs and weights (m, k), as far as columns reach.

    The first `of_vehicle` dofs of a row are the vehicle's and the others the track's; between the
    two nothing but the contacts acts. Pairs of rows that do not reach each other are passed over.
    """
    first, width, begin, values = columns
    m, count = dofs.shape
    found = np.zeros((m, m))
    low, high = np.empty(m, dtype=np.int64), np.empty(m, dtype=np.int64)  # dofs of each row
    reach_low, reach_high = np.empty(m, dtype=np.int64), np.empty(m, dtype=np.int64)
    for start, stop in ((0, of_vehicle), (of_vehicle, count)):
        for i in range(m):
            low[i], high[i], reach_low[i], reach_high[i] = len(first), -1, len(first), -1
            for a in range(start, stop):
                if weights[i, a] != 0.0:
                    d = dofs[i, a]
                    low[i], high[i] = min(low[i], d), max(high[i], d)
                    reach_low[i] = min(reach_low[i], first[d])
                    reach_high[i] = max(reach_high[i], first[d] + width[d])
        for i in range(m):
            for j in range(i, m):
                if low[j] >= reach_high[i] or high[j] < reach_low[i]:
                    continue
                total = 0.0
                for a in range(start, stop):
                    d, w = dofs[i, a], weights[i, a]
                    if w == 0.0:
                        continue
                    shift = begin[d] - first[d]
                    for b in range(start, stop):
                        e = dofs[j, b]
                        if weights[j, b] != 0.0 and first[d] <= e < first[d] + width[d]:
                            total += w * weights[j, b] * values[shift + e]
                found[i, j] += total
    for i in range(m):
        for j in range(i):
            found[i, j] = found[j, i]
    return found

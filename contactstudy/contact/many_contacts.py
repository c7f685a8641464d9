"""Many contacts on one system: nearby ones share a compliance, one solution moves everything.

With S = L L^T and z_i = L^-1 B_i^T a step needs one banded solution, however many wheels there are:

    L y = rhs,   B S^-1 rhs = Z^T y,   W = B S^-1 B^T = Z^T Z,   L^T a = y + Z lambda.

With dampers over whole decks (`dynamics.dampers`) the products of z and y are y^T (1 - Y H Y^T) z.
What z_i holds is local: in one time step a load on a rail is felt some metres away (5 m away 4e-9
of it at 0.2 ms, 4e-7 at 0.5 ms on a track of 60E1 on a concrete box). So columns of L^-1 are cut
where they fall below `CUT` of their largest value. Where only the free displacements are known, as
at the static start, what the cut leaves out is seen afterwards: with the gaps that one more
solution shows the forces are found again if the law is missed by more than `TOLERANCE`.
"""

from __future__ import annotations

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled, compiled_in_any_order
from contactstudy.contact.point_gaps import PointContacts
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import Columns, LocalColumns
from contactstudy.dynamics.dampers import lessen
from contactstudy.dynamics.rows import add_rows, row_values
from contactstudy.dynamics.stepper import ContactStep
from contactstudy.dynamics.windows import product
from contactstudy.exceptions import NumericalError

FEWEST = 12
"""Contacts from which on half columns cost less than adding up whole ones."""
CUT = 1e-10
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
        self._columns = LocalColumns(factor, _MEMORY, CUT, half=True)
        self._exact: tuple[int, Array] | None = None
        dofs, weights = coupling.gaps.rows(0)
        used = np.unique(dofs[weights != 0.0])
        probe = used[:: max(1, len(used) // 8)]
        width = int(self._columns.at(probe).width[probe].max())
        self.local = len(used) * width * 8 <= _WIDE

    def compliance(self, step: int) -> Array:
        """W (nc, nc) at a step, but for what far contacts do to each other [m/N]."""
        return self._compliance(step, *self._coupling.gaps.rows(step))

    def _compliance(self, step: int, dofs: IntArray, weights: Array) -> Array:
        if not self.local:
            return self._scaled(step, self._solved(step, dofs, weights))
        W = overlaps(self._pieces(dofs, weights))
        if (spread := self._factor.spread) is not None:
            lessen(spread.moved, spread.core, dofs, weights, W)
        return self._scaled(step, W)

    def _scaled(self, step: int, W: Array) -> Array:
        W = self._scale * W
        W.flat[:: len(W) + 1] += self._coupling.gaps.compliance[step]
        return W

    def _pieces(self, dofs: IntArray, weights: Array) -> Columns:
        of_vehicle = self._coupling.gaps.wheels[0].shape[1]
        return combined(self._columns.at(dofs), dofs, weights, of_vehicle)

    def half_way(self, step: int, u_known: Array, of_a: float, half: Array) -> ContactStep:
        """See `HalfWay`."""
        coupling, gaps = self._coupling, self._coupling.gaps
        (dofs, weights), of_vehicle = gaps.rows(step), gaps.wheels[0].shape[1]
        y, spread = half[self._factor.blocks.before :], self._factor.spread
        pieces, W, free_gap = met(self._columns.at(dofs), dofs, weights, of_vehicle, y)
        if spread is not None:
            own, taken = lessen(spread.moved, spread.core, dofs, weights, W)
            seen = product(spread.rows, y)
            free_gap -= taken @ seen
        free_gap = row_values(dofs, weights, u_known) + of_a * free_gap - gaps.irregularity[step]
        force = coupling.forces(step, self._scaled(step, W), free_gap)
        load = np.zeros_like(u_known)
        add_rows(dofs, weights, force, load)
        pushed = self._scale / of_a * force
        add_pieces(pieces, pushed, y)
        if spread is not None:
            spread.take(y, spread.core @ (seen + pushed @ own))
        record = {"contact_force": force, "rail_residual": -gaps.compliance[step] * force}
        return ContactStep(load, np.zeros(0), record)

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
def met(
    columns: Columns, dofs: IntArray, weights: Array, of_vehicle: int, y: Array
) -> tuple[Columns, Array, Array]:
    """Pieces Z, Z^T Z and Z^T y, see `combined`, `overlaps` and `products`."""
    pieces = combined(columns, dofs, weights, of_vehicle)
    return pieces, overlaps(pieces), products(pieces, y)


@compiled
def combined(columns: Columns, dofs: IntArray, weights: Array, of_vehicle: int) -> Columns:
    """Columns for m rows B given by dofs and weights (m, k): of row i pieces i and m + i.

    The first `of_vehicle` dofs of a row are the vehicle's and the others the track's, far from
    each other; the first pieces are those of the vehicle.
    """
    first, width, begin, values = columns
    m, count = dofs.shape
    low, wide = np.zeros(2 * m, dtype=np.int64), np.zeros(2 * m, dtype=np.int64)
    at, used = np.zeros(2 * m, dtype=np.int64), 0
    for piece in range(2 * m):
        i = piece % m
        start, stop = (0, of_vehicle) if piece < m else (of_vehicle, count)
        bottom, top = len(first), 0
        for a in range(start, stop):
            if weights[i, a] != 0.0:
                d = dofs[i, a]
                bottom, top = min(bottom, first[d]), max(top, first[d] + width[d])
        if top > bottom:
            low[piece], wide[piece] = bottom, top - bottom
        at[piece] = used
        used += wide[piece]
    found = np.zeros(used)
    for piece in range(2 * m):
        i = piece % m
        start, stop = (0, of_vehicle) if piece < m else (of_vehicle, count)
        for a in range(start, stop):
            w, d = weights[i, a], dofs[i, a]
            if w != 0.0:
                own = values[begin[d] : begin[d] + width[d]]
                into = found[at[piece] + first[d] - low[piece] :]
                for k in range(width[d]):
                    into[k] += w * own[k]
    return Columns(low, wide, at, found)


@compiled_in_any_order
def overlaps(pieces: Columns) -> Array:
    """Z^T Z (m, m); pieces that do not reach each other are passed over."""
    low, wide, at, values = pieces
    m = len(low) // 2
    found = np.zeros((m, m))
    for part in range(0, 2 * m, m):
        for i in range(m):
            a = part + i
            for j in range(i, m):
                b = part + j
                start = max(low[a], low[b])
                stop = min(low[a] + wide[a], low[b] + wide[b])
                if stop <= start:
                    continue
                one = values[at[a] + start - low[a] : at[a] + stop - low[a]]
                other = values[at[b] + start - low[b] : at[b] + stop - low[b]]
                total = 0.0
                for k in range(stop - start):
                    total += one[k] * other[k]
                found[i, j] += total
    for i in range(m):
        for j in range(i):
            found[i, j] = found[j, i]
    return found


@compiled_in_any_order
def products(pieces: Columns, y: Array) -> Array:
    """Z^T y (m,)."""
    low, wide, at, values = pieces
    m = len(low) // 2
    found = np.zeros(m)
    for piece in range(2 * m):
        own = values[at[piece] : at[piece] + wide[piece]]
        there = y[low[piece] : low[piece] + wide[piece]]
        total = 0.0
        for k in range(len(own)):
            total += own[k] * there[k]
        found[piece % m] += total
    return found


@compiled
def add_pieces(pieces: Columns, factors: Array, y: Array) -> None:
    """y (n,) += Z factors, factors (m,)."""
    low, wide, at, values = pieces
    m = len(low) // 2
    for piece in range(2 * m):
        own = values[at[piece] : at[piece] + wide[piece]]
        there = y[low[piece] : low[piece] + wide[piece]]
        for k in range(len(own)):
            there[k] += factors[piece % m] * own[k]

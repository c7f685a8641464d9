"""Columns of S^-1 for loads on single dofs, which are felt nearby only.

With the inertia of a short time step a load on the rail is felt a few metres away. Farther off a
column falls below `CUT` of its largest value, far below rounding, and is not kept. So what wheels
do to each other and to the track is a matter of short pieces, however long the track is. A column
depends on its dof only: it is computed once and serves all wheels that pass there.
"""

from typing import NamedTuple

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled
from contactstudy.dynamics.banded import Blocks, Factor, forward_near, solve_near

CUT = 1e-18
"""Values at the ends of a column that are smaller than this times its largest are left out."""


class Columns(NamedTuple):
    """Pieces of columns of S^-1, as compiled functions take them.

    The piece of the dof d is ``values[begin[d] : begin[d] + width[d]]``, at the dofs from
    ``first[d]`` on; begin is -1 of a column that is not there.
    """

    first: IntArray
    width: IntArray
    begin: IntArray
    values: Array


class LocalColumns:
    """Columns of S^-1 for a factor of S, computed when they are asked for and then kept.

    A pure cache: what was asked for before changes the time, not the answer.

    Parameters
    ----------
    memory : float
        Bytes beyond which columns that are not asked for at the moment are dropped.
    cut : float
        In place of `CUT`.
    half : bool
        Columns of L^-1, S = L L^T, in place of those of S^-1: from the dof on only.
    """

    def __init__(
        self, factor: Factor, memory: float = 128e6, cut: float = CUT, half: bool = False
    ) -> None:
        assert half or factor.spread is None, "a damper over a whole deck is felt all over it"
        self._factor, self._most, n = factor, int(memory / 8), factor.n
        self._cut, self._half = cut, half
        self._work = factor.padded(np.zeros(n))
        self._columns = Columns(
            np.zeros(n, dtype=np.int64),
            np.zeros(n, dtype=np.int64),
            np.full(n, -1, dtype=np.int64),
            np.empty(min(64 * n, self._most)),
        )
        self._used = 0

    def at(self, dofs: IntArray) -> Columns:
        """Columns of dofs in an array of any shape, and perhaps others; until the next call."""
        begin = self._columns.begin
        while _missing(begin, dofs.ravel()):
            missing = np.unique(dofs[begin[dofs] < 0])
            self._used = _fill(
                self._factor.blocks, missing, self._columns, self._used, self._work, self._cut,
                self._half,
            )  # fmt: skip
            if (begin[missing] < 0).any():
                self._make_room(np.unique(dofs))
        return self._columns

    def block(self, dofs: IntArray) -> tuple[int, Array]:
        """Columns of dofs (k,) side by side, as rows (k, m) at m dofs from the first returned on.

        A dof outside feels none of them.
        """
        columns = self.at(dofs)
        first, width, begin, values = columns
        low, stop = int(first[dofs].min()), int((first[dofs] + width[dofs]).max())
        rows = np.zeros((len(dofs), stop - low))
        for row, dof in zip(rows, dofs, strict=True):
            at = first[dof] - low
            row[at : at + width[dof]] = values[begin[dof] : begin[dof] + width[dof]]
        return low, rows

    def _make_room(self, wanted: IntArray) -> None:
        """Room for at least one more column; in the memory as long as the wanted fit into it."""
        _, width, begin, values = self._columns
        held = np.flatnonzero(begin >= 0)
        if len(values) >= self._most:
            begin[np.setdiff1d(held, wanted)] = -1
            held = np.intersect1d(held, wanted)
        pieces = [values[begin[d] : begin[d] + width[d]] for d in held]
        self._used = int(width[held].sum())
        size = max(min(2 * len(values), self._most), 2 * self._used + len(begin))
        room = np.empty(size)
        room[: self._used] = np.concatenate([*pieces, np.zeros(0)])
        begin[held] = np.cumsum(width[held]) - width[held]
        self._columns = self._columns._replace(values=room)


@compiled
def _missing(begin: IntArray, dofs: IntArray) -> bool:
    """Whether the column of any of the dofs (k,) is not there."""
    found = False
    for dof in dofs:
        found = found or begin[dof] < 0
    return found


@compiled
def _fill(
    blocks: Blocks,
    dofs: IntArray,
    columns: Columns,
    used: int,
    x: Array,
    cut: float,
    half: bool,
) -> int:
    """Compute the columns of dofs one by one as long as there is room; how much is used then.

    x is zero, as long as `Factor.padded` makes it.
    """
    first, width, begin, values = columns
    before, n = blocks.before, len(first)
    for dof in dofs:
        x[before + dof] = 1.0
        low = dof // 8
        if half:
            high = forward_near(blocks, x, low, low + 1, 1e-2 * cut)
        else:
            low, high = solve_near(blocks, x, low, low + 1, 1e-2 * cut)
        start, stop = before + low * 8, before + min(high * 8, n)
        largest = 0.0
        for k in range(start, stop):
            largest = max(largest, abs(x[k]))
        while stop > start + 1 and abs(x[stop - 1]) < cut * largest:
            stop -= 1
        while stop > start + 1 and abs(x[start]) < cut * largest:
            start += 1
        fits = used + stop - start <= len(values)
        if fits:
            first[dof], width[dof], begin[dof] = start - before, stop - start, used
            values[used : used + stop - start] = x[start:stop]
            used += stop - start
        x[low * 8 : before + high * 8] = 0.0
        if not fits:
            break
    return used


@compiled
def add_columns(
    columns: Columns, dofs: IntArray, weights: Array, factors: Array, total: Array
) -> None:
    """total (n,) += S^-1 B^T factors, for rows B given by dofs and weights (m, k)."""
    first, width, begin, values = columns
    for i in range(dofs.shape[0]):
        for k in range(dofs.shape[1]):
            dof, factor = dofs[i, k], factors[i] * weights[i, k]
            if factor != 0.0:
                piece = values[begin[dof] : begin[dof] + width[dof]]
                moved = total[first[dof] : first[dof] + width[dof]]
                for j in range(len(piece)):
                    moved[j] += factor * piece[j]


@compiled
def compliance(columns: Columns, dofs: IntArray, weights: Array, work: Array) -> Array:
    """B S^-1 B^T (m, m) for rows B given by dofs and weights (m, k); work (n,) is zero."""
    first, width = columns.first, columns.width
    m, count = dofs.shape
    one = np.ones(1)
    found = np.zeros((m, m))
    for i in range(m):
        add_columns(columns, dofs[i : i + 1], weights[i : i + 1], one, work)
        for j in range(m):
            for k in range(count):
                found[i, j] += weights[j, k] * work[dofs[j, k]]
        for k in range(count):
            at = first[dofs[i, k]]
            work[at : at + width[dofs[i, k]]] = 0.0
    return found

"""A linear system in sparse matrices, and the Cholesky factor of a banded combination of them."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import scipy.linalg
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled, compiled_in_any_order
from contactstudy.dynamics.dampers import SpreadDampers
from contactstudy.exceptions import NumericalError


def canonical(matrix: sp.sparray) -> sp.csr_array:
    """A matrix by rows, without zeros, columns in order."""
    csr = sp.csr_array(matrix)
    csr.eliminate_zeros()
    csr.sort_indices()
    return csr


@dataclass(frozen=True)
class LinearSystem:
    """M u'' + C u' + K u = f; all (n, n) and symmetric, in an ordering of narrow band.

    With `dampers`, rows G (r, n) that would fill the band, C is `damping` + G^T G.
    """

    mass: sp.csr_array
    damping: sp.csr_array
    stiffness: sp.csr_array
    dampers: sp.csr_array | None = None

    @property
    def n_dofs(self) -> int:
        """Number of dofs."""
        return self.mass.shape[0]

    @classmethod
    def stacked(cls, *parts: Any) -> "LinearSystem":
        """Uncoupled parts, each with mass, damping and stiffness, one after the other.

        A part may have `dampers`, too.
        """
        M, C, K = (
            canonical(sp.block_diag([getattr(part, name) for part in parts]))
            for name in ("mass", "damping", "stiffness")
        )
        own = [getattr(part, "dampers", None) for part in parts]
        if all(rows is None for rows in own):
            return cls(M, C, K)
        there = [
            sp.csr_array((0, part.mass.shape[0])) if rows is None else rows
            for part, rows in zip(parts, own, strict=True)
        ]
        return cls(M, C, K, canonical(sp.block_diag(there)))

    def combine(self, a_mass: float, a_damping: float, a_stiffness: float) -> sp.csr_array:
        """a_mass M + a_damping C + a_stiffness K, without `dampers`."""
        M, C, K = self.mass, self.damping, self.stiffness
        return canonical(a_mass * M + a_damping * C + a_stiffness * K)


BLOCK = 8
"""Rows that are eliminated together; the kernels are written out for this number."""


class Factor:
    """Cholesky factor L L^T of a sparse, symmetric, positive definite, narrow-banded matrix.

    Only the lower half of the matrix (n, n) is read. With `spread`, rows R (r, n), solutions are
    those of the matrix + R^T R: between `forward` and `backward`, which know L only, stands what
    `dynamics.dampers` tells.

    Raises
    ------
    NumericalError
        If the matrix is not positive definite.
    """

    def __init__(self, matrix: sp.sparray, spread: sp.csr_array | None = None) -> None:
        lower = sp.coo_array(sp.tril(matrix))
        rows, columns = lower.coords
        self.n = matrix.shape[0]
        self.half_bandwidth = int((rows - columns).max(initial=0))
        band = np.zeros((self.half_bandwidth + 1, self.n))
        band[rows - columns, columns] = lower.data
        try:
            self.band = scipy.linalg.cholesky_banded(band, lower=True)
        except (np.linalg.LinAlgError, ValueError) as error:
            raise NumericalError(
                f"the system matrix ({self.n} dofs) is not positive definite: {error}."
                " Something is not held, or a stiffness or mass is negative or not a number"
            ) from error
        self.spread = None if spread is None else self._spread(spread)

    def _spread(self, rows: sp.csr_array) -> SpreadDampers:
        half = [self.forward(row) for row in rows.toarray()]
        before = self.blocks.before
        return SpreadDampers(
            np.array([y[before : before + self.n] for y in half]).reshape(-1, self.n),
            np.array([self.backward(y.copy()) for y in half]).reshape(-1, self.n),
        )

    @cached_property
    def blocks(self) -> "Blocks":
        """L in blocks of 8 rows.

        A row by row solution waits for every single dot product; the eight of a block do not wait
        for each other. Where the band is narrower than at its widest, a block begins with its
        first column that is not zero.
        """
        width = -(-max(self.half_bandwidth, 1) // BLOCK) * BLOCK
        n_blocks = -(-self.n // BLOCK)
        # rows[i, k] = L[i, i - i % 8 - width + k], with an identity below the last row
        rows = np.zeros((n_blocks * BLOCK, width + BLOCK))
        rows[
            np.arange(self.n, n_blocks * BLOCK), width + np.arange(self.n, n_blocks * BLOCK) % 8
        ] = 1.0
        for distance in range(self.half_bandwidth + 1):
            i = np.arange(distance, self.n)
            rows[i, width + i % BLOCK - distance] = self.band[distance, : self.n - distance]
        blocks = rows.reshape(n_blocks, BLOCK, width + BLOCK)
        left, inverse = blocks[:, :, :width], np.tril(np.linalg.inv(blocks[:, :, width:]))
        filled = np.any(left != 0.0, axis=1)
        wide = np.where(filled.any(axis=1), width - filled.argmax(axis=1), 0)
        kept = np.broadcast_to(np.arange(width) >= width - wide[:, None, None], left.shape)
        begin = BLOCK * (np.cumsum(wide) - wide)
        return Blocks(left[kept], begin, wide, inverse, width)

    def padded(self, b: Array) -> Array:
        """b (n,) behind `Blocks.before` zeros and before those that fill the last block."""
        blocks = self.blocks
        x = np.zeros(blocks.before + len(blocks.wide) * BLOCK)
        x[blocks.before : blocks.before + self.n] = b
        return x

    def forward(self, b: Array) -> Array:
        """y of L y = b (n,), `padded`: what `backward` takes."""
        y = self.padded(b)
        _forward(self.blocks, y, 0, len(self.blocks.wide))
        return y

    def backward(self, y: Array) -> Array:
        """x (n,) of L^T x = y, which is overwritten."""
        before = self.blocks.before
        _backward(self.blocks, y, 0, len(self.blocks.wide))
        return y[before : before + self.n]

    def solve(self, b: Array) -> Array:
        """Solve for one or several right-hand sides, (n,) or (n, k); b is left as it is."""
        if b.ndim == 1:
            y = self.forward(b)
            if self.spread is not None:
                self.spread.settle(y[self.blocks.before :])
            return self.backward(y)
        if self.spread is not None:
            return np.array([self.solve(column) for column in b.T]).reshape(b.T.shape).T
        before = self.blocks.before
        columns = np.array([self.padded(one) for one in b.T])
        for x in columns:
            nonzero = np.flatnonzero(x)
            if len(nonzero):
                first, last = (nonzero[[0, -1]] - before) // BLOCK
                solve_near(self.blocks, x, first, last + 1, 1e-20)
        return columns[:, before : before + self.n].T


class Blocks(NamedTuple):
    """A factor L in blocks of 8 rows, as the compiled functions below take it.

    Attributes
    ----------
    left : ndarray
        Of each block b its 8 rows left of the diagonal block one after the other,
        ``left[begin[b] + j * wide[b] :][: wide[b]]`` in the columns right before the block.
    begin, wide : ndarray (n_blocks,)
        Where they begin in `left`, and how many columns they have.
    inverse : ndarray (n_blocks, 8, 8)
        Of each diagonal block.
    before : int
        Zeros before a vector that is solved for, at least as many as the widest block has columns.
    """

    left: Array
    begin: IntArray
    wide: IntArray
    inverse: Array
    before: int


@compiled_in_any_order
def _forward(blocks: Blocks, x: Array, first: int, stop: int) -> None:
    """L y = b on blocks first .. stop - 1: y_i = D_i^-1 (b_i - P_i y_before).

    x holds b on entry, below as many zeros as `Blocks` says.
    """
    left, begin, wide, inverse, before = blocks
    y = np.empty(8)
    for block in range(first, stop):
        s, n = before + block * 8, wide[block]
        known, here = x[s - n : s], x[s : s + 8]
        p = left[begin[block] : begin[block] + 8 * n]
        p0, p1, p2, p3 = p[:n], p[n : 2 * n], p[2 * n : 3 * n], p[3 * n : 4 * n]
        p4, p5, p6, p7 = p[4 * n : 5 * n], p[5 * n : 6 * n], p[6 * n : 7 * n], p[7 * n :]
        t0, t1, t2, t3, t4, t5, t6, t7 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(n):
            t0 += p0[k] * known[k]
            t1 += p1[k] * known[k]
            t2 += p2[k] * known[k]
            t3 += p3[k] * known[k]
            t4 += p4[k] * known[k]
            t5 += p5[k] * known[k]
            t6 += p6[k] * known[k]
            t7 += p7[k] * known[k]
        y[0], y[1], y[2], y[3] = here[0] - t0, here[1] - t1, here[2] - t2, here[3] - t3
        y[4], y[5], y[6], y[7] = here[4] - t4, here[5] - t5, here[6] - t6, here[7] - t7
        d = inverse[block]
        for j in range(8):
            total = 0.0
            for k in range(8):
                total += d[j, k] * y[k]
            here[j] = total


@compiled_in_any_order
def _backward(blocks: Blocks, x: Array, first: int, stop: int) -> None:
    """L^T x = y on blocks stop - 1 .. first: x_i = D_i^-T y_i, y_before -= P_i^T x_i."""
    left, begin, wide, inverse, before = blocks
    y = np.empty(8)
    for block in range(stop - 1, first - 1, -1):
        s, n = before + block * 8, wide[block]
        known, here = x[s - n : s], x[s : s + 8]
        p = left[begin[block] : begin[block] + 8 * n]
        p0, p1, p2, p3 = p[:n], p[n : 2 * n], p[2 * n : 3 * n], p[3 * n : 4 * n]
        p4, p5, p6, p7 = p[4 * n : 5 * n], p[5 * n : 6 * n], p[6 * n : 7 * n], p[7 * n :]
        d = inverse[block]
        for k in range(8):
            total = 0.0
            for j in range(8):
                total += d[j, k] * here[j]
            y[k] = total
        y0, y1, y2, y3, y4, y5, y6, y7 = y[0], y[1], y[2], y[3], y[4], y[5], y[6], y[7]
        for k in range(8):
            here[k] = y[k]
        for k in range(n):
            upper = p0[k] * y0 + p1[k] * y1 + p2[k] * y2 + p3[k] * y3
            known[k] -= upper + p4[k] * y4 + p5[k] * y5 + p6[k] * y6 + p7[k] * y7


@compiled
def forward_near(blocks: Blocks, x: Array, first: int, last: int, cut: float) -> int:
    """Downward sweep of `solve_near` alone; blocks first .. high - 1 are touched."""
    n_blocks, width = len(blocks.wide), blocks.before
    high = last
    _forward(blocks, x, first, last)
    largest = _largest(x, width + first * 8, width + last * 8)
    while high < n_blocks and _largest(x, high * 8, high * 8 + width) > cut * largest:
        stop = min(high + 8, n_blocks)
        _forward(blocks, x, high, stop)
        high = stop
    return high


@compiled
def solve_near(blocks: Blocks, x: Array, first: int, last: int, cut: float) -> tuple[int, int]:
    """Solve for a load on blocks first .. last - 1 only; which blocks are touched.

    Nothing happens before the first loaded block on the way down, and both sweeps end where
    all that the next block sees has fallen below `cut` of the largest value: with the inertia
    of a short time step a load is felt some metres away. Touched are blocks low .. high - 1, and
    the places of x that the lowest of them reaches back to.
    """
    width = blocks.before
    low, high = first, forward_near(blocks, x, first, last, cut)
    _backward(blocks, x, first, high)
    largest = _largest(x, first * 8, width + high * 8)
    while low > 0 and _largest(x, low * 8, low * 8 + width) > cut * largest:
        stop = max(low - 8, 0)
        _backward(blocks, x, stop, low)
        low = stop
    return low, high


@compiled
def _largest(x: Array, start: int, stop: int) -> float:
    """Largest absolute value of x[start:stop]."""
    found = 0.0
    for k in range(start, stop):
        found = max(found, abs(x[k]))
    return found

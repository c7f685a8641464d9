"""A linear system in sparse matrices, and the Cholesky factor of a banded combination of them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg
import scipy.sparse as sp
from numba import njit

from contactstudy.exceptions import NumericalError


@dataclass(frozen=True)
class LinearSystem:
    """M u'' + C u' + K u = f.

    Parameters
    ----------
    mass, damping, stiffness : csr_array
        (n, n), symmetric, in an ordering of narrow band.
    """

    mass: sp.csr_array
    damping: sp.csr_array
    stiffness: sp.csr_array

    @property
    def n_dofs(self) -> int:
        """Number of dofs."""
        return self.mass.shape[0]

    @classmethod
    def stacked(cls, *parts: "LinearSystem") -> "LinearSystem":
        """Uncoupled systems one after the other (the track's dofs, then the vehicle's)."""
        return cls(
            *(
                _csr(sp.block_diag([getattr(part, name) for part in parts]))
                for name in ("mass", "damping", "stiffness")
            )
        )

    def combine(self, a_mass: float, a_damping: float, a_stiffness: float) -> sp.csr_array:
        """a_mass M + a_damping C + a_stiffness K."""
        return _csr(a_mass * self.mass + a_damping * self.damping + a_stiffness * self.stiffness)


BLOCK = 8
"""Rows that are eliminated together; the kernels are written out for this number."""


def _csr(matrix: sp.sparray) -> sp.csr_array:
    csr = sp.csr_array(matrix)
    csr.eliminate_zeros()
    csr.sort_indices()
    return csr


class Factor:
    """Cholesky factor L L^T of a sparse, symmetric, positive definite, narrow-banded matrix.

    Parameters
    ----------
    matrix : sparse array
        (n, n); only its lower half is read.

    Attributes
    ----------
    n : int
    half_bandwidth : int
        Largest row minus column of a nonzero.

    Raises
    ------
    NumericalError
        If the matrix is not positive definite.
    """

    def __init__(self, matrix: sp.sparray) -> None:
        lower = sp.coo_array(sp.tril(matrix))
        rows, columns = lower.coords
        self.n = matrix.shape[0]
        self.half_bandwidth = int((rows - columns).max(initial=0))
        band = np.zeros((self.half_bandwidth + 1, self.n))
        band[rows - columns, columns] = lower.data
        try:
            self._band = scipy.linalg.cholesky_banded(band, lower=True)
        except (np.linalg.LinAlgError, ValueError) as error:
            raise NumericalError(
                f"the system matrix ({self.n} dofs) is not positive definite: {error}."
                " Something is not held, or a stiffness or mass is negative or not a number"
            ) from error

    @cached_property
    def _blocks(self) -> tuple[np.ndarray, np.ndarray]:
        """L in blocks of 8 rows: what is left of each diagonal block, and its inverse.

        A row by row solution waits for every single dot product; eight rows at once keep the
        processor's pipelines full.
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
            rows[i, width + i % BLOCK - distance] = self._band[distance, : self.n - distance]
        blocks = rows.reshape(n_blocks, BLOCK, width + BLOCK)
        left = np.ascontiguousarray(blocks[:, :, :width])
        return left, np.tril(np.linalg.inv(blocks[:, :, width:]))

    def solve(self, b: np.ndarray) -> np.ndarray:
        """Solve for one or several right-hand sides, (n,) or (n, k); b is left as it is."""
        if b.ndim == 2:
            solution = np.empty((b.shape[1], self.n))
            for column, x in zip(b.T, solution, strict=True):
                x[:] = self.solve(column)
            return solution.T
        left, inverse = self._blocks
        width = left.shape[2]
        x = np.zeros(width + left.shape[0] * BLOCK)
        x[width : width + self.n] = b
        _solve_in_place(left, inverse, x)
        return x[width : width + self.n]


@njit(cache=True, fastmath={"reassoc", "contract"})
def _solve_in_place(left: np.ndarray, inverse: np.ndarray, x: np.ndarray) -> None:
    """Solve L L^T x = b; x holds b on entry, below as many zeros as `left` is wide."""
    n_blocks, _, width = left.shape
    y = np.empty(8)
    for block in range(n_blocks):  # L y = b: y_i = D_i^-1 (b_i - P_i y_before)
        s = width + block * 8
        before, here = x[s - width : s], x[s : s + 8]
        p, d = left[block], inverse[block]
        t0 = t1 = t2 = t3 = t4 = t5 = t6 = t7 = 0.0
        for k in range(width):
            v = before[k]
            t0 += p[0, k] * v
            t1 += p[1, k] * v
            t2 += p[2, k] * v
            t3 += p[3, k] * v
            t4 += p[4, k] * v
            t5 += p[5, k] * v
            t6 += p[6, k] * v
            t7 += p[7, k] * v
        y[0], y[1], y[2], y[3] = here[0] - t0, here[1] - t1, here[2] - t2, here[3] - t3
        y[4], y[5], y[6], y[7] = here[4] - t4, here[5] - t5, here[6] - t6, here[7] - t7
        for j in range(8):
            total = 0.0
            for k in range(8):
                total += d[j, k] * y[k]
            here[j] = total
    for block in range(n_blocks - 1, -1, -1):  # L^T x = y: x_i = D_i^-T y_i, y_before -= P_i^T x_i
        s = width + block * 8
        before, here = x[s - width : s], x[s : s + 8]
        p, d = left[block], inverse[block]
        for k in range(8):
            total = 0.0
            for j in range(8):
                total += d[j, k] * here[j]
            y[k] = total
        y0, y1, y2, y3, y4, y5, y6, y7 = y[0], y[1], y[2], y[3], y[4], y[5], y[6], y[7]
        for k in range(8):
            here[k] = y[k]
        for k in range(width):
            before[k] -= (
                p[0, k] * y0
                + p[1, k] * y1
                + p[2, k] * y2
                + p[3, k] * y3
                + p[4, k] * y4
                + p[5, k] * y5
                + p[6, k] * y6
                + p[7, k] * y7
            )

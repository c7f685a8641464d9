"""Dampers over many dofs, as modal damping of a deck is: a term of low rank beside narrow bands.

The force -g^T g v of a row g over all dofs of a deck would fill the band of C. So such rows, G
(r, n), stand beside it: C = C_0 + G^T G, and a step has S = S_0 + c G^T G. With S_0 = L L^T and
Y = sqrt(c) L^-1 G^T

    S = L (1 + Y Y^T) L^T,   S^-1 = L^-T (1 - Y H Y^T) L^-1,   H = (1 + Y^T Y)^-1

(M. A. Woodbury, Stat. Res. Group Memo 42, Princeton 1950): between its two sweeps a solution loses
its part Y H Y^T. Y is as local as the decks are, as is X = S_0^-1 sqrt(c) G^T; Y^T L^-1 b is X^T b.
"""

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled
from contactstudy.dynamics.windows import Windows, add_transposed, product, windows

_CUT = 1e-14
"""Of the largest value of a column of Y or X, below which there is none."""


class SpreadDampers:
    """What dampers over many dofs do between the two sweeps of a solution.

    Parameters
    ----------
    half, whole : ndarray
        (r, n) columns of Y and of X, each a row.

    Attributes
    ----------
    rows : Windows
        Y^T (r, n).
    moved : Windows
        X (n, r).
    core : ndarray
        (r, r) H.
    """

    def __init__(self, half: Array, whole: Array) -> None:
        self.rows = windows(_felt(half))
        self.moved = windows(sp.csr_array(_felt(whole).T))
        self.core = np.linalg.inv(np.eye(len(half)) + half @ half.T)

    def settle(self, y: Array) -> None:
        """y -= Y H Y^T y."""
        self.take(y, self.core @ product(self.rows, y))

    def take(self, y: Array, taken: Array) -> None:
        """y -= Y taken (r,)."""
        add_transposed(self.rows, -taken, y)


def _felt(columns: Array) -> sp.csr_array:
    felt = np.abs(columns) > _CUT * np.abs(columns).max(axis=1, keepdims=True)
    return sp.csr_array(np.where(felt, columns, 0.0))


@compiled
def lessen(
    moved: Windows, core: Array, dofs: IntArray, weights: Array, W: Array
) -> tuple[Array, Array]:
    """W (m, m) -= B X H X^T B^T for rows B given by dofs and weights (m, k).

    Returns B X and B X H (m, r).
    """
    first, width, begin, values = moved
    m, r = len(dofs), len(core)
    own, taken = np.zeros((m, r)), np.zeros((m, r))
    low, high = np.full(m, r), np.zeros(m, dtype=np.int64)
    for i in range(m):
        for k in range(dofs.shape[1]):
            dof, weight = dofs[i, k], weights[i, k]
            if weight != 0.0 and width[dof] > 0:
                low[i] = min(low[i], first[dof])
                high[i] = max(high[i], first[dof] + width[dof])
                for j in range(width[dof]):
                    own[i, first[dof] + j] += weight * values[begin[dof] + j]
        for a in range(low[i], high[i]):
            for b in range(r):
                taken[i, b] += own[i, a] * core[a, b]
    for i in range(m):
        for j in range(m):
            total = 0.0
            for a in range(low[i], high[i]):
                total += own[i, a] * taken[j, a]
            W[i, j] -= total
    return own, taken

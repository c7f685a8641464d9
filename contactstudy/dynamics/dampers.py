"""Dampers over many dofs, as modal damping of a deck is: a term of low rank beside narrow bands.

The force -g^T g v of a row g over all dofs of a deck would fill the band of C. So such rows, G
(r, n), stand beside it: C = C_0 + G^T G, and a step has S = S_0 + c G^T G. With S_0 = L L^T and
Y = sqrt(c) L^-1 G^T

    S = L (1 + Y Y^T) L^T,   S^-1 = L^-T (1 - Y H Y^T) L^-1,   H = (1 + Y^T Y)^-1

(M. A. Woodbury, Stat. Res. Group Memo 42, Princeton 1950): between its two sweeps a solution loses
its part Y H Y^T. Y is as local as the decks are.
"""

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.compiled import compiled, compiled_in_any_order
from contactstudy.dynamics.windows import Windows, windows

_CUT = 1e-18
"""Of the largest value of a column of Y, below which there is none."""


class SpreadDampers:
    """What dampers over many dofs do between the two sweeps of a solution.

    Parameters
    ----------
    columns : ndarray
        (r, n) Y, one column a row.

    Attributes
    ----------
    rows : Windows
        Y^T.
    core : ndarray
        (r, r) H.
    """

    def __init__(self, columns: Array) -> None:
        felt = np.abs(columns) > _CUT * np.abs(columns).max(axis=1, keepdims=True)
        self.rows = windows(sp.csr_array(np.where(felt, columns, 0.0)))
        self.core = np.linalg.inv(np.eye(len(columns)) + columns @ columns.T)

    def settle(self, y: Array) -> None:
        """y -= Y H Y^T y."""
        add_transposed(self.rows, -self.core @ product(self.rows, y), y)


@compiled_in_any_order
def product(rows: Windows, x: Array) -> Array:
    """Rows (r, n) @ x, which may have more values than n."""
    first, width, begin, values = rows
    found = np.zeros(len(first))
    for row in range(len(first)):
        here = values[begin[row] : begin[row] + width[row]]
        there = x[first[row] : first[row] + width[row]]
        total = 0.0
        for k in range(len(here)):
            total += here[k] * there[k]
        found[row] = total
    return found


@compiled
def add_transposed(rows: Windows, factors: Array, y: Array) -> None:
    """y += factors @ rows."""
    first, width, begin, values = rows
    for row in range(len(first)):
        here = values[begin[row] : begin[row] + width[row]]
        there = y[first[row] : first[row] + width[row]]
        for k in range(len(here)):
            there[k] += factors[row] * here[k]

"""Products with banded matrices whose rows are kept as contiguous windows of values."""

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled, compiled_in_any_order


class Windows(NamedTuple):
    """A matrix as compiled functions take it: each row from its first to its last nonzero column.

    Row i has the values ``values[begin[i] : begin[i] + width[i]]`` in the columns from
    ``first[i]`` on; rows with the same values may share them.
    """

    first: IntArray
    width: IntArray
    begin: IntArray
    values: Array


def windows(matrix: sp.csr_array) -> Windows:
    """Rows as contiguous windows; there are few zeros inside of them in a banded matrix.

    Rows with the same values share them: a rail is a chain of equal cells, and the few different
    rows then stay in the processor's cache.
    """
    csr = sp.csr_array(matrix)
    csr.sort_indices()
    first, width = _extent(csr)
    rows = np.repeat(np.arange(len(first)), np.diff(csr.indptr))
    padded = np.zeros((len(first), max(int(width.max(initial=0)), 1)))
    padded[rows, csr.indices - first[rows]] = csr.data
    whole = padded.view(np.dtype((np.void, padded.shape[1] * padded.itemsize))).ravel()
    _, which, of_row = np.unique(whole, return_index=True, return_inverse=True)
    return Windows(first, width, of_row * padded.shape[1], padded[which].ravel())


def gaps(matrix: sp.csr_array) -> float:
    """Zeros inside the windows of a matrix with sorted indices, relative to its values."""
    return float(_extent(matrix)[1].sum()) / max(matrix.nnz, 1) - 1.0


def _extent(csr: sp.csr_array) -> tuple[IntArray, IntArray]:
    """First column and width of each row of a matrix with sorted indices, 0 of an empty one."""
    begin, stop = csr.indptr[:-1].astype(np.int64), csr.indptr[1:].astype(np.int64)
    filled = stop > begin
    first, last = np.zeros_like(begin), np.full_like(begin, -1)
    first[filled], last[filled] = csr.indices[begin[filled]], csr.indices[stop[filled] - 1]
    return first, last - first + 1


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

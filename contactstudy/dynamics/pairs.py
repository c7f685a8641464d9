"""Products with two sparse matrices: a step multiplies stiffness and damping."""

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled_in_any_order
from contactstudy.dynamics.windows import Windows, gaps, product, windows

_GAPS = 0.1
"""Share of zeros between a row's values up to which windows are faster than entries one by one."""


class Pair(NamedTuple):
    """Two matrices A and B by rows as compiled functions take them, zeros where only one has any.

    Row i has the values ``first[begin[i] : begin[i + 1]]`` of A and those of B in ``second``, in
    the ``columns``.
    """

    begin: IntArray
    columns: IntArray
    first: Array
    second: Array


def pair(first: sp.csr_array, second: sp.csr_array) -> Pair | tuple[Windows, Windows]:
    """Two matrices of one shape; as windows where these have next to no gaps, as a solid rail's."""
    shape = first.shape
    both = sp.csr_array(abs(first) + abs(second))
    both.sort_indices()
    if gaps(both) < _GAPS:
        return windows(first), windows(second)
    rows = np.repeat(np.arange(shape[0]), np.diff(both.indptr))
    at = rows * shape[1] + both.indices

    def values(matrix: sp.csr_array) -> Array:
        own, found = sp.coo_array(matrix), np.zeros(len(at))
        i, j = own.coords
        np.add.at(found, np.searchsorted(at, i.astype(np.int64) * shape[1] + j), own.data)
        return found

    begin = both.indptr.astype(np.int64)
    return Pair(begin, both.indices.astype(np.int32), values(first), values(second))


def subtract_products(
    matrices: Pair | tuple[Windows, Windows], x: Array, y: Array, total: Array
) -> None:
    """total -= A x + B y."""
    if isinstance(matrices, Pair):
        _subtract_products(matrices, x, y, total)
    else:
        first, second = matrices
        total -= product(first, x) + product(second, y)


@compiled_in_any_order
def _subtract_products(matrices: Pair, x: Array, y: Array, total: Array) -> None:
    """total -= A x + B y."""
    begin, columns, first, second = matrices
    for row in range(len(total)):
        found = 0.0
        # unsigned indices: signed ones would be asked each time whether they count from the end
        for k in range(np.uint64(begin[row]), np.uint64(begin[row + 1])):
            at = np.uint64(columns[k])
            found += first[k] * x[at] + second[k] * y[at]
        total[row] -= found

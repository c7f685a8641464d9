"""Products with banded matrices whose rows are kept as contiguous windows of values."""

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled_in_any_order

Windows = tuple[IntArray, IntArray, IntArray, Array]


def windows(matrix: sp.csr_array) -> Windows:
    """Rows as contiguous windows from their first to their last nonzero column.

    A banded matrix has few zeros inside its windows, so no column needs looking up. Rows with
    the same values share them: a rail is a chain of equal cells, and the few different rows
    then stay in the processor's cache.

    Returns
    -------
    first, width, begin : ndarray
        (n,) int64: first column of each row, its width, and where its values begin.
    values : ndarray
        Of all windows, one after the other.
    """
    csr = sp.csr_array(matrix)
    csr.sort_indices()
    n = csr.shape[0]
    first, width, begin = (np.zeros(n, dtype=np.int64) for _ in range(3))
    known: dict[bytes, int] = {}
    pieces, length = [np.zeros(0)], 0
    for row in range(n):
        here = slice(csr.indptr[row], csr.indptr[row + 1])
        columns = csr.indices[here]
        if len(columns) == 0:
            continue
        first[row], width[row] = columns[0], columns[-1] - columns[0] + 1
        window = np.zeros(width[row])
        window[columns - columns[0]] = csr.data[here]
        key = window.tobytes()
        if key not in known:
            known[key] = length
            pieces.append(window)
            length += len(window)
        begin[row] = known[key]
    return first, width, begin, np.concatenate(pieces)


@compiled_in_any_order
def add_product(
    matrix: Windows,
    coefficients: Array,
    motion: tuple[Array, Array, Array],
    y: Array,
) -> None:
    """y += A (c0 u + c1 v + c2 a) for a matrix A in windows and a motion (u, v, a)."""
    first, width, begin, values = matrix
    u, v, a = motion
    x = coefficients[0] * u + coefficients[1] * v + coefficients[2] * a
    for row in range(len(y)):
        here = values[begin[row] : begin[row] + width[row]]
        there = x[first[row] : first[row] + width[row]]
        total = 0.0
        for k in range(width[row]):
            total += here[k] * there[k]
        y[row] += total

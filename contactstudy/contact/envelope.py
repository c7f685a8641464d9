"""Equations of many contacts, most of which do not feel each other."""

import math

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compiled import compiled_in_any_order


@compiled_in_any_order
def solve_in_envelope(matrix: Array, b: Array) -> Array:
    """x (n,) of A x = b by Cholesky's method, A (n, n) symmetric; NaN if not positive definite.

    L L^T = A row by row: L has no more than the columns from the first nonzero of each row of A on
    (A. Jennings, Comput. J. 9 (1966) 281). Contacts are numbered along the train, so that these are
    few. Only the lower half of A is read.
    """
    n = len(b)
    L, x, first = np.zeros((n, n)), np.empty(n), np.zeros(n, dtype=np.int64)
    for i in range(n):
        j = 0
        while j < i and matrix[i, j] == 0.0:
            j += 1
        first[i] = j
    for i in range(n):
        for j in range(first[i], i + 1):
            start = max(first[i], first[j])
            one, other = L[i, start:j], L[j, start:j]
            total = 0.0
            for k in range(j - start):
                total += one[k] * other[k]
            rest = matrix[i, j] - total
            if j < i:
                L[i, j] = rest / L[j, j]
            elif rest > 0.0:
                L[i, i] = math.sqrt(rest)
            else:
                x[:] = np.nan
                return x
        total = 0.0
        for j in range(first[i], i):
            total += L[i, j] * x[j]
        x[i] = (b[i] - total) / L[i, i]
    for i in range(n - 1, -1, -1):
        x[i] /= L[i, i]
        for j in range(first[i], i):
            x[j] -= L[i, j] * x[i]
    return x

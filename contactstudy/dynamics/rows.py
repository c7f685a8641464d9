"""Kernels on sparse rows, each a few dofs and weights: what the steps do most often."""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled


@compiled
def row_values(dofs: IntArray, weights: Array, u: Array) -> Array:
    """Values of m rows at a vector: sum over k of weights (m, k) times u[dofs (m, k)]."""
    values = np.zeros(dofs.shape[0])
    for i in range(dofs.shape[0]):
        for k in range(dofs.shape[1]):
            values[i] += weights[i, k] * u[dofs[i, k]]
    return values


@compiled
def add_rows(dofs: IntArray, weights: Array, factors: Array, total: Array) -> None:
    """total (n,) += B^T factors, for m rows B; equal dofs in a row add up."""
    for i in range(dofs.shape[0]):
        for k in range(dofs.shape[1]):
            total[dofs[i, k]] += factors[i] * weights[i, k]

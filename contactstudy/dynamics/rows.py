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
def dense_rows(dofs: IntArray, weights: Array, n: int) -> Array:
    """The rows written out, (m, n); equal dofs in a row add up."""
    rows = np.zeros((dofs.shape[0], n))
    for i in range(dofs.shape[0]):
        for k in range(dofs.shape[1]):
            rows[i, dofs[i, k]] += weights[i, k]
    return rows


@compiled
def row_products(dofs: IntArray, weights: Array, vectors: Array) -> Array:
    """Every row at every vector (p, n), as (m, p)."""
    products = np.zeros((dofs.shape[0], vectors.shape[0]))
    for i in range(dofs.shape[0]):
        for j in range(vectors.shape[0]):
            for k in range(dofs.shape[1]):
                products[i, j] += weights[i, k] * vectors[j, dofs[i, k]]
    return products

"""Interpolation of nodal displacements to contact points."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contactstudy.exceptions import InputError

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Rows:
    """Sparse interpolation rows, the same number of entries in each.

    Attributes
    ----------
    index : ndarray of int (n, k)
        Nodes.
    weight : ndarray (n, k)
        Weights; those of a row sum to 1.
    """

    index: IntArray
    weight: Array

    def matrix(self, n_nodes: int) -> Array:
        """Dense matrix (n, n_nodes)."""
        P = np.zeros((len(self.index), n_nodes))
        np.add.at(P, (np.arange(len(self.index))[:, None], self.index), self.weight)
        return P


def line_rows(lines: Array, points: Array, degree: int, mirrored: bool = False) -> Rows:
    """Lagrange interpolation of the given degree on lines of any spacing.

    Each point uses the ``degree + 1`` lines around it; near an open end the last ones.

    Parameters
    ----------
    lines : ndarray (m,)
        Increasing coordinates of the nodes in m.
    points : ndarray (n,)
        Coordinates in m within the lines.
    degree : int
        1 (linear) or 3 (cubic).
    mirrored : bool
        Symmetric continuation about ``lines[0]``: the stencil then stays centred there.

    Returns
    -------
    Rows

    Raises
    ------
    InputError
        If a point lies outside the lines or there are too few lines.
    """
    points = np.asarray(points, dtype=float)
    if degree not in (1, 3):
        raise InputError(f"interpolation degree {degree}: must be 1 or 3")
    if len(lines) < degree + 1:
        raise InputError(
            f"interpolation of degree {degree} needs {degree + 1} lines, got {len(lines)}"
        )
    slack = 1e-9 * (lines[-1] - lines[0])
    if points.size and (points.min() < lines[0] - slack or points.max() > lines[-1] + slack):
        raise InputError(
            f"contact points from {points.min():.6g} to {points.max():.6g} m lie outside the "
            f"surface nodes from {lines[0]:.6g} to {lines[-1]:.6g} m"
        )
    extra = (degree - 1) // 2 if mirrored else 0
    nodes = np.concatenate([2 * lines[0] - lines[extra:0:-1], lines])
    number = np.concatenate([np.arange(extra, 0, -1), np.arange(len(lines))])
    cell = np.clip(np.searchsorted(nodes, points, side="right") - 1, 0, len(nodes) - 2)
    first = np.clip(cell - (degree - 1) // 2, 0, len(nodes) - degree - 1)
    stencil = first[:, None] + np.arange(degree + 1)
    at = nodes[stencil]
    # L_a(s) = prod_{b != a} (s - s_b)/(s_a - s_b)
    weight = np.ones_like(at)
    for a in range(degree + 1):
        for b in range(degree + 1):
            if a != b:
                weight[:, a] *= (points - at[:, b]) / (at[:, a] - at[:, b])
    return Rows(number[stencil], weight)


def grid_rows(x: Rows, y: Rows, ny: int) -> Rows:
    """Product of two line interpolations for every pair of points (x outer, y inner).

    Parameters
    ----------
    x, y : Rows
        Rows of nx' and ny' points.
    ny : int
        Lines in y: the node of lines (ix, iy) is ``ix*ny + iy``.

    Returns
    -------
    Rows
        For the nx'*ny' points of the product grid.
    """
    index = x.index[:, None, :, None] * ny + y.index[None, :, None, :]
    weight = x.weight[:, None, :, None] * y.weight[None, :, None, :]
    n = len(x.index) * len(y.index)
    return Rows(index.reshape(n, -1), weight.reshape(n, -1))

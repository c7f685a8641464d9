"""Interpolation of nodal displacements to contact points.

The wheel's displacements are bilinear on the facet that carries the point. The rail's are
interpolated by a cubic spline through the nodes of its running surface: the points travel over
the rail's mesh, and between two nodes a dent of curvature c sags by c h^2/8 (1 um at 2 mm, 1 %
of the approach), which linear interpolation would add and take away with every element passed.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError

SLACK = 0.01
"""Points may lie beyond the outermost lines by this part of a step."""


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


def linear_rows(lines: Array, points: Array) -> Rows:
    """Rows (n, 2) of linear interpolation on increasing lines (m,) to points (n,) within [m]."""
    _check_inside(lines, points)
    cell = np.clip(np.searchsorted(lines, points, side="right") - 1, 0, len(lines) - 2)
    t = (points - lines[cell]) / (lines[cell + 1] - lines[cell])
    return Rows(np.stack([cell, cell + 1], axis=1), np.stack([1 - t, t], axis=1))


def grid_rows(x: Rows, y: Rows, ny: int) -> Rows:
    """Product of two line interpolations for every pair of points (x outer, y inner).

    The node of lines (ix, iy) is ``ix*ny + iy``.
    """
    index = x.index[:, None, :, None] * ny + y.index[None, :, None, :]
    weight = x.weight[:, None, :, None] * y.weight[None, :, None, :]
    n = len(x.index) * len(y.index)
    return Rows(index.reshape(n, -1), weight.reshape(n, -1))


class SplineLine:
    """Cubic spline interpolation on fixed lines (not-a-knot at open ends).

    The lines (m,) are increasing coordinates of the nodes in m, at least 4; if `mirrored` at least
    3, the values continuing symmetrically about ``lines[0]``.

    Raises
    ------
    InputError
        If there are too few lines.
    """

    def __init__(self, lines: Array, mirrored: bool = False) -> None:
        from scipy.interpolate import CubicSpline

        lines = np.asarray(lines, dtype=float)
        m = len(lines)
        if m < (3 if mirrored else 4):
            raise InputError(f"spline interpolation: {m} lines of surface nodes are too few")
        values, knots = np.eye(m), lines
        if mirrored:
            knots = np.concatenate([2 * lines[0] - lines[:0:-1], lines])
            values = np.concatenate([values[:0:-1], values])
        first = m - 1 if mirrored else 0
        # piece k, degree 3 - d: coefficient of every nodal value
        self._pieces = np.ascontiguousarray(
            np.moveaxis(CubicSpline(knots, values).c[:, first:], 0, 2)
        )
        self._lines = lines

    def __call__(self, points: Array) -> Array:
        """Weights (n, m) of the nodal values at points (n,)."""
        lines = self._lines
        _check_inside(lines, points)
        piece = np.clip(np.searchsorted(lines, points, side="right") - 1, 0, len(lines) - 2)
        s = points - lines[piece]
        powers = np.stack([s**3, s**2, s, np.ones_like(s)], axis=1)
        return np.asarray(np.einsum("nmd,nd->nm", self._pieces[piece], powers))


def _check_inside(lines: Array, points: Array) -> None:
    # arc lengths on wheel and rail differ by micrometres over a contact zone
    slack = SLACK * min(lines[1] - lines[0], lines[-1] - lines[-2])
    if points.size and (points.min() < lines[0] - slack or points.max() > lines[-1] + slack):
        raise InputError(
            f"contact points from {points.min():.6g} to {points.max():.6g} m lie outside the "
            f"surface nodes from {lines[0]:.6g} to {lines[-1]:.6g} m"
        )

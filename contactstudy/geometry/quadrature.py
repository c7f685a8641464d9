"""Where the contact pressure is taken on the wheel's tread grid: Gauss points or nodes."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.geometry.interpolation import Rows, linear_rows

Quadrature = Literal["gauss", "nodes"]
"""Where the contact pressure is taken: 2 x 2 Gauss points of every facet, or the nodes."""

# two-point Gauss rule on [0, 1]
_GAUSS = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)


@dataclass(frozen=True)
class PointLine:
    """Contact points along one direction of the wheel's tread grid.

    Attributes
    ----------
    at : ndarray (n,)
        Coordinates in m.
    weight : ndarray (n,)
        Lengths in m that the points stand for; they sum to the length of the grid.
    rows : Rows
        Interpolation from the grid's lines, (n, 2) or, at the lines themselves, (n, 1).
    cell : ndarray of int (n, k)
        Intervals between lines that a point belongs to.
    """

    at: Array
    weight: Array
    rows: Rows
    cell: IntArray


def point_line(lines: Array, quadrature: Quadrature) -> PointLine:
    """Contact points along one direction of the wheel's tread nodes at increasing lines (m,) [m].

    Two Gauss points an interval, or the nodes with half of the intervals on both sides.
    """
    lines = np.asarray(lines, dtype=float)
    steps, m = np.diff(lines), len(lines)
    if quadrature == "gauss":
        at = (lines[:-1, None] + steps[:, None] * _GAUSS).ravel()
        cell = np.repeat(np.arange(m - 1), 2)[:, None]
        return PointLine(at, np.repeat(0.5 * steps, 2), linear_rows(lines, at), cell)
    # trapezoidal rule
    weight = 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))
    node = np.arange(m)[:, None]
    cell = np.clip(np.concatenate([node - 1, node], axis=1), 0, m - 2)
    return PointLine(lines, weight, Rows(node, np.ones((m, 1))), cell)


def grid_facets(x: PointLine, y: PointLine, my: int) -> IntArray:
    """Facets ``i*(my-1) + j`` that the points of a product grid belong to, (nx*ny, k)."""
    facet = x.cell[:, None, :, None] * (my - 1) + y.cell[None, :, None, :]
    return np.asarray(facet.reshape(len(x.at) * len(y.at), -1), dtype=np.int64)

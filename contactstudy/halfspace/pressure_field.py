"""Pressure fields on grids of rectangles, from pressures at nodes."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError


@dataclass(frozen=True)
class SurfacePressure:
    """Pressure on the rectangles of a grid, zero elsewhere.

    Attributes
    ----------
    x, y : ndarray (k+1,), (m+1,)
        Edges of the rectangles in m, increasing.
    pressure : ndarray (k, m)
        In Pa.
    """

    x: Array
    y: Array
    pressure: Array

    @property
    def force(self) -> float:
        """Resultant in N."""
        return float(np.diff(self.x) @ self.pressure @ np.diff(self.y))

    @property
    def area(self) -> float:
        """Area under pressure in m^2."""
        return float(np.diff(self.x) @ (self.pressure > 0) @ np.diff(self.y))


def bilinear_pressure(x: Array, y: Array, nodal: Array, parts: int = 4) -> SurfacePressure:
    """Grid of rectangles for pressures (k, m) [Pa] at the nodes of lines (k,), (m,) [m].

    They are bilinear between the nodes. Each facet is cut into `parts` x `parts` rectangles with
    the mean of the bilinear function on each, so that the resultant is kept.
    """
    if parts < 1 or nodal.shape != (len(x), len(y)):
        raise InputError(
            f"pressure below the patch: needs parts >= 1 (is {parts}) and as many values as nodes "
            f"({nodal.shape} for {len(x)} x {len(y)} lines)"
        )
    fine_x, Ax = _parts(np.asarray(x, dtype=float), parts)
    fine_y, Ay = _parts(np.asarray(y, dtype=float), parts)
    return SurfacePressure(fine_x, fine_y, Ax @ nodal @ Ay.T)


def recovered_pressure(x: Array, y: Array, nodal: Array, parts: int = 4) -> SurfacePressure:
    """Pressure whose lumped projection to the nodes is the given one, with its resultant.

    `contactstudy.geometry.points.ContactPoints.nodal_pressure` smooths by the order h^2: for a
    bilinear field q it gives ``S q``, S the consistent mass matrix over its row sums. So
    ``q = S^-1 p``, here by the first two terms of Neumann's series, ``q = p + (p - S p)``, which
    leaves an error of the order h^4 and little of the oscillation of an exact inverse. Beyond the
    rim of the patch q undershoots zero by a few per cent of the peak, which the depth evens out.

    Arguments as of `bilinear_pressure`; of the whole patch, not of half a symmetric one.
    """
    smoothed = _projection(x) @ nodal @ _projection(y).T
    return bilinear_pressure(x, y, 2.0 * nodal - smoothed, parts)


def _projection(lines: Array) -> Array:
    """Rows ``integral N_a N_b / integral N_a`` of the hat functions of a line."""
    h, n = np.diff(lines), len(lines)
    a = np.arange(n - 1)
    M = np.zeros((n, n))
    M[a, a] += h / 3
    M[a + 1, a + 1] += h / 3
    M[a, a + 1] = M[a + 1, a] = h / 6
    return np.asarray(M / M.sum(axis=1)[:, None])


def _parts(lines: Array, parts: int) -> tuple[Array, Array]:
    """Edges after cutting every step, and the rows that interpolate to the parts' middles."""
    share = np.arange(parts) / parts
    edges = np.append((lines[:-1, None] + np.diff(lines)[:, None] * share).ravel(), lines[-1])
    A = np.zeros((parts * (len(lines) - 1), len(lines)))
    row = np.arange(len(A))
    middle = np.tile(share + 0.5 / parts, len(lines) - 1)
    A[row, row // parts], A[row, row // parts + 1] = 1 - middle, middle
    return edges, A

"""Residual flexibility of the rail at the contact points of a travelling wheel.

The nodes of the rail's surface stand still while the points pass over them, so the flexibility
that the points find by interpolation, P R P^T, varies a little with their phase against the
mesh: a ripple in the contact force with the period of the mesh, which no rail has. The mesh
could lie anywhere under the wheel; taken as the mean over four equally spaced phases, the
flexibility keeps its accuracy and loses the first three harmonics of that ripple.

Where two cells meet, part of the local flexibility is not in R but in the map H to the track's
dofs. So the mean is taken of both, with a static flexibility L of those dofs that stands in for
what they do: < P (R + H L H^T) P^T >, and P H L H^T P^T, at the very place of the points, is
taken off again. Whoever adds the flexibility of the dofs, P H C H^T P^T, adds C - L instead.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.track.stretch import RailStretch

PHASES = np.array([-0.375, -0.125, 0.125, 0.375])
"""Shifts of the points in mesh steps."""


@dataclass(frozen=True)
class Blend:
    """A symmetric matrix (1 - t) A + t B that is never formed as a whole."""

    t: float
    A: Array
    B: Array

    def block(self, index: IntArray) -> Array:
        """Rows and columns of an index."""
        at = np.ix_(index, index)
        return np.asarray((1 - self.t) * self.A[at] + self.t * self.B[at])

    def product(self, index: IntArray, x: Array) -> Array:
        """Product with a vector that has the values x at an index and zeros elsewhere."""
        return np.asarray((1 - self.t) * (x @ self.A[index]) + self.t * (x @ self.B[index]))


class ResidualFlexibility:
    """Residual flexibility at the points, by position of the wheel.

    Parameters
    ----------
    along : SplineLine
        Interpolation along the rail from the nodes of a stretch, counted from its first.
    across : ndarray (npy, ny)
        Interpolation across the rail.
    points_x : ndarray (npx,)
        Positions of the points relative to the wheel in m.
    step : float
        Distance of the nodes along the rail in m.
    period : int or None
        Steps after which the residual is the same again (one cell). The mean over the phases
        is kept for each of them and interpolated linearly between. None: no mean is taken, the
        flexibility is that of the points exactly where they are.
    """

    def __init__(
        self,
        along: SplineLine,
        across: Array,
        points_x: Array,
        step: float,
        period: int | None,
    ) -> None:
        self._along, self._across, self._x = along, across, points_x
        self._step, self._period = step, period
        self._kept: dict[int, Array] = {}

    def __call__(self, X: float, stretch: RailStretch) -> Blend:
        """Flexibility (n, n) in m/N with the wheel at X over a stretch there.

        With ``stretch.local`` the mean holds a share of the dofs' as well.
        """
        period = self._period
        if period is None:
            exact = self._at(stretch, stretch.residual, X)
            return Blend(0.0, exact, exact)
        scaled = X / self._step
        plane = int(np.floor(scaled))
        here, next_ = (self._mean(at, stretch, period) for at in (plane, plane + 1))
        return Blend(scaled - plane, here, next_)

    def _mean(self, plane: int, stretch: RailStretch, period: int) -> Array:
        # both sides of a change of patches have means of their own, each with its own dofs
        key = plane - stretch.key * period
        if key not in self._kept:
            F = stretch.residual
            if stretch.local is not None:
                F = F + stretch.map @ stretch.local @ stretch.map.T
            shifted = [self._at(stretch, F, (plane + s) * self._step) for s in PHASES]
            self._kept[key] = np.mean(shifted, axis=0)
        return self._kept[key]

    def _at(self, stretch: RailStretch, F: Array, X: float) -> Array:
        # P = along x across; P F P^T one factor at a time
        along = self._along(X - stretch.x[0] + self._x)
        half = _rows(along, self._across, F)
        return _rows(along, self._across, np.ascontiguousarray(half.T))


def _rows(along: Array, across: Array, F: Array) -> Array:
    """``kron(along, across) @ F`` without the Kronecker product."""
    grid = np.tensordot(along, F.reshape(along.shape[1], across.shape[1], -1), axes=1)
    return np.asarray((across @ grid).reshape(-1, F.shape[1]))

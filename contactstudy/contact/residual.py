"""Residual flexibility of the rail at the contact points of a travelling wheel.

The nodes of the rail's surface stand still while the points pass over them, so the flexibility
that the points find by interpolation, P R P^T, varies a little with their phase against the
mesh: a ripple in the contact force with the period of the mesh, which no rail has. The mesh
could lie anywhere under the wheel; taken as the mean over four equally spaced phases, the
flexibility keeps its accuracy and loses the first three harmonics of that ripple.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from contactstudy.contact.interpolation import SplineLine
from contactstudy.contact.points import ContactPoints
from contactstudy.track.patch import SurfacePatch

Array = NDArray[np.float64]

PHASES = np.array([-0.375, -0.125, 0.125, 0.375])
"""Shifts of the points in mesh steps."""


@dataclass(frozen=True)
class Blend:
    """A symmetric matrix (1 - t) A + t B that is never formed as a whole."""

    t: float
    A: Array
    B: Array

    def block(self, index: NDArray[np.int64]) -> Array:
        """Rows and columns of an index."""
        at = np.ix_(index, index)
        return np.asarray((1 - self.t) * self.A[at] + self.t * self.B[at])

    def __matmul__(self, x: Array) -> Array:
        """Product with a vector."""
        return np.asarray((1 - self.t) * (self.A @ x) + self.t * (self.B @ x))


class PatchSource(Protocol):
    """A track that can show its running surface around a position."""

    def patch(self, x: float, half_length: float) -> SurfacePatch:
        """Running surface around X."""


class ResidualFlexibility:
    """Residual flexibility at the points, by position of the wheel.

    Parameters
    ----------
    track : PatchSource
    along : SplineLine
        Interpolation along the rail from the nodes of a patch, counted from its first.
    across : ndarray (npy, ny)
        Interpolation across the rail.
    points_x : ndarray (npx,)
        Positions of the points relative to the wheel in m.
    half_length : float
        Of the patches in m.
    step : float
        Distance of the nodes along the rail in m.
    period : int or None
        Steps after which the residual is the same again (one cell). The mean over the phases
        is kept for each of them and interpolated linearly between. None: no mean is taken, the
        flexibility is that of the points exactly where they are.
    """

    def __init__(
        self,
        track: PatchSource,
        along: SplineLine,
        across: Array,
        points_x: Array,
        half_length: float,
        step: float,
        period: int | None,
    ) -> None:
        self._track, self._along, self._across, self._x = track, along, across, points_x
        self._half_length, self._step, self._period = half_length, step, period
        self._kept: dict[int, Array] = {}

    def __call__(self, X: float) -> Blend:
        """Flexibility (n, n) in m/N with the wheel at X."""
        if self._period is None:
            exact = self._at(self._track.patch(X, self._half_length), X)
            return Blend(0.0, exact, exact)
        scaled = X / self._step
        plane = int(np.floor(scaled))
        t = scaled - plane
        return Blend(t, self._mean(plane), self._mean(plane + 1))

    def _mean(self, plane: int) -> Array:
        assert self._period is not None
        key = plane % self._period
        if key not in self._kept:
            X = plane * self._step
            patch = self._track.patch(X, self._half_length)
            shifted = [self._at(patch, X + s * self._step) for s in PHASES]
            self._kept[key] = np.mean(shifted, axis=0)
        return self._kept[key]

    def _at(self, patch: SurfacePatch, X: float) -> Array:
        P = np.kron(self._along(X - patch.x[0] + self._x), self._across)
        return np.asarray(P @ patch.residual @ P.T)


def patch_splines(patch: SurfacePatch, points: ContactPoints) -> tuple[SplineLine, Array]:
    """Interpolation along the nodes of a patch, from its first, and that across at the points.

    The nodes stand at equal distances, so one spline serves all positions of the patch.
    """
    across = SplineLine(patch.arc, mirrored=points.symmetric)
    return SplineLine(patch.x - patch.x[0]), across(points.arc)

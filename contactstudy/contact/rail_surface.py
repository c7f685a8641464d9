"""The rail's side of surface contact: its surface and flexibility at the contact points."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.residual import Blend, ResidualFlexibility
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.geometry.points import ContactPoints
from contactstudy.track.meshed import MeshedTrack
from contactstudy.track.stretch import RailStretch


@dataclass(frozen=True, eq=False)
class RailUnderWheel:
    """The rail's surface at the points of a wheel that stands at one place.

    Attributes
    ----------
    along, across : ndarray (npx, nx), (npy, ny)
        Interpolation P = along x across from the stretch's nodes to the points.
    residual : Blend
        Flexibility (n, n) of the points that the track's dofs leave out, see `contact.residual`.
    static : ndarray (nd, nd) or None
        What the residual holds of the dofs' flexibility already [m/N].
    """

    stretch: RailStretch
    along: Array
    across: Array
    residual: Blend
    static: Array | None

    def at_points(self, nodal: Array) -> Array:
        """Values (n,) at the points from values (nodes,) at the surface nodes."""
        grid = nodal.reshape(self.along.shape[1], -1)
        return np.asarray((self.along @ grid @ self.across.T).ravel())

    def rows(self, index: IntArray) -> Array:
        """Rows of P for some points, (len(index), nodes)."""
        ny = len(self.across)
        P = self.along[index // ny, :, None] * self.across[index % ny, None, :]
        return P.reshape(len(index), -1)

    def beyond(self, C: Array) -> Array:
        """Flexibility C (nd, nd) of the stretch's dofs less what the residual holds of it."""
        return C if self.static is None else C - self.static


class RailSurface:
    """Running surface of a track at the points of a travelling wheel.

    Only what repeats is kept: the spline, the means of the residual over the phases of the mesh,
    and the place asked for last. Asked twice, it answers the same.
    """

    def __init__(self, track: MeshedTrack, points: ContactPoints) -> None:
        self._track, self._points = track, points
        # two nodes beyond the outermost point, for the spline
        self.half_length = float(np.abs(points.x).max()) + 2 * track.thickness
        self._lines: tuple[SplineLine, Array, ResidualFlexibility] | None = None
        self._last: tuple[float, RailUnderWheel] | None = None

    def under(self, X: float) -> RailUnderWheel:
        """Surface under a wheel at X [m]."""
        if self._last is None or self._last[0] != X:
            self._last = X, self._under(X)
        return self._last[1]

    def _under(self, X: float) -> RailUnderWheel:
        stretch = self._track.stretch(X, self.half_length)
        if self._lines is None:
            self._lines = self._interpolation(stretch)
        spline, across, residual = self._lines
        along = spline(X - stretch.x[0] + self._points.x)
        static = None if self._track.residual_period is None else stretch.local
        return RailUnderWheel(stretch, along, across, residual(X, stretch), static)

    def _interpolation(self, stretch: RailStretch) -> tuple[SplineLine, Array, ResidualFlexibility]:
        """Splines from the equally spaced nodes of any stretch, and the residual."""
        track, points = self._track, self._points
        along = SplineLine(stretch.x - stretch.x[0])
        across = SplineLine(stretch.arc, mirrored=points.symmetric)(points.arc)
        period = track.residual_period
        residual = ResidualFlexibility(along, across, points.x, track.thickness, period)
        return along, across, residual

"""Profiles of rail and wheel as curves by arc length."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.closest import ClosestPoint
from contactstudy.profiles.pieces import Frame, Piece

_ITERATIONS = 100


@dataclass(frozen=True, eq=False)
class ProfileCurve:
    """Plane, tangent-continuous curve in (y, z), walked towards growing y, by arc length s.

    Beyond its ends the curve goes on straight.

    Parameters
    ----------
    name : str
        Name of the profile.
    pieces : sequence of Piece
        Connected pieces in walking order.
    begin : float
        Arc length at the start of the first piece [m].
    upper : bool
        True: the body lies below and its normal points up (rail). False: the body lies above
        and its normal points down (wheel).
    residual : float
        RMS distance of measured points from the curve [m]; 0 for a drawing.
    notes : tuple of str
        What a user should know of the points that it was fitted to.
    """

    name: str
    pieces: tuple[Piece, ...]
    begin: float
    upper: bool
    residual: float = 0.0
    notes: tuple[str, ...] = ()

    @cached_property
    def _joints(self) -> Array:
        return self.begin + np.concatenate([[0.0], np.cumsum([p.length for p in self.pieces])])

    @property
    def s_range(self) -> tuple[float, float]:
        """Arc lengths of the two ends [m]."""
        return float(self._joints[0]), float(self._joints[-1])

    @property
    def joints(self) -> Array:
        """Arc lengths of the ends and of the joints between the pieces, (k,) [m]."""
        return self._joints.copy()

    @property
    def _side(self) -> float:
        return 1.0 if self.upper else -1.0

    def _frame(self, s: Array) -> Frame:
        """Points, unit tangents and left curvature at s (n,)."""
        which = np.searchsorted(self._joints[1:-1], s, side="right")
        if len(s) and which.min() == which.max():
            return self._piece_frame(int(which[0]), s)
        point, tangent, turn = np.empty((len(s), 2)), np.empty((len(s), 2)), np.empty(len(s))
        for k in np.unique(which):
            here = which == k
            point[here], tangent[here], turn[here] = self._piece_frame(k, s[here])
        return point, tangent, turn

    def _piece_frame(self, k: int, s: Array) -> Frame:
        """The same of points on piece k; before the first and after the last on straight lines."""
        t = s - self._joints[k]
        inside = np.clip(t, 0.0, self.pieces[k].length)
        c, d, turned = self.pieces[k].frame(inside)
        # only the ends are ever left (elsewhere by rounding): straight on
        beyond = t - inside
        return c + beyond[:, None] * d, d, np.where(np.abs(beyond) > 1e-12, 0.0, turned)

    def point(self, s: ArrayLike) -> Array:
        """Points (..., 2) = (y, z) at arc lengths s (...) [m]."""
        t = np.asarray(s, dtype=float)
        return self._frame(t.ravel())[0].reshape(*t.shape, 2)

    def normal(self, s: ArrayLike) -> Array:
        """Unit normals (..., 2) out of the body at arc lengths s (...)."""
        return self.point_and_normal(s)[1]

    def point_and_normal(self, s: ArrayLike) -> tuple[Array, Array]:
        """`point` and `normal` at arc lengths s (...) [m], at the cost of one of them."""
        t = np.asarray(s, dtype=float)
        c, d, _ = self._frame(t.ravel())
        # the tangent turned to the left (up) or to the right (down)
        n = self._side * np.stack([-d[:, 1], d[:, 0]], axis=-1)
        return c.reshape(*t.shape, 2), n.reshape(*t.shape, 2)

    def curvature(self, s: ArrayLike) -> Array:
        """Curvature (...) at arc lengths s (...), positive for a convex body [1/m]."""
        t = np.asarray(s, dtype=float)
        return (-self._side * self._frame(t.ravel())[2]).reshape(t.shape)

    def arc_of_y(self, y: ArrayLike) -> Array:
        """Arc length (...) of the curve's points at lateral positions y (...) [m].

        Raises
        ------
        InputError
            If a position lies beyond the curve's ends, or y does not grow along the curve.
        """
        b = np.asarray(y, dtype=float)
        s, p = self._closest_points.samples
        back = np.flatnonzero(np.diff(p[:, 0]) <= 0.0)
        if back.size:
            raise InputError(
                f"profile {self.name}: y does not grow all along the curve through its points: it "
                f"goes back at y = {1e3 * p[back[0], 0]:.4g} mm, z = {1e3 * p[back[0], 1]:.4g} mm; "
                "are points too far apart on a steep side, or too scattered?"
            )
        if not np.all((b >= p[0, 0] - 1e-12) & (b <= p[-1, 0] + 1e-12)):
            raise InputError(
                f"profile {self.name}: y = {b.min():.6g} to {b.max():.6g} m lies beyond its ends "
                f"at {p[0, 0]:.6g} and {p[-1, 0]:.6g} m"
            )
        k = np.clip(np.searchsorted(p[:, 0], b.ravel()), 1, len(s) - 1)
        low, high, target = s[k - 1].copy(), s[k].copy(), b.ravel()
        x = 0.5 * (low + high)
        for _ in range(_ITERATIONS):
            c, d, _ = self._frame(x)
            off = target - c[:, 0]
            low, high = np.where(off > 0, x, low), np.where(off > 0, high, x)
            new = x + off / np.maximum(d[:, 0], 1e-300)
            new = np.where((new >= low) & (new <= high), new, 0.5 * (low + high))
            moved, x = np.abs(new - x).max(initial=0.0), new
            if moved < 1e-16:
                break
        return x.reshape(b.shape)

    def height(self, y: ArrayLike) -> Array:
        """z (...) of the curve's points at lateral positions y (...) [m]; raises as `arc_of_y`."""
        return np.asarray(self.point(self.arc_of_y(y))[..., 1])

    @cached_property
    def _closest_points(self) -> ClosestPoint:
        joints = [float(s) for s in self._joints]
        return ClosestPoint(self.name, self._frame, joints, self._side)

    def project(self, points: Array) -> tuple[Array, Array]:
        """Arc lengths (n,) of the points closest to points (n, 2), and signed distances (n,) [m].

        Outside `s_range` the closest point is on the straight continuation; distances are positive
        outside the body. See `ClosestPoint`.

        Raises
        ------
        InputError
            If points are not finite or not (n, 2).
        """
        return self._closest_points(points)


def joined(name: str, pieces: Sequence[Piece], upper: bool, residual: float = 0.0) -> ProfileCurve:
    """Curve of given pieces whose arc length is 0 at y = 0."""
    curve = ProfileCurve(name, tuple(pieces), 0.0, upper, residual)
    return ProfileCurve(name, curve.pieces, -float(curve.arc_of_y(0.0)), upper, residual)

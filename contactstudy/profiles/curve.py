"""Profiles of rail and wheel as curves by arc length, and the closest point on them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.profiles.geometry import Arc
from contactstudy.profiles.pieces import ArcPiece, Frame, LinePiece, Piece
from contactstudy.profiles.rail import running_pieces
from contactstudy.profiles.wheel import wheel_profile

Array = NDArray[np.float64]

# largest spacing of the table of points among which the closest is looked for first [m]
_SPACING = 0.5e-3
# numbers in one block of the table of distances
_BLOCK = 4_000_000
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
    """

    name: str
    pieces: tuple[Piece, ...]
    begin: float
    upper: bool
    residual: float = 0.0

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
        s, p, _ = self._table
        if np.any(np.diff(p[:, 0]) <= 0):
            raise InputError(f"profile {self.name}: y does not grow all along the curve")
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

    @cached_property
    def _table(self) -> tuple[Array, Array, float]:
        """Arc lengths and points among which the closest is looked for, greatest curvature."""
        rows = []
        for a, b in zip(self._joints[:-1], self._joints[1:], strict=True):
            rows.append(np.linspace(a, b, max(int(np.ceil((b - a) / _SPACING)), 4) + 1)[:-1])
        s = np.concatenate([*rows, self._joints[-1:]])
        point, _, turn = self._frame(s)
        return s, point, float(np.abs(turn).max())

    def project(self, points: Array) -> tuple[Array, Array]:
        """Closest points of the curve.

        Every local minimum of the distance that can be the least one is refined by Newton's
        iteration on ``(c(s) - p) . t(s) = 0``, kept within its bracket; the nearest of all wins.

        Parameters
        ----------
        points : ndarray (n, 2)
            (y, z) [m].

        Returns
        -------
        s : ndarray (n,)
            Arc length of the closest point [m]; outside `s_range` on the straight continuation.
        distance : ndarray (n,)
            Signed distance, positive outside the body [m].

        Raises
        ------
        InputError
            If points are not finite or not (n, 2).
        """
        p = np.asarray(points, dtype=float)
        if p.ndim != 2 or p.shape[1] != 2 or not np.all(np.isfinite(p)):
            raise InputError(
                f"projection on {self.name}: points must be finite (n, 2), got {p.shape}"
            )
        s, distance = np.empty(len(p)), np.empty(len(p))
        block = max(_BLOCK // len(self._table[0]), 1)
        for first in range(0, len(p), block):
            part = slice(first, first + block)
            s[part], distance[part] = self._project(p[part])
        return s, distance

    def _project(self, p: Array) -> tuple[Array, Array]:
        row, low, high, start = self._brackets(p)
        s = self._closest(p[row], low, high, start)
        c, d, _ = self._frame(s)
        off = p[row] - c
        distance = self._side * (d[:, 0] * off[:, 1] - d[:, 1] * off[:, 0])
        # the nearest candidate of every point; candidates come sorted by point
        order = np.lexsort((np.hypot(off[:, 0], off[:, 1]), row))
        first = order[np.searchsorted(row[order], np.arange(len(p)))]
        return s[first], distance[first]

    def _brackets(self, p: Array) -> tuple[NDArray[np.intp], Array, Array, Array]:
        """Candidates: number of the point, lower and upper end of the bracket, start."""
        s, table, bend = self._table
        square = (p[:, :1] - table[:, 0]) ** 2 + (p[:, 1:] - table[:, 1]) ** 2
        least = square.min(axis=1)
        # a foot lies within one spacing h of its sample: D <= d^2 + h^2 (1 + |k| d)
        slack = _SPACING**2 * (1.0 + bend * np.sqrt(least))
        near = square <= (least + slack)[:, None]
        near[:, 1:] &= square[:, 1:] <= square[:, :-1]
        near[:, :-1] &= square[:, :-1] <= square[:, 1:]
        # a point past an end has a foot on the straight continuation, however far away
        _, ahead, _ = self._frame(s[[0, -1]])
        near[:, 0] |= (p - table[0]) @ ahead[0] < 0
        near[:, -1] |= (p - table[-1]) @ ahead[1] > 0
        row, k = np.nonzero(near)
        # the straight continuations reach as far as any point can need
        far = np.sqrt(square[row, k]) + _SPACING
        low = np.where(k > 0, s[np.maximum(k - 1, 0)], s[0] - far)
        high = np.where(k < len(s) - 1, s[np.minimum(k + 1, len(s) - 1)], s[-1] + far)
        return row, low, high, s[k]

    def _closest(self, p: Array, low: Array, high: Array, start: Array) -> Array:
        """Newton on f(s) = (c - p) . t, f' = 1 + k (c - p) . n, bisecting where it leaves."""
        x, todo = start.copy(), np.arange(len(p))
        for _ in range(_ITERATIONS):
            c, d, turn = self._frame(x[todo])
            off = c - p[todo]
            f = off[:, 0] * d[:, 0] + off[:, 1] * d[:, 1]
            slope = 1.0 + turn * (off[:, 1] * d[:, 0] - off[:, 0] * d[:, 1])
            high[todo] = np.where(f > 0, x[todo], high[todo])
            low[todo] = np.where(f > 0, low[todo], x[todo])
            with np.errstate(divide="ignore", invalid="ignore"):
                new = x[todo] - f / slope
            good = (slope > 0) & (new >= low[todo]) & (new <= high[todo])
            new = np.where(good, new, 0.5 * (low[todo] + high[todo]))
            moved = np.abs(new - x[todo])
            x[todo] = new
            todo = todo[moved > 1e-15]
            if not len(todo):
                return x
        raise NumericalError(
            f"projection on {self.name}: {len(todo)} points do not settle, the first at "
            f"(y, z) = ({p[todo[0], 0]:.6g}, {p[todo[0], 1]:.6g}) m"
        )


def joined(
    name: str, pieces: Sequence[Piece], zero: float, upper: bool, residual: float = 0.0
) -> ProfileCurve:
    """Curve of given pieces whose arc length is 0 at lateral position `zero`.

    Parameters
    ----------
    name, pieces, upper, residual
        As in `ProfileCurve`.
    zero : float
        y [m] where s = 0.

    Returns
    -------
    ProfileCurve
    """
    curve = ProfileCurve(name, tuple(pieces), 0.0, upper, residual)
    return ProfileCurve(name, curve.pieces, -float(curve.arc_of_y(zero)), upper, residual)


def rail_curve(name: str = "60E1") -> ProfileCurve:
    """Running surface of a rail with both side faces, in the rail's own axes.

    s = 0 at the crown, s grows with y; normals point up and out.

    Parameters
    ----------
    name : str
        ``"60E1"``, ``"UIC60-Manchester"``, the rail of the Manchester contact benchmark, or the
        name of a CSV file with a worn profile (`contactstudy.profiles.worn`).

    Raises
    ------
    InputError
        If there is no such profile, or the file is faulty.
    """
    return _worn(name, "rail") if _is_file(name) else _drawn_rail(name)


def wheel_curve(name: str) -> ProfileCurve:
    """Profile of a wheel: y from the tape circle to the field side, z up, normals pointing down.

    s = 0 and z = 0 at the tape circle's lowest point; s grows with y.

    Parameters
    ----------
    name : str
        ``"cylinder"``, ``"cone"`` (1:20), ``"S1002"``, or the name of a CSV file with a worn
        profile (`contactstudy.profiles.worn`).

    Raises
    ------
    InputError
        If there is no such profile, or the file is faulty.
    """
    return _worn(name, "wheel") if _is_file(name) else _drawn_wheel(name)


@lru_cache(maxsize=16)
def _drawn_rail(name: str) -> ProfileCurve:
    right: list[Piece] = []
    left: list[Piece] = []
    for p in running_pieces(name):
        ends = p.start, p.end
        mirrored = (-p.end[0], p.end[1]), (-p.start[0], p.start[1])
        if isinstance(p, Arc):
            right.append(ArcPiece(p.centre, *ends))
            left.insert(0, ArcPiece((-p.centre[0], p.centre[1]), *mirrored))
        else:
            right.append(LinePiece(*ends))
            left.insert(0, LinePiece(*mirrored))
    return ProfileCurve(name, (*left, *right), -sum(p.length for p in left), upper=True)


@lru_cache(maxsize=16)
def _drawn_wheel(name: str) -> ProfileCurve:
    profile = wheel_profile(name)
    return joined(profile.name, profile.pieces, 0.0, upper=False)


def _is_file(name: str) -> bool:
    return Path(name).suffix.lower() == ".csv"


def _worn(name: str, body: Literal["rail", "wheel"]) -> ProfileCurve:
    path = Path(name)
    # a file that has changed is read again
    return _read(path, body, path.stat().st_mtime_ns if path.is_file() else 0)


@lru_cache(maxsize=16)
def _read(path: Path, body: Literal["rail", "wheel"], changed: int) -> ProfileCurve:
    # worn profiles are made of this module's curves
    from contactstudy.profiles.worn import worn_curve

    return worn_curve(path, body)

"""Smooth plane curve through a cloud of measured points that lie along it.

A cubic least-squares spline (y, z)(s) by arc length. Points are projected on the curve and the
curve is fitted again at the arc lengths of their feet until both agree, so the distances that are
made least are those along the normal. Knots stay where the points ask for them: one after the
other is taken out as long as the fit suffers less than the points' own scatter explains, so the
curve is smooth along the crown and still follows the gauge corner.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve, joined
from contactstudy.profiles.outliers import POINTS
from contactstudy.profiles.penalised_spline import needed_knots, penalised_spline
from contactstudy.profiles.pieces import ParametricPiece, SplinePath

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

_ROUNDS, _GAIN = 20, 1e-5  # repetitions, and relative fall of the residual that is worth one
_SETTLED = 1e-6  # change of the feet [m] at which fit and projection agree
_FLOOR = 2e-9  # scatter [m] below which nothing is fitted: coordinates in single precision


@dataclass(frozen=True)
class CloudFit:
    """A curve fitted to a cloud of points.

    Attributes
    ----------
    spline : BSpline
        (y, z) over the arc length, from 0 [m].
    s : ndarray (n,)
        Arc lengths of the points' feet [m].
    distance : ndarray (n,)
        Signed distances of the points, positive to the left of the walk (above) [m].
    normal : ndarray (n, 2)
        Unit normals at the feet, to the left.
    scatter : float
        Standard deviation of the points about any smooth curve, from their neighbours along
        the curve [m].
    """

    spline: BSpline
    s: Array
    distance: Array
    normal: Array
    scatter: float

    @property
    def length(self) -> float:
        """Arc length of the curve [m]."""
        return float(self.spline.t[-1])

    @property
    def knots(self) -> Array:
        """Arc lengths of the ends and the knots between [m]."""
        return np.unique(self.spline.t)

    @property
    def criterion(self) -> float:
        """Schwarz's criterion for the points and two numbers a knot; the least is the best."""
        n = len(self.s)
        return float(n * np.log(max(self.rms, _FLOOR) ** 2) + 2 * len(self.knots) * np.log(n))

    @property
    def rms(self) -> float:
        """Root mean square of the distances [m]."""
        return float(np.sqrt(np.mean(self.distance**2)))

    def curve(self, origin: Array, upper: bool, name: str) -> ProfileCurve:
        """The curve from an origin (2,) on it [m], s = 0 there."""
        from scipy.interpolate import BSpline

        spline = BSpline(self.spline.t, self.spline.c - origin, self.spline.k)
        # panels that follow the knots closely, for the table of the arc length
        panels = max(400, 8 * len(self.knots))
        piece = ParametricPiece(SplinePath(spline), 0.0, self.length, panels)
        return joined(name, [piece], upper, residual=self.rms)


def fit_cloud(
    points: Array, shortest: float = 1e-3, name: str = "profile", all_knots: bool = False
) -> CloudFit:
    """Fit a curve to points (n, 2) = (y, z) in any order [m] along which y grows.

    Nothing finer than `shortest`, the least distance of knots [m], is taken from the points. With
    `all_knots` those are kept that the points do not ask for; quicker, and enough for residuals.

    Raises
    ------
    InputError
        If there are too few points.
    """
    p = np.asarray(points, dtype=float)
    if len(p) < 20 or not np.ptp(p[:, 0]) > 0:
        raise InputError(f"{name}: {len(p)} points on the running surface; allowed: 20 or more")
    s = _start(p)
    shortest = max(shortest, POINTS * float(s.max()) / len(p))
    knots = np.linspace(0.0, s.max(), max(int(s.max() / shortest), 1) + 1)
    # smooth at first, so that points far from the polygon find their feet
    for stiff in (8.0, 4.0, 2.0):
        for _ in range(3):
            fit = _measured(p, penalised_spline(p, s, knots, stiff * shortest), s)
            s, knots = fit.s, knots * (fit.length / knots[-1])
    fit = _agreed(p, s, knots, shortest)
    if all_knots:
        return fit
    return _agreed(p, fit.s, needed_knots(p, fit.s, fit.knots, fit.scatter, shortest), shortest)


def _start(p: Array) -> Array:
    """Arc length of the points along the polygon through the means of groups in y."""
    order = np.argsort(p[:, 0], kind="stable")
    groups = np.array_split(order, int(np.clip(len(p) // 5, 4, 150)))
    means = np.array([p[g].mean(axis=0) for g in groups])
    means = means[np.concatenate([[True], np.diff(means[:, 0]) > 1e-9])]
    ends = p[order[[0, -1]], 0]
    # the outermost points lie beyond the means of their groups: straight on
    slope = np.diff(means, axis=0)[[0, -1]]
    first = means[0] + slope[0] * (ends[0] - means[0, 0]) / slope[0, 0]
    last = means[-1] + slope[1] * (ends[1] - means[-1, 0]) / slope[1, 0]
    path = np.concatenate([[first], means[1:-1], [last]])
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    # nearest place on the polygon: by the height as well where it is steep
    s = np.interp(p[:, 0], path[:, 0], lengths)
    for _ in range(3):
        foot = np.stack([np.interp(s, lengths, path[:, k]) for k in range(2)], axis=-1)
        k = np.clip(np.searchsorted(lengths, s) - 1, 0, len(lengths) - 2)
        tangent = (path[k + 1] - path[k]) / (lengths[k + 1] - lengths[k])[:, None]
        s = np.clip(s + ((p - foot) * tangent).sum(axis=1), 0.0, lengths[-1])
    return np.asarray(s)


def _agreed(p: Array, s: Array, knots: Array, shortest: float) -> CloudFit:
    """Fit with given knots, the points at the arc lengths of their own feet.

    Fit and projection are repeated until the feet stay or the distances do not fall any more;
    scattered points at the ends may go to and fro for ever. Whatever is left is in the distances.
    """
    best: CloudFit | None = None
    for _ in range(_ROUNDS):
        fit = _measured(p, penalised_spline(p, s, knots, shortest), s)
        # the knots keep their places relative to the points
        scale = fit.length / knots[-1]
        knots = knots * scale
        moved = float(np.abs(fit.s - s * scale).max())
        s = fit.s
        falls = best is None or fit.rms < (1.0 - _GAIN) * best.rms
        if best is None or fit.rms < best.rms:
            best = fit
        if moved < _SETTLED or not falls:
            break
    assert best is not None
    return best


def _measured(p: Array, spline: BSpline, u: Array) -> CloudFit:
    """Feet of the points on a spline, in arc length, with the spline over the same."""
    from scipy.interpolate import BSpline

    end = float(spline.t[-1])
    first, second = spline.derivative(1), spline.derivative(2)
    u = np.clip(u, 0.0, end)
    for _ in range(6):
        # Newton on (c - p) . c' = 0
        c, d, dd = spline(u), first(u), second(u)
        off = c - p
        slope = (d * d).sum(axis=1) + (off * dd).sum(axis=1)
        step = (off * d).sum(axis=1) / np.where(slope > 0, slope, np.inf)
        u = np.clip(u - step, 0.0, end)
        if np.abs(step).max() < 1e-3 * _SETTLED:
            break
    c, d = spline(u), first(u)
    tangent = d / np.linalg.norm(d, axis=1, keepdims=True)
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], axis=-1)
    distance = ((p - c) * normal).sum(axis=1)
    # the spline's parameter is the arc length but for what the last fit has changed
    table = np.linspace(0.0, end, 20 * (len(np.unique(spline.t)) - 1) + 1)
    nodes, weights = np.polynomial.legendre.leggauss(4)
    half = 0.5 * (table[1] - table[0])
    inner = table[:-1, None] + half * (1.0 + nodes)
    speed = np.linalg.norm(first(inner), axis=-1)
    arc = np.concatenate([[0.0], np.cumsum(half * (speed @ weights))])
    s = np.interp(u, table, arc)
    scaled = BSpline(spline.t * (arc[-1] / end), spline.c, spline.k)
    return CloudFit(scaled, s, distance, normal, _scatter(s, distance))


def _scatter(s: Array, distance: Array) -> float:
    """Standard deviation about a smooth curve: second differences of neighbours along it."""
    d = distance[np.argsort(s, kind="stable")]
    # var(d1 - 2 d2 + d3) = 6 sigma^2
    return max(float(np.sqrt(np.mean(np.diff(d, 2) ** 2) / 6.0)), _FLOOR)

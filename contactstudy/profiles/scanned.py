"""Smooth rail heads and wheel treads fitted to scanned surfaces.

A rail head is prismatic along a direction near X, a tread a surface of revolution about an axis
near the direction Y. Direction and axis are fitted with the generating curve: the distances r of
the points from the curve are regressed, within short stretches of the curve (whatever depends on
the arc length alone belongs to the curve), on what small motions would make of them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import CloudFit, fit_cloud
from contactstudy.profiles.curve import ProfileCurve, joined
from contactstudy.profiles.pieces import ParametricPiece, SplinePath

Array = NDArray[np.float64]

STEEPEST = np.deg2rad(80.0)
"""Angle of the surface with the horizontal up to which it can be touched."""
RAIL_DEPTH = 0.03
"""Depth below the top of the rail [m] down to which a scan is used."""
WHEEL_DEPTH = 0.04
"""Depth below the greatest radius, the flange's tip [m], down to which a scan is used."""
_STRETCH = 0.5e-3  # of the curve, within which motions are regressed [m]
_ROUNDS = 12
_SETTLED = 1e-6  # change of a direction [rad] at which the fit has settled
_POINTS = 20_000  # with which direction and axis are fitted; the curve takes all


@dataclass(frozen=True, eq=False)
class ScanFit:
    """A smooth surface fitted to a scan.

    Attributes
    ----------
    curve : ProfileCurve
        Generating curve, with s = 0 and z = 0 at the rail's middle plane or the tape circle.
    rotation : ndarray (3, 3)
        Rows: the fitted surface's own axes in those of the scan.
    origin : ndarray (3,)
        The curve's origin in the axes of the scan [m]: in the middle of the scan along the rail,
        below the axle of a wheel.
    rms, largest : float
        Root mean square and largest magnitude of the residual, the points' distance from the
        fitted surface [m].
    scatter : float
        Its part that differs from point to point [m]; what is left above it is shape.
    angles : dict of str to float
        Fitted misalignments [rad].
    radius : float
        Rolling radius at the tape circle [m]; infinite for a rail.
    radius_error : float
        Its standard error from the scatter [m].
    points, knots : int
        Points used, knots of the curve.
    """

    curve: ProfileCurve
    rotation: Array
    origin: Array
    rms: float
    largest: float
    scatter: float
    angles: dict[str, float]
    radius: float
    radius_error: float
    points: int
    knots: int

    def aligned(self, points: Array) -> Array:
        """Points (n, 3) of the scan in the fitted surface's own axes [m]."""
        return np.asarray((np.asarray(points, dtype=float) - self.origin) @ self.rotation.T)


def fit_rail_head(
    points: Array, normals: Array, middle: float = 0.0, shortest: float = 1e-3, name: str = "rail"
) -> ScanFit:
    """Prism near X through the points of a scanned rail head.

    Parameters
    ----------
    points, normals : ndarray (n, 3)
        Vertices, X along the rail, Y to the field side, Z up [m], and outward unit normals.
    middle : float
        Y of the rail's middle plane, half way along the scan [m].
    shortest : float
        Least distance of the curve's knots [m].
    name : str
        For messages.

    Returns
    -------
    ScanFit

    Raises
    ------
    InputError
        If the points do not show a running surface around its middle plane.
    """
    p, n = np.asarray(points, dtype=float), np.asarray(normals, dtype=float)
    top = p[n[:, 2] > np.cos(STEEPEST), 2].max(initial=-np.inf)
    used = (n[:, 2] > np.cos(STEEPEST)) & (p[:, 2] > top - RAIL_DEPTH)
    p, n = p[used], n[used]
    if not len(p):
        raise InputError(f"{name}: no facet faces upwards; a rail head's running surface is needed")
    centre = np.array([0.5 * (p[:, 0].min() + p[:, 0].max()), middle, 0.0])
    # normals of a prism are square to its direction
    direction = np.linalg.eigh(n.T @ n)[1][:, 0]
    direction = direction * np.copysign(1.0, direction[0])
    if direction[0] < 0.9:
        raise InputError(
            f"{name}: the surface runs along ({direction[0]:.2f}, {direction[1]:.2f}, "
            f"{direction[2]:.2f}); a rail head must run along X"
        )
    angles = np.array([np.arctan2(direction[1], direction[0]), np.arcsin(direction[2])])
    part = _part(len(p))
    for _ in range(_ROUNDS):
        q = (p[part] - centre) @ _rail_axes(angles).T
        fit = fit_cloud(q[:, 1:], shortest, name, all_knots=True)
        # a turn d of the direction moves a point by -x (d_yaw, d_pitch), r by -x d.n
        change, _ = _regressed(fit, q[:, :1] * fit.normal)
        angles = angles + change
        if np.abs(change).max() < _SETTLED:
            break
    axes = _rail_axes(angles)
    fit = fit_cloud(((p - centre) @ axes.T)[:, 1:], shortest, name)
    curve, shift = _curve(fit, 0.0, True, name)
    origin = centre + shift @ axes
    turned = {"yaw": float(angles[0]), "pitch": float(angles[1])}
    return _result(fit, curve, axes, origin, turned, np.inf, 0.0)


def fit_wheel_tread(
    points: Array, normals: Array, tape: float = 0.0, shortest: float = 1e-3, name: str = "wheel"
) -> ScanFit:
    """Surface of revolution about an axis near Y through the points of a scanned tread.

    The axis is horizontal: about X it cannot be told from the profile's own slope.

    Parameters
    ----------
    points, normals : ndarray (n, 3)
        Vertices, X along the rail, Y to the field side, Z up, tread down or all round [m], and
        outward unit normals.
    tape : float
        Y of the tape circle [m].
    shortest, name
        As in `fit_rail_head`.

    Returns
    -------
    ScanFit

    Raises
    ------
    InputError
        If the points do not show a tread around its tape circle, or too little of its
        circumference to find the axis.
    """
    p, n = np.asarray(points, dtype=float), np.asarray(normals, dtype=float)
    base = np.array([0.0, tape, 0.0])
    x0, z0, yaw = _first_axis(p - base, n, name)
    # the tape circle is at its place where the wheel is lowest
    base[0], x0 = x0, 0.0
    p = p - base
    radial = _from_axis(p, x0, z0, yaw)
    out = (_turned(n, yaw)[:, 0] * radial[1] + n[:, 2] * radial[2]) > np.cos(STEEPEST)
    depth = radial[0][out].max(initial=-np.inf) - radial[0]
    p = p[out & (depth < WHEEL_DEPTH)]
    if not len(p):
        raise InputError(f"{name}: no facet faces away from the axle; a wheel's tread is needed")
    part = _part(len(p))
    error = np.inf
    for _ in range(_ROUNDS):
        rho, u, v = _from_axis(p[part], x0, z0, yaw)
        y = _turned(p[part], yaw)[:, 1]
        fit = fit_cloud(np.stack([y, -rho], axis=-1), shortest, name, all_knots=True)
        # d rho = -u dx0 - v dz0 + u y dyaw, and the residual changes by -n_h d rho
        # (n_h alone, times a constant, belongs to the curve: only what differs along x counts)
        n_h, u, v = fit.normal[:, 1], u - u.mean(), v - v.mean()
        change, covariance = _regressed(fit, np.stack([n_h * u, n_h * v, -n_h * u * y], axis=-1))
        x0, z0, yaw = x0 - change[0], z0 - change[1], yaw - change[2]
        # the curve follows the axis, so the radius at the tape circle is as uncertain as z0
        error = fit.scatter * float(np.sqrt(covariance[1, 1] / (len(p) / len(p[part]))))
        if abs(change[2]) < _SETTLED and np.abs(change[:2]).max() < max(0.05 * error, 1e-9):
            break
    rho, _, _ = _from_axis(p, x0, z0, yaw)
    fit = fit_cloud(np.stack([_turned(p, yaw)[:, 1], -rho], axis=-1), shortest, name)
    curve, shift = _curve(fit, 0.0, False, name)
    radius = float(-shift[2])
    axes = _turn(yaw)
    axle = np.array([x0, 0.0, z0]) @ axes + base
    origin = axle - np.array([0.0, 0.0, radius])
    return _result(fit, curve, axes, origin, {"yaw": float(yaw)}, radius, error)


def _part(n: int) -> slice:
    return slice(None, None, max(n // _POINTS, 1))


def _rail_axes(angles: Array) -> Array:
    """Rows: the direction (yaw, pitch), the horizontal across it, and up."""
    c, s = np.cos(angles), np.sin(angles)
    along = np.array([c[0] * c[1], s[0] * c[1], s[1]])
    across = np.array([-s[0], c[0], 0.0])
    return np.stack([along, across, np.cross(along, across)])


def _turn(yaw: float) -> Array:
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def _turned(p: Array, yaw: float) -> Array:
    return np.asarray(p @ _turn(yaw).T)


def _from_axis(p: Array, x0: float, z0: float, yaw: float) -> tuple[Array, Array, Array]:
    """Distance from the axis, and its direction cosines in x and z."""
    q = _turned(p, yaw)
    dx, dz = q[:, 0] - x0, q[:, 2] - z0
    rho = np.hypot(dx, dz)
    return rho, dx / rho, dz / rho


def _first_axis(p: Array, n: Array, name: str) -> tuple[float, float, float]:
    """Axis through the points whose facets face it, by linear least squares."""
    q = p[np.abs(n[:, 1]) < 0.2]
    q = q[_part(len(q))]
    if len(q) < 20:
        raise InputError(f"{name}: {len(q)} points face away from the axle; allowed: 20 or more")
    # x^2 + z^2 = 2 (x0 + y tan(yaw)) x + 2 z0 z + c(y) to first order; c as a spline
    x, y, z = q.T
    knots = np.linspace(y.min(), y.max(), max(int(np.ptp(y) / 3e-3), 1) + 1)
    padded = np.concatenate([[knots[0]] * 3, knots, [knots[-1]] * 3])
    basis = BSpline(padded, np.eye(len(padded) - 4), 3)(y)
    A = np.column_stack([2.0 * x, 2.0 * z, 2.0 * x * y, basis])
    found, _, _, _ = np.linalg.lstsq(A, x**2 + z**2, rcond=1e-10)
    x0, z0, turn = (float(v) for v in found[:3])
    if not 0.1 < z0 - z.min() < 2.0 or abs(turn) > 0.2:
        raise InputError(
            f"{name}: circles through the scan lie {z0 - z.min():.4g} m above its lowest point and "
            f"turned by {turn:.3g} rad; it does not show a tread, downwards and with its axle along"
            " Y, or too little of its circumference"
        )
    return x0, z0, -turn


def _within(group: NDArray[np.int64], columns: Array) -> Array:
    """Columns less their means within groups."""
    _, where, count = np.unique(group, return_inverse=True, return_counts=True)
    where = where.ravel()
    means = [np.bincount(where, column) / count for column in columns.T]
    return np.asarray(columns - np.stack(means, axis=-1)[where])


def _regressed(fit: CloudFit, columns: Array) -> tuple[Array, Array]:
    """Coefficients of the residual's columns, and their covariance over the variance."""
    group = np.floor(fit.s / _STRETCH).astype(np.int64)
    both = _within(group, np.column_stack([columns, fit.distance]))
    A, r = both[:, :-1], both[:, -1]
    inverse: Array = np.asarray(np.linalg.pinv(A.T @ A, rcond=1e-13, hermitian=True), dtype=float)
    return inverse @ (A.T @ r), inverse


def _curve(fit: CloudFit, zero: float, upper: bool, name: str) -> tuple[ProfileCurve, Array]:
    """Curve with its origin at y = zero, and that origin (0, y, z) in the fit's axes."""
    ends = fit.spline([0.0, fit.length])[:, 0]
    if not ends[0] < zero < ends[1]:
        what = "the rail's middle plane" if upper else "the tape circle"
        raise InputError(
            f"{name}: {what} is {1e3 * (zero - ends[0]):.1f} mm beyond the scan's lower end in Y, "
            f"{1e3 * (ends[1] - zero):.1f} mm below its upper end; it must lie between them"
        )
    u = np.linspace(0.0, fit.length, 2000)
    s = float(np.interp(zero, fit.spline(u)[:, 0], u))
    for _ in range(4):
        s -= float((fit.spline(s)[0] - zero) / fit.spline(s, 1)[0])
    shift = np.array([0.0, zero, float(fit.spline(s)[1])])
    spline = BSpline(fit.spline.t, fit.spline.c - shift[1:], fit.spline.k)
    # panels that follow the knots closely, for the table of the arc length
    panels = max(400, 8 * len(fit.knots))
    piece = ParametricPiece(SplinePath(spline), 0.0, fit.length, panels)
    return joined(name, [piece], 0.0, upper, residual=fit.rms), shift


def _result(
    fit: CloudFit,
    curve: ProfileCurve,
    axes: Array,
    origin: Array,
    angles: dict[str, float],
    radius: float,
    radius_error: float,
) -> ScanFit:
    return ScanFit(
        curve,
        axes,
        origin,
        fit.rms,
        float(np.abs(fit.distance).max()),
        fit.scatter,
        angles,
        radius,
        radius_error,
        len(fit.s),
        len(fit.knots),
    )

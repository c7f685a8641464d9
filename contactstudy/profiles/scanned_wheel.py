"""Smooth wheel treads fitted to scanned surfaces: of revolution about an axis near Y."""

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import fit_cloud
from contactstudy.profiles.scan_fit import (
    ROUNDS,
    SETTLED,
    STEEPEST,
    ScanFit,
    curve_of,
    part_of,
    regressed,
    scan_fit,
)

WHEEL_DEPTH = 0.04
"""Depth below the greatest radius, the flange's tip [m], down to which a scan is used."""


def fit_wheel_tread(
    points: Array, normals: Array, tape: float = 0.0, shortest: float = 1e-3, name: str = "wheel"
) -> ScanFit:
    """Surface of revolution about an axis near Y through the points of a scanned tread.

    The axis is horizontal: about X it cannot be told from the profile's own slope. Points and
    normals as in `contactstudy.profiles.scanned_rail.fit_rail_head`, tread down or all round;
    `tape` is Y of the tape circle [m].

    Raises
    ------
    InputError
        If the points do not show a tread around its tape circle, or too little of its
        circumference to find the axis.
    """
    p, n = np.asarray(points, dtype=float), np.asarray(normals, dtype=float)
    # from the middle of the scan, whose place along the rail and height mean nothing
    middle = 0.5 * (p.min(axis=0) + p.max(axis=0))
    base = np.array([middle[0], tape, middle[2]])
    x0, z0, yaw = _first_axis(p - base, n, name)
    # the tape circle is at its place where the wheel is lowest
    base[0], x0 = base[0] + x0, 0.0
    p = np.asarray(points, dtype=float) - base
    radial = _from_axis(p, x0, z0, yaw)
    out = (_turned(n, yaw)[:, 0] * radial[1] + n[:, 2] * radial[2]) > np.cos(STEEPEST)
    depth = radial[0][out].max(initial=-np.inf) - radial[0]
    p = p[out & (depth < WHEEL_DEPTH)]
    if not len(p):
        raise InputError(f"{name}: no facet faces away from the axle; a wheel's tread is needed")
    part = part_of(len(p))
    error = np.inf
    for _ in range(ROUNDS):
        rho, u, v = _from_axis(p[part], x0, z0, yaw)
        y = _turned(p[part], yaw)[:, 1]
        fit = fit_cloud(np.stack([y, -rho], axis=-1), shortest, name, all_knots=True)
        # d rho = -u dx0 - v dz0 + u y dyaw, and the residual changes by -n_h d rho
        # (n_h alone, times a constant, belongs to the curve: only what differs along x counts)
        n_h, u, v = fit.normal[:, 1], u - u.mean(), v - v.mean()
        change, covariance = regressed(fit, np.stack([n_h * u, n_h * v, -n_h * u * y], axis=-1))
        x0, z0, yaw = x0 - change[0], z0 - change[1], yaw - change[2]
        # the curve follows the axis, so the radius at the tape circle is as uncertain as z0
        error = fit.scatter * float(np.sqrt(covariance[1, 1] / (len(p) / len(p[part]))))
        if abs(change[2]) < SETTLED and np.abs(change[:2]).max() < max(0.05 * error, 1e-9):
            break
    rho, _, _ = _from_axis(p, x0, z0, yaw)
    fit = fit_cloud(np.stack([_turned(p, yaw)[:, 1], -rho], axis=-1), shortest, name)
    curve, shift = curve_of(fit, False, name)
    radius = float(-shift[2])
    axes = _turn(yaw)
    axle = np.array([x0, 0.0, z0]) @ axes + base
    origin = axle - np.array([0.0, 0.0, radius])
    return scan_fit(fit, curve, axes, origin, {"yaw": float(yaw)}, radius, error)


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
    from scipy.interpolate import BSpline

    q = p[np.abs(n[:, 1]) < 0.2]
    q = q[part_of(len(q))]
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

"""What the fits of scanned rail heads and wheel treads share.

A rail head is prismatic along a direction near X, a tread a surface of revolution about an axis
near the direction Y. Direction and axis are fitted with the generating curve: the distances r of
the points from the curve are regressed, within short stretches of the curve (whatever depends on
the arc length alone belongs to the curve), on what small motions would make of them.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import CloudFit
from contactstudy.profiles.curve import ProfileCurve

STEEPEST = np.deg2rad(80.0)
"""Angle of the surface with the horizontal up to which it can be touched."""
ROUNDS = 12
"""Rounds of curve and motions."""
SETTLED = 1e-6
"""Change of a direction [rad] at which the fit has settled."""
_STRETCH = 0.5e-3  # of the curve, within which motions are regressed [m]
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


def _within(group: IntArray, columns: Array) -> Array:
    """Columns less their means within groups."""
    _, where, count = np.unique(group, return_inverse=True, return_counts=True)
    where = where.ravel()
    means = [np.bincount(where, column) / count for column in columns.T]
    return np.asarray(columns - np.stack(means, axis=-1)[where])


def regressed(fit: CloudFit, columns: Array) -> tuple[Array, Array]:
    """Coefficients of the residual's columns, and their covariance over the variance."""
    group = np.floor(fit.s / _STRETCH).astype(np.int64)
    both = _within(group, np.column_stack([columns, fit.distance]))
    A, r = both[:, :-1], both[:, -1]
    inverse: Array = np.asarray(np.linalg.pinv(A.T @ A, rcond=1e-13, hermitian=True), dtype=float)
    return inverse @ (A.T @ r), inverse


def curve_of(fit: CloudFit, upper: bool, name: str) -> tuple[ProfileCurve, Array]:
    """Curve with its origin at y = 0, and that origin (0, 0, z) in the fit's axes [m]."""
    ends = fit.spline([0.0, fit.length])[:, 0]
    if not ends[0] < 0.0 < ends[1]:
        what = "the rail's middle plane" if upper else "the tape circle"
        raise InputError(
            f"{name}: {what} is {1e3 * (0.0 - ends[0]):.1f} mm beyond the scan's lower end in Y, "
            f"{1e3 * ends[1]:.1f} mm below its upper end; it must lie between them"
        )
    u = np.linspace(0.0, fit.length, 2000)
    s = float(np.interp(0.0, fit.spline(u)[:, 0], u))
    for _ in range(4):
        s -= float(fit.spline(s)[0] / fit.spline(s, 1)[0])
    shift = np.array([0.0, 0.0, float(fit.spline(s)[1])])
    return fit.curve(shift[1:], upper, name), shift


def scan_fit(
    fit: CloudFit,
    curve: ProfileCurve,
    axes: Array,
    origin: Array,
    angles: dict[str, float],
    radius: float,
    radius_error: float,
) -> ScanFit:
    """Fitted surface and its figures, from the last fit of its generating curve."""
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


def part_of(n: int) -> slice:
    """Of n points those with which direction and axis are fitted."""
    return slice(None, None, max(n // _POINTS, 1))

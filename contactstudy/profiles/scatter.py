"""What the scatter of a measured profile's points does to the curvature of the curve through them.

A formula for given knots is some three times too low: scatter also decides which knots are kept,
and so how far the ends of arcs are smoothed. So the fit is done again, with other scatter.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import CloudFit
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.outliers import BEARABLE, POINTS
from contactstudy.profiles.penalised_spline import needed_knots, penalised_spline

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

WORST = 10.0
"""Error of the curvature [1/m] that is refused: it moves Hertz's peak pressure by more than a
third."""
RUNNING = 0.02
"""Half the width of the running surface [m], over which the error is taken. In a gauge corner, of
80 1/m, more could be borne."""
_TIMES = 8  # the fit is repeated
_MOST = 1000  # points of a repeated fit


def scatter_of_rounding(points: Array, digits: Array | None = None) -> float:
    """Standard deviation [m] of points that stand in single precision, from their distance.

    Coordinates in the file are `digits`, by default the points themselves; 0 unless all of them are
    numbers of single precision. A step q of rounding scatters by q/sqrt(12).
    """
    given = points if digits is None else digits
    off = np.abs(given.astype(np.float32).astype(float) - given)
    if not given.any() or np.any(off > 1e-15 * np.abs(given)):  # that of a change of unit and back
        return 0.0
    largest = np.abs(given).max()
    scale = np.abs(points).max() / largest
    return float(np.spacing(np.float32(largest))) * float(scale) / np.sqrt(12.0)


def doubted(curve: ProfileCurve, scatter: float, points: int, spacings: Sequence[float]) -> str:
    """What scatter [m] does to a fitted curve's curvature, "" where it can be borne.

    Raises
    ------
    InputError
        Where no contact stress can be had from such a curve.
    """
    error = curvature_error(curve, scatter, points, spacings)
    if error <= BEARABLE:
        return ""
    told = (
        f"{curve.name}: its points scatter by {1e6 * scatter:.3g} um, which leaves the curvature "
        f"uncertain by {error:.2g} 1/m (a 60E1 crown has 3.3 1/m)"
    )
    if error > WORST:
        raise InputError(
            f"{told}; allowed: up to {WORST:g} 1/m (measure more points, or smooth them, or move a "
            "file in single precision to its origin)"
        )
    return told


def curvature_error(
    curve: ProfileCurve, scatter: float, points: int, spacings: Sequence[float]
) -> float:
    """Error of a fitted curve's curvature on the running surface [1/m], root mean square.

    The median of several fits, for a stray knot makes some of them several times worse.

    Parameters
    ----------
    curve : ProfileCurve
        Fitted to so many `points`, with the best of these `spacings` of knots [m].
    scatter : float
        Standard deviation of the points along the normal [m].
    """
    low, high = curve.s_range
    # with all knots, L apart, n points each leave a wave of 2 L with the amplitude scatter/sqrt(n)
    apart = max(min(spacings), POINTS * (high - low) / points)
    each = points * apart / (high - low)
    most = float(scatter / np.sqrt(each) * (np.pi / apart) ** 2)
    if most <= BEARABLE:
        return most
    # fewer points that scatter less say as much
    count = min(points, _MOST)
    scatter *= np.sqrt(count / points)
    s = np.linspace(0.0, high - low, count)
    p, normal = curve.point_and_normal(low + s)
    at = np.linspace(max(low, -RUNNING), min(high, RUNNING), 400)
    fitted = (-1.0 if curve.upper else 1.0) * curve.curvature(at)
    random = np.random.default_rng(0)
    errors = []
    for _ in range(_TIMES):
        scattered = p + scatter * random.standard_normal((count, 1)) * normal
        spline = _fitted(scattered, normal, s, scatter, spacings)
        d, dd = spline(at - low, 1), spline(at - low, 2)
        k = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.linalg.norm(d, axis=1) ** 3
        errors.append(k - fitted)
    return float(np.median(np.sqrt(np.mean(np.square(errors), axis=1))))


def _fitted(
    p: Array, normal: Array, s: Array, scatter: float, spacings: Sequence[float]
) -> "BSpline":
    """The best fit of `contactstudy.profiles.cloud` to points (n, 2) whose feet (n,) are known."""
    fits = []
    for spacing in spacings:
        apart = max(spacing, POINTS * float(s[-1]) / len(s))
        knots = np.linspace(0.0, s[-1], max(int(s[-1] / apart), 1) + 1)
        knots = needed_knots(p, s, knots, scatter, apart)
        spline = penalised_spline(p, s, knots, apart)
        off = ((p - spline(s)) * normal).sum(axis=1)
        fits.append(CloudFit(spline, s, off, normal, scatter))
    return min(fits, key=lambda fit: fit.criterion).spline

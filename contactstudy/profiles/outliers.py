"""Single points off a measured profile, and what the scatter left does to its curvature.

Contact stresses follow the curvature, so curvature is the measure: a point off by d between
neighbours a distance h away bends the curve there by 2 d/h^2.
"""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError

SHARPEST = 200.0
"""Curvature [1/m] that no profile has on its running surface: radii of 5 mm."""
MOST = 0.02
"""Share of the points that may be outliers."""
LARGEST_RESIDUAL = 1e-4
"""Root mean square [m] above which a fit is none, of profiles and scans."""
BEARABLE, WORST = 1.0, 10.0
"""Errors of the curvature [1/m] that are said, and refused: a third and three times that of a 60E1
crown. Of two bodies with curvatures about 3 and 12 1/m the first moves Hertz's peak pressure by
about a twentieth, the second by more than a third."""
_SIGMAS = 6.0


def outliers(points: Array) -> tuple[IntArray, Array]:
    """Numbers of outliers among points (n, 2) in walking order, and their distances [m].

    A point is compared with the cubic through its two neighbours on either side. It is an outlier
    if it lies off by more than six of the points' own standard deviations, from the median of all,
    and bends the curve more than `SHARPEST`. One after the other is taken out, the worst first.
    """
    left = np.arange(len(points))
    found: list[int] = []
    off: list[float] = []
    while len(left) > 10 and len(found) <= MOST * len(points):
        deviation, bend = _deviations(points[left])
        limit = _SIGMAS * 1.4826 * np.median(np.abs(deviation))
        ratio = np.where(np.abs(deviation) > limit, bend / SHARPEST, 0.0)
        worst = int(np.argmax(ratio))
        if ratio[worst] <= 1.0:
            break
        found.append(int(left[worst + 2]))
        off.append(abs(float(deviation[worst])))
        left = np.delete(left, worst + 2)
    return np.array(found, dtype=np.int64), np.array(off)


def _deviations(p: Array) -> tuple[Array, Array]:
    """Distances [m] of points 2 to n - 3 from the cubic of their neighbours, and bends [1/m]."""
    s = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    near = (-2, -1, 1, 2)
    at = [s[2 + k : len(p) - 2 + k] for k in near]
    here = s[2 : len(p) - 2]
    predicted = np.zeros((len(p) - 4, 2))
    for i, k in enumerate(near):
        # Lagrange's polynomials at the point's own arc length
        weight = np.prod([(here - t) / (at[i] - t) for j, t in enumerate(at) if j != i], axis=0)
        predicted += weight[:, None] * p[2 + k : len(p) - 2 + k]
    chord = p[3 : len(p) - 1] - p[1 : len(p) - 3]
    h = np.linalg.norm(chord, axis=1)
    gap = p[2:-2] - predicted
    deviation = (gap[:, 1] * chord[:, 0] - gap[:, 0] * chord[:, 1]) / h
    return deviation, 2.0 * np.abs(deviation) / (0.5 * h) ** 2


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


def doubted(name: str, scatter: float, points: int, length: float, knots: int) -> str:
    """What scatter [m] does to a fitted curve's curvature, "" where it can be borne.

    Raises
    ------
    InputError
        Where no contact stress can be had from such a curve.
    """
    error = curvature_error(scatter, points, length, knots)
    if error <= BEARABLE:
        return ""
    told = (
        f"{name}: its points scatter by {1e6 * scatter:.3g} um, which leaves the curvature "
        f"uncertain by {error:.2g} 1/m (a 60E1 crown has 3.3 1/m)"
    )
    if error > WORST:
        raise InputError(
            f"{told}; allowed: up to {WORST:g} 1/m (measure more points, or smooth them, or move a "
            "file in single precision to its origin)"
        )
    return told


def curvature_error(scatter: float, points: int, length: float, knots: int) -> float:
    """Standard error of a fitted curve's curvature [1/m] from the scatter of its points [m].

    Between knots L apart n points leave a wave of length 2 L with the amplitude scatter/sqrt(n),
    and with the curvature of it, times (pi/L)^2.
    """
    apart = length / max(knots - 1, 1)
    each = max(points * apart / length, 1.0)
    return float(scatter / np.sqrt(each) * (np.pi / apart) ** 2)

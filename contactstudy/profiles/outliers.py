"""Single points off a measured profile.

Contact stresses follow the curvature, so curvature is the measure: a point off by d between
neighbours a distance h away bends the curve there by 2 d/h^2.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray

SHARPEST = 200.0
"""Curvature [1/m] that no profile has on its running surface: radii of 5 mm."""
KNOTS, POINTS = 0.7e-3, 3
"""Least distance of a fitted curve's knots [m], and least number of points between them."""
MOST = 0.02
"""Share of the points that may be outliers."""
LARGEST_RESIDUAL = 1e-4
"""Root mean square [m] above which a fit is none, of profiles and scans."""
BEARABLE = 1.0
"""Error of the curvature [1/m] that is said: a third of that of a 60E1 crown. Of two bodies with
curvatures about 3 and 12 1/m it moves Hertz's peak pressure by about a twentieth."""
_SIGMAS = 6.0
_LONGEST = 3  # points in a row that are outliers together
_NEAR = 2  # points on either side that a point is compared with
_LIKE = 0.02  # share of what is seen near an outlier that it may leave unexplained
_LOWEST = 1e-6  # m; what is off by less may be how the coordinates are rounded


def most(count: int) -> int:
    """Outliers that so many points may have."""
    return max(int(MOST * count), _LONGEST)


def outliers(points: Array) -> tuple[IntArray, Array]:
    """Numbers of outliers among points (n, 2) in walking order, and their distances [m].

    A point is compared with the cubic through its two neighbours on either side. Where it is off by
    d, its neighbours seem to be off as well, by known shares of d: that tells one point, or up to
    three in a row, from the end of an arc, at which the curvature jumps. Such are outliers if
    they lie off by more than six of the points' own standard deviations, from the median of all,
    and would bend a fitted curve by more than `BEARABLE`. So is any that bends the points' own
    curve more than `SHARPEST`; of the last two at either end, which may as well begin another arc,
    only such are. They are taken out, the worst first.
    """
    left = np.arange(len(points))
    found: list[int] = []
    off: list[float] = []
    while len(left) > 10 and len(found) <= most(len(points)):
        seen = _Deviations.of(points[left])
        out = seen.spike() or seen.sharpest()
        if not out:
            break
        found += [int(left[k]) for k in out]
        off += [abs(d) for d in out.values()]
        left = np.delete(left, list(out))
    return np.array(found, dtype=np.int64), np.array(off)


def steps(points: Array) -> tuple[IntArray, Array, Array]:
    """Numbers of points (n, 2) from which on all lie higher or lower, by how much [m], and bends.

    A step is told from the end of an arc as outliers are, by what it makes the points beside it
    seem. The bends [1/m] are those of a fitted curve that climbs it between two knots.
    """
    if len(points) <= 10:
        return np.zeros(0, dtype=np.int64), np.zeros(0), np.zeros(0)
    seen = _Deviations.of(points)
    height, good, much = seen.explained(seen.of_steps())
    height = np.abs(height)
    good &= much > seen.much
    at = np.flatnonzero(good & (height > 2.0 * seen.limit))  # the ends of arcs look like lower ones
    return at, height[at], height[at] * (np.pi / (2.0 * seen.apart[at])) ** 2


@dataclass(frozen=True)
class _Deviations:
    """How far each point (n,) is `off` the cubic of its neighbours [m].

    `shares` (n, 5): what points k - 2 to k + 2 seem to be off where point k is off by 1. `limit`
    (n,): how far off does no harm [m]. `apart` (n,): distance of a fit's knots there [m].
    `bend` (n,): curvature [1/m]. `sigma`: scatter of what points are off [m].
    """

    off: Array
    shares: Array
    limit: Array
    apart: Array
    bend: Array
    sigma: float

    @classmethod
    def of(cls, p: Array) -> "_Deviations":
        n = len(p)
        s = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
        here, near = np.arange(_NEAR, n - _NEAR), (-2, -1, 1, 2)
        shares, predicted = np.zeros((n, 2 * _NEAR + 1)), np.zeros((len(here), 2))
        shares[here, _NEAR] = 1.0
        for k in near:
            # Lagrange's polynomials at the point's own arc length
            weight = np.ones(len(here))
            for j in near:
                if j != k:
                    weight *= (s[here] - s[here + j]) / (s[here + k] - s[here + j])
            predicted += weight[:, None] * p[here + k]
            shares[here + k, _NEAR - k] = -weight
        chord = p[here + 1] - p[here - 1]
        h = 0.5 * np.linalg.norm(chord, axis=1)
        gap = p[here] - predicted
        off, bend, limit = np.zeros(n), np.zeros(n), np.full(n, np.inf)
        off[here] = (gap[:, 1] * chord[:, 0] - gap[:, 0] * chord[:, 1]) / (2.0 * h)
        bend[here] = 2.0 * np.abs(off[here]) / h**2
        sigma = 1.4826 * float(np.median(np.abs(off[here])))
        # a point off by d among m between knots L apart leaves d/m, with the curvature of a wave
        apart = np.full(n, KNOTS)
        apart[here] = np.maximum(KNOTS, POINTS * h)
        harm = BEARABLE * (apart[here] / h) * (apart[here] / np.pi) ** 2
        limit[here] = np.maximum(_LOWEST, harm)
        limit[:_NEAR], limit[-_NEAR:] = 0.5 * SHARPEST * h[0] ** 2, 0.5 * SHARPEST * h[-1] ** 2
        return cls(off, shares, limit, apart, bend, sigma)

    @property
    def much(self) -> float:
        """Sum of squares [m^2] that scatter does not make.

        Scatter of a point is seen at its neighbours as well, with shares whose squares add up to 2:
        of what is explained the standard deviation is up to ``sqrt(2) sigma``.
        """
        return 2.0 * (_SIGMAS * self.sigma) ** 2

    def of_runs(self, count: int) -> Array:
        """As `shares`, of each point and the next ones together, (n, 4 + count)."""
        n, width = self.shares.shape
        runs = np.zeros((n, width + count - 1))
        for j in range(count):
            runs[: n - j, j : j + width] += self.shares[j:]
        if count > 1:  # too little is seen of several at the ends
            runs[: 2 * _NEAR] = runs[n - 2 * _NEAR - count + 1 :] = 0.0
        return runs

    def of_steps(self) -> Array:
        """As `shares`, of each point and all behind it together, (n, 4): points k - 2 to k + 1."""
        n = len(self.off)
        steps = np.zeros((n, 2 * _NEAR))
        for row in range(2 * _NEAR):  # point k + row - 2, and the points j that it is compared with
            for j in range(row + 1):
                steps[: n - j, row] += self.shares[j:, row - j]
        steps[: _NEAR + 1] = steps[n - 2 * _NEAR :] = 0.0
        return steps

    def explained(self, shares: Array) -> tuple[Array, BoolArray, Array]:
        """How far something (n,) is off, from its shares (n, m); whether that is all; how much."""
        n, width = shares.shape
        padded = np.concatenate([np.zeros(_NEAR), self.off, np.zeros(width)])
        seen = np.lib.stride_tricks.sliding_window_view(padded, width)[:n]
        seen = np.where(np.abs(shares) > 1e-9, seen, 0.0)
        size = (shares**2).sum(axis=1)
        height = (shares * seen).sum(axis=1) / np.where(size > 0.0, size, np.inf)
        rest = ((seen - height[:, None] * shares) ** 2).sum(axis=1)
        allowed = _LIKE * (seen**2).sum(axis=1) + 2.0 * _SIGMAS * self.sigma**2
        return height, (size > 0.0) & (rest <= allowed), height**2 * size

    def spike(self) -> dict[int, float]:
        """The worst outlier, a point or a few in a row, and how far each is off [m]."""
        worst, found = 0.0, dict[int, float]()
        for count in range(1, _LONGEST + 1):
            height, good, much = self.explained(self.of_runs(count))
            for end, second in ((0, 1), (-1, -2)):  # the second one is seen at two points
                good[end] &= not (good[second] and much[second] > much[end])
            good &= (np.abs(height) > self.limit) & (much > self.much)
            much = np.where(good, much, 0.0)
            k = int(np.argmax(much))
            if much[k] > worst:
                worst, found = float(much[k]), dict.fromkeys(range(k, k + count), float(height[k]))
        return found

    def sharpest(self) -> dict[int, float]:
        """The point that bends the points' own curve most, if that is no profile's."""
        beyond = np.abs(self.off) > _SIGMAS * self.sigma
        k = int(np.argmax(np.where(beyond, self.bend, 0.0)))
        return {k: float(self.off[k])} if beyond[k] and self.bend[k] > SHARPEST else {}

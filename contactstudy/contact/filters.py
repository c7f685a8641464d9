"""What a contact makes of an irregularity along the rail before its law acts at a point.

A filter says for a profile r(X) what a wheel at X feels of it. Two are functions of the profile
alone: where a rigid wheel rests on it, and its weighted mean under a patch of fixed size.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contactstudy.arrays import Array

Level = Callable[[Array], Array]
"""r at positions X of any shape, both in m."""
_STEP = 0.25e-3
"""m, between the places at which the highest point under a rigid wheel is looked for."""
_ORDER = 20
"""Of Gauss's rule over a patch: a cosine is averaged to rounding up to k a = 15."""


class ContactFilter(Protocol):
    """What a wheel feels of an irregularity."""

    def __call__(self, level: Level, x: Array) -> Array:
        """Irregularity (n,) [m] that a wheel feels at positions x (n,) [m]."""


@dataclass(frozen=True)
class Trajectory:
    """The height at which a rigid round wheel rests on the profile, its radius in m.

    ``max over x of r(X + x) - (R - sqrt(R^2 - x^2))``: the wheel bridges dips that are narrower
    than it is round. (For flats: M. Steenbergen, Veh. Syst. Dyn. 46 (2008) 143.)
    """

    radius: float

    def __call__(self, level: Level, x: Array) -> Array:
        """See `ContactFilter`."""
        # at its centre, where it does touch there, without the rounding of the search
        return np.maximum(self.rest(level, x)[1], level(x))

    def rest(self, level: Level, x: Array) -> tuple[Array, Array]:
        """How far ahead of its centre the wheel touches, and its height, (n,) in m."""
        if not x.size:
            return x, x
        low, high = float(x.min()), float(x.max())
        reach = self._reach(level, low, high)
        n, first = int(reach / _STEP), low - reach - _STEP
        count = int((high - first + reach) / _STEP) + 3
        grid = np.linspace(first, first + _STEP * (count - 1), count)
        r = level(grid)
        ahead = np.empty(len(x))
        for block in np.array_split(np.arange(x.size), 1 + x.size * n // 1_000_000):
            near = np.rint((x[block] - first) / _STEP).astype(int)[:, None] + np.arange(-n, n + 1)
            tried = grid[near] - x[block, None]
            best = (r[near] - self._drop(tried)).argmax(axis=1)[:, None]
            ahead[block] = np.take_along_axis(tried, best, 1)[:, 0]
        # twice between the neighbours of the best place, sixteen times closer
        for step in (_STEP, _STEP / 16):
            tried = ahead[:, None] + step * np.arange(-16, 17) / 16
            found = level(x[:, None] + tried) - self._drop(tried)
            best = found.argmax(axis=1)[:, None]
            ahead = np.take_along_axis(tried, best, 1)[:, 0]
        return ahead, np.take_along_axis(found, best, 1)[:, 0]

    def _reach(self, level: Level, low: float, high: float) -> float:
        """No place further away than this [m] can be the highest: x^2/2R < max r - min r.

        Heights are looked for as far as the wheel reaches at all, where the profile is known.
        """
        first, last = getattr(level, "domain", (-np.inf, np.inf))
        first = max(low - self.radius, first)
        last = max(min(high + self.radius, last), first)
        drop = float(np.ptp(level(np.linspace(first, last, math.ceil((last - first) / _STEP) + 1))))
        return min(math.sqrt(2.0 * self.radius * drop) + 2.0 * _STEP, self.radius)

    def _drop(self, x: Array) -> Array:
        # R - sqrt(R^2 - x^2), without cancellation; beyond the wheel it is as high as its middle
        x = np.minimum(np.abs(x), self.radius)
        return x**2 / (self.radius + np.sqrt(self.radius**2 - x**2))


@dataclass(frozen=True, eq=False)
class PatchMean:
    """Mean of the profile under a patch, sum_j w_j r(X + x_j), with weights that add up to 1.

    To first order in r any frictionless contact feels r weighted with the increment of its
    pressure per approach, by reciprocity that under a flat punch on the patch: see
    `contactstudy.contact.press_table.load_weights`.

    Attributes
    ----------
    offsets, weights : ndarray (m,)
        Places along the rail relative to the wheel in m, and weights.
    """

    offsets: Array
    weights: Array

    @classmethod
    def uniform(cls, half_length: float) -> "PatchMean":
        """Plain mean over the length 2a of a patch [m], by Gauss's rule.

        On Hertz's ellipse the punch's pressure 1/sqrt(1 - x^2/a^2 - y^2/b^2) (K. L. Johnson,
        Contact Mechanics (1985), sec. 3.8) has the same integral across at every x: of a cosine
        of wavenumber k remains sin(ka)/(ka).
        """
        place, weight = np.polynomial.legendre.leggauss(_ORDER)
        return cls(half_length * place, 0.5 * weight)

    def __call__(self, level: Level, x: Array) -> Array:
        """See `ContactFilter`."""
        felt = np.zeros(len(x))
        for offset, weight in zip(self.offsets, self.weights, strict=True):
            felt += weight * level(x + offset)
        return felt

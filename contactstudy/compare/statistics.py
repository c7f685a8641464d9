"""Samples: mean with its confidence interval, and how both settle as a sample grows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Spread:
    """A sample of n independent values; what is not finite is left out.

    Attributes
    ----------
    mean, deviation : float
        Mean and standard deviation (with n - 1); nan without values, and without a second one.
    half_width : float
        Of the confidence interval of the mean: ``t s / sqrt(n)``, t Student's quantile of n - 1
        degrees of freedom (Student 1908, Biometrika 6:1); nan for fewer than two values.
    low, high : float
        Smallest and largest value.
    """

    n: int
    mean: float
    deviation: float
    half_width: float
    low: float
    high: float

    @property
    def constant(self) -> bool:
        """Whether all values are the same, but for rounding."""
        return self.high - self.low <= 1e-9 * abs(self.mean)


def spread(values: ArrayLike, confidence: float = CONFIDENCE) -> Spread:
    """`Spread` of values (n,)."""
    x = np.asarray(values, dtype=float).ravel()
    x = x[np.isfinite(x)]
    if len(x) == 0:
        return Spread(0, *[np.nan] * 5)
    deviation = float(x.std(ddof=1)) if len(x) > 1 else np.nan
    half = float(_student(len(x), confidence) * deviation / np.sqrt(len(x)))
    return Spread(len(x), float(x.mean()), deviation, half, float(x.min()), float(x.max()))


def running(values: ArrayLike, confidence: float = CONFIDENCE) -> tuple[Array, Array, Array]:
    """Numbers 2 ... n of values, their means, and half the confidence intervals of these."""
    x = np.asarray(values, dtype=float)
    x = x[np.isfinite(x)]
    found = [spread(x[:n], confidence) for n in range(2, len(x) + 1)]
    mean = np.array([one.mean for one in found])
    numbers: Array = np.arange(2.0, len(x) + 1)
    return numbers, mean, np.array([one.half_width for one in found])


def _student(n: int, confidence: float) -> float:
    """Two-sided quantile of Student's t with n - 1 degrees of freedom."""
    from scipy.special import stdtrit

    return float(stdtrit(n - 1, 0.5 * (1.0 + confidence))) if n > 1 else np.nan

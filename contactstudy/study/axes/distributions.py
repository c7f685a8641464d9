"""Distributions from which values of a key are drawn: "uniform 0.5 m to 0.7 m"."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.units import UnitError, to_si
from contactstudy.validation import Parameter

_RANGE = re.compile(r"(uniform|log-uniform)\s+(.+?)\s+to\s+(.+)")
_NORMAL = re.compile(r"normal\s+(.+?)\s*,\s*(.+)")
_FORM = 'must be like "uniform 0.5 m to 0.7 m", "log-uniform ..." or "normal 65 MN/m, 5 MN/m"'

Quantile = Callable[[Array], Array]
"""Values (n,) of a key in SI at probabilities (n,)."""


def distribution(given: Any, parameter: Parameter) -> Quantile | None:
    """Inverse of the distribution that a text names; None for values that are listed.

    Raises
    ------
    UnitError
        With what is allowed.
    """
    if not isinstance(given, str) or parameter.only_text:
        return None
    unit, text = parameter.unit, given.strip()
    if match := _NORMAL.fullmatch(text):
        mean, deviation = (to_si(part, unit) for part in match.groups())
        if deviation <= 0.0:
            raise UnitError(f"needs a standard deviation above 0 {unit}".rstrip())
        if parameter.limits.whole:
            return lambda p: np.rint(mean + deviation * _standard_normal(p))
        return lambda p: mean + deviation * _standard_normal(p)
    if match := _RANGE.fullmatch(text):
        low, high = (to_si(part, unit) for part in match.groups()[1:])
        logarithmic = match[1] == "log-uniform"
        if not low < high or (logarithmic and low <= 0.0):
            above = "above 0 and " if logarithmic else ""
            raise UnitError(f"must lead from a lower to a higher value, {above}lowest first")
        if parameter.limits.whole:  # each stands for the numbers about it, the ends as the others
            if low % 1.0 or high % 1.0:
                raise UnitError("must lead from one whole number to another")
            between = _between(low - 0.5, high + 0.5, logarithmic)
            return lambda p: np.clip(np.floor(between(p) + 0.5), low, high)
        return _between(low, high, logarithmic)
    if text.startswith(("uniform", "log-uniform", "normal")):
        raise UnitError(_FORM)
    return None


def _between(low: float, high: float, logarithmic: bool) -> Quantile:
    if not logarithmic:
        return lambda p: low + (high - low) * p
    a, b = math.log(low), math.log(high)
    return lambda p: np.exp(a + (b - a) * p)


def points(method: str, dimensions: int, number: int, seed: int) -> Array:
    """Points (number, dimensions) in the unit cube, of scipy.stats.qmc: Sobol or Latin hypercube.

    The Sobol points are scrambled; a power of two of them is balanced
    (A. B. Owen, "On dropping the first Sobol' point", 2020).
    """
    from scipy.stats import qmc

    engine = qmc.Sobol if method == "sobol" else qmc.LatinHypercube
    return np.asarray(engine(dimensions, rng=seed).random(number), dtype=float)


def _standard_normal(p: Array) -> Array:
    from scipy.special import ndtri

    # a point at 0 or 1 would be infinitely far out
    return np.asarray(ndtri(np.clip(p, 1e-12, 1.0 - 1e-12)))

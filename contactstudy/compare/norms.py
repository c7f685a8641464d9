"""Norms of the difference between two signals over the wheel's position.

A signal ``a`` is compared with a reference ``b`` at equal wheel positions X. All norms are
integrals over X by the trapezoidal rule, so that they do not depend on the sampling::

    <a, b> = int a b dX,      ||a|| = sqrt(<a, a>),      L = int dX

Signals have shape (..., n) over n positions; further axes (several wheels) are summed over.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError


@dataclass(frozen=True)
class SpragueGeers:
    """Magnitude, phase and combined error of Sprague and Geers (all 0 for equal signals).

    With <a, b> as above (Sprague & Geers 2004, Shock Vib. 11:3-4; Schwer 2007)::

        M = sqrt(<a, a> / <b, b>) - 1
        P = arccos(<a, b> / sqrt(<a, a> <b, b>)) / pi
        C = sqrt(M^2 + P^2)
    """

    magnitude: float
    phase: float
    combined: float


def inner(a: ArrayLike, b: ArrayLike, x: ArrayLike) -> float:
    """Integral of ``a b`` over the positions `x` (n,); further axes are summed over."""
    from scipy.integrate import trapezoid

    return float(np.sum(trapezoid(np.asarray(a) * np.asarray(b), np.asarray(x), axis=-1)))


def relative_l2(a: ArrayLike, b: ArrayLike, x: ArrayLike) -> float:
    """``||a - b|| / ||b||``; nan when the reference `b` is zero everywhere."""
    difference = np.asarray(a) - np.asarray(b)
    return _ratio(np.sqrt(inner(difference, difference, x)), np.sqrt(inner(b, b, x)))


def relative_l2_dynamic(
    a: ArrayLike, b: ArrayLike, x: ArrayLike, a_static: ArrayLike, b_static: ArrayLike
) -> float:
    """``||(a - a_s) - (b - b_s)|| / ||b - b_s||``: of the parts about the static values.

    Parameters
    ----------
    a, b : (..., n) array_like
        Signal and reference at the positions `x` (n,).
    a_static, b_static : (...,) array_like
        Each signal's own value in the static equilibrium, in the signal's unit.
    """
    a_dynamic, b_dynamic = dynamic_part(a, a_static), dynamic_part(b, b_static)
    return relative_l2(a_dynamic, b_dynamic, x)


def dynamic_part(a: ArrayLike, static: ArrayLike) -> Array:
    """``a - a_s``, with one static value a_s for each leading index of `a` (..., n)."""
    return np.asarray(a, dtype=float) - np.asarray(static, dtype=float)[..., np.newaxis]


def linf(a: ArrayLike, b: ArrayLike) -> float:
    """``max |a - b|`` in the signals' unit."""
    return float(np.max(np.abs(np.asarray(a) - np.asarray(b))))


def rms(a: ArrayLike, b: ArrayLike, x: ArrayLike) -> float:
    """``sqrt(||a - b||^2 / L)`` in the signals' unit, the mean taken over X (and wheels)."""
    difference = np.asarray(a) - np.asarray(b)
    one = np.ones_like(difference)
    return float(np.sqrt(inner(difference, difference, x) / inner(one, one, x)))


def correlation(a: ArrayLike, b: ArrayLike, x: ArrayLike) -> float:
    """Pearson's coefficient, means and products integrated over X; nan for a constant signal."""
    a_free, b_free = _without_mean(a, x), _without_mean(b, x)
    product = inner(a_free, a_free, x) * inner(b_free, b_free, x)
    return _ratio(inner(a_free, b_free, x), np.sqrt(product))


def sprague_geers(a: ArrayLike, b: ArrayLike, x: ArrayLike) -> SpragueGeers:
    """`SpragueGeers` of the signal `a` against the reference `b`; nan for zero signals."""
    aa, bb, ab = inner(a, a, x), inner(b, b, x), inner(a, b, x)
    magnitude = np.sqrt(_ratio(aa, bb)) - 1.0
    # The quotient of equal signals may exceed 1 in the last bit.
    phase = np.arccos(np.clip(_ratio(ab, np.sqrt(aa * bb)), -1.0, 1.0)) / np.pi
    return SpragueGeers(float(magnitude), float(phase), float(np.hypot(magnitude, phase)))


def common_positions(x_a: ArrayLike, x_b: ArrayLike, start: float) -> Array:
    """Positions at which two signals are compared: the finer of the two grids, both covering it.

    Parameters
    ----------
    x_a, x_b : (n,), (m,) array_like
        Wheel positions of the two runs in m, increasing.
    start : float
        First position to compare, m (behind the fade-in of the irregularity).

    Raises
    ------
    InputError
        When fewer than three positions are common.
    """
    x_a, x_b = np.asarray(x_a, dtype=float), np.asarray(x_b, dtype=float)
    low, high = max(start, x_a[0], x_b[0]), min(x_a[-1], x_b[-1])
    slack = 1e-9 * max(abs(low), abs(high), 1.0)  # positions are sums of steps
    inside = [x[(x >= low - slack) & (x <= high + slack)] for x in (x_a, x_b)]
    finer = max(inside, key=len)
    if len(finer) < 3:
        raise InputError(
            f"the signals have no positions in common behind the fade-in ({low:g} to {high:g} m)"
        )
    return finer


def at_positions(a: ArrayLike, x_a: ArrayLike, x: ArrayLike) -> Array:
    """Signal `a` (..., n) at the positions `x` (m,): its own samples, else a cubic spline.

    The spline's error falls with the fourth power of the step, two orders faster than that of
    the time stepper, so that interpolation does not show in a comparison of time steps.
    """
    from scipy.interpolate import make_interp_spline

    a, x_a, x = (np.asarray(v, dtype=float) for v in (a, x_a, x))
    nearest = np.clip(np.searchsorted(x_a, x - 1e-9 * np.abs(x)), 0, len(x_a) - 1)
    if np.allclose(x_a[nearest], x, rtol=1e-9, atol=0.0):
        return np.asarray(a[..., nearest])
    degree = min(3, len(x_a) - 1)
    spline = make_interp_spline(x_a, a, k=degree, axis=-1)
    return np.asarray(spline(np.clip(x, x_a[0], x_a[-1])), dtype=float)


def _without_mean(a: ArrayLike, x: ArrayLike) -> Array:
    from scipy.integrate import trapezoid

    a = np.asarray(a, dtype=float)
    length = inner(np.ones(a.shape[-1]), np.ones(a.shape[-1]), x)
    mean = trapezoid(a, np.asarray(x), axis=-1) / length
    free = dynamic_part(a, mean)
    constant = np.abs(free).max() <= 1e-12 * np.abs(a).max()  # but for what the mean rounds
    return np.zeros_like(free) if constant else free


def _ratio(numerator: float, denominator: float) -> float:
    return float(numerator / denominator) if denominator > 0.0 else float("nan")

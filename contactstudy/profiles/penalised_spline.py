"""Cubic least-squares spline with a penalty that bridges places without points, and its knots."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contactstudy.arrays import Array

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

_DEGREE = 3
_BIN = 1e-4  # length [m] over which points are taken together where knots are chosen


def penalised_spline(p: Array, s: Array, knots: Array, wavelength: float) -> BSpline:
    """Least-squares spline through points (n, 2) = (y, z) at given arc lengths (n,) [m].

    The knots (k,) include the ends; at `wavelength` the penalty on the third derivative halves a
    wave [m].
    """
    from scipy.interpolate import BSpline

    t = _padded(knots)
    B = BSpline.design_matrix(np.clip(s, knots[0], knots[-1]), t, _DEGREE)
    G = (B.T @ B).toarray() + _penalty(knots, len(p), wavelength)
    return BSpline(t, np.linalg.solve(G, B.T @ p), _DEGREE)


def _padded(knots: Array) -> Array:
    return np.concatenate([[knots[0]] * _DEGREE, knots, [knots[-1]] * _DEGREE])


def _penalty(knots: Array, n: int, wavelength: float) -> Array:
    """Matrix of lambda times the integral of the squared third derivative.

    A wave of length L over n/length points per metre is halved where
    ``lambda (2 pi/L)^6 = n/length``; lambda is so chosen for the wavelength given.
    """
    third = _third(knots)
    length = float(knots[-1] - knots[0])
    factor = n / length * (wavelength / (2.0 * np.pi)) ** 6
    return np.asarray(factor * (third.T * np.diff(knots)) @ third)


def _third(knots: Array) -> Array:
    """Third derivative within the intervals from the coefficients, (intervals, coefficients)."""
    from scipy.interpolate import BSpline

    t = _padded(knots)
    unit = BSpline(t, np.eye(len(t) - _DEGREE - 1), _DEGREE)
    return np.asarray(unit.derivative(3)(0.5 * (knots[:-1] + knots[1:])))


def needed_knots(p: Array, s: Array, knots: Array, scatter: float, shortest: float) -> Array:
    """Knots that the points ask for: others are taken out one after the other.

    A knot is a jump of the third derivative, ``j = J c`` with the coefficients c. Without it the
    sum of squares grows by ``|j|^2 / (J G^-1 J^T)``, G being the Gram matrix. By Schwarz's
    criterion a knot is worth its freedom if that exceeds ``sigma^2 log n``, sigma the points'
    standard deviation `scatter`; `shortest` is the wavelength of the penalty [m].
    """
    from scipy.interpolate import BSpline

    # means over short stretches stand for the points
    bins = np.floor(s / _BIN).astype(np.int64)
    _, group, count = np.unique(bins, return_inverse=True, return_counts=True)
    s = np.bincount(group, s) / count
    means = np.stack([np.bincount(group, p[:, k]) / count for k in range(2)], axis=-1)
    limit = scatter**2 * np.log(len(p))
    while len(knots) > 2:
        inside = np.clip(s, knots[0], knots[-1])
        B = BSpline.design_matrix(inside, _padded(knots), _DEGREE).toarray()
        G = B.T @ (count[:, None] * B) + _penalty(knots, len(p), shortest)
        c = np.linalg.solve(G, B.T @ (count[:, None] * means))
        J = np.diff(_third(knots), axis=0)
        growth = ((J @ c) ** 2).sum(axis=1) / np.einsum("ij,ji->i", J, np.linalg.solve(G, J.T))
        out = _apart(growth, limit)
        if not len(out):
            break
        knots = np.delete(knots, out + 1)
    return knots


def _apart(growth: Array, limit: float) -> NDArray[np.intp]:
    """Knots below the limit, the least first, none within three of another."""
    free = np.ones(len(growth), dtype=bool)
    out = []
    for k in np.argsort(growth):
        if growth[k] >= limit:
            break
        if free[k]:
            out.append(k)
            free[max(k - 3, 0) : k + 4] = False
    return np.array(out, dtype=np.intp)

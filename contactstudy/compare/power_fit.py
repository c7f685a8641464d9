"""Least-squares fit of ``f(h) = f0 + C h^p`` to values on grids of several sizes.

Source: Eca & Hoekstra (2014), J. Comput. Phys. 262:104, section 3.2 and appendix A.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array

ORDERS = (0.05, 12.0)
"""Orders that are looked for."""


@dataclass(frozen=True)
class PowerFit:
    """A fit, its sizes from the finest on.

    Attributes
    ----------
    order : float
        p.
    order_error : float
        Its standard error; nan where p was given, or as many values as parameters.
    limit : float
        f0.
    gain : float
        ``C h1^p`` at the finest size.
    deviation : float
        Standard deviation of the values about the fit; 0 for as many values as parameters.
    miss : float
        Finest value less the fit there.
    """

    order: float
    order_error: float
    limit: float
    gain: float
    deviation: float
    miss: float


def fit_power(h: Array, f: Array) -> PowerFit | None:
    """Fit of f0, C and p; none where the values show no order.

    With equal weights and with weights 1/h, of which that with the smaller deviation is taken.
    Values show an order where one within `ORDERS` is the best and the deviation from it is smaller
    than their mean step (Eca & Hoekstra 2014, eq. 16).

    Parameters
    ----------
    h, f : (n,) arrays
        Sizes, the finest first, and values; at least three.
    """
    fits = [_weighted(h, f, weights) for weights in (np.ones_like(h), 1.0 / h)]
    step = np.ptp(f) / (len(f) - 1)
    found = [fit for fit in fits if fit is not None and fit.deviation < step]
    return min(found, key=lambda fit: fit.deviation) if found else None


def fit_of_order(h: Array, f: Array, p: float) -> PowerFit:
    """Fit of f0 and C with the order p; arguments as in `fit_power`, at least two."""
    return _fit(h, f, np.ones_like(h), p, parameters=2)


def _weighted(h: Array, f: Array, weights: Array) -> PowerFit | None:
    from scipy.optimize import least_squares

    spread = np.ptp(f)
    if spread == 0.0:
        return None

    # for a given p the best f0 and C follow from a linear problem: only p is looked for
    def residual(p: Array) -> Array:
        return _linear(h, f, weights, float(p[0]))[2] / spread

    tried = np.geomspace(*ORDERS, 60)
    k = int(np.argmin([np.sum(residual(np.array([p])) ** 2) for p in tried]))
    if k in (0, len(tried) - 1):
        return None
    tight = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15}
    found = least_squares(residual, [tried[k]], jac="3-point", bounds=ORDERS, **tight)
    return _fit(h, f, weights, float(found.x[0]), parameters=3)


def _fit(h: Array, f: Array, weights: Array, p: float, parameters: int) -> PowerFit:
    limit, gain, residual = _linear(h, f, weights, p)
    free = len(f) - parameters
    deviation = float(np.sqrt(np.sum(residual**2) / free)) if free > 0 else 0.0
    order_error = np.nan
    if free > 0 and parameters == 3:
        # d fit / d(f0, C h1^p, p)
        x = h / h[0]
        jacobian = np.column_stack([np.ones_like(x), x**p, gain * x**p * np.log(x)])
        jacobian *= np.sqrt(weights / weights.mean())[:, None]
        # the columns are of very different size: scaled, so that none counts as rounding
        size = np.linalg.norm(jacobian, axis=0)
        order_error = (
            deviation * float(np.linalg.norm(np.linalg.pinv(jacobian / size)[2])) / float(size[2])
        )
    return PowerFit(p, order_error, limit, gain, deviation, float(f[0]) - limit - gain)


def _linear(h: Array, f: Array, weights: Array, p: float) -> tuple[float, float, Array]:
    """f0, C h1^p of the best fit with the order p, and its weighted residuals (n,)."""
    w = weights / weights.sum()
    # regression over x = (h/hn)^p about the means; the finest value is taken off first, so that
    # digits of small differences are kept
    x, y = (h / h[-1]) ** p, f - f[0]
    x_mean, y_mean = w @ x, w @ y
    slope = (w * (x - x_mean)) @ (y - y_mean) / ((w * (x - x_mean)) @ (x - x_mean))
    residual = (y - y_mean - slope * (x - x_mean)) * np.sqrt(w * len(h))
    return float(f[0] + y_mean - slope * x_mean), float(slope * x[0]), residual

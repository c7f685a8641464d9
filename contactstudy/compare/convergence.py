"""Observed order of accuracy, with the limit known or not, and the grid convergence index.

Three values ``f1, f2, f3`` of the same quantity on grids (or time steps) of size
``h1 < h2 < h3`` with ratios ``r21 = h2/h1`` and ``r32 = h3/h2`` give the observed order p from
``f(h) = f_0 + C h^p``.

Sources: Roache (1994), J. Fluids Eng. 116:405; Celik et al. (2008), J. Fluids Eng. 130:078001.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from contactstudy.exceptions import InputError, NumericalError


@dataclass(frozen=True)
class GridConvergence:
    """Outcome of three refinements.

    Attributes
    ----------
    order : float
        Observed order p.
    extrapolated : float
        Value for h -> 0 from the two finest grids (Richardson), in the values' unit.
    index : float
        Grid convergence index of the finest grid, relative to its value: a band of about
        95 % for the discretisation error.
    """

    order: float
    extrapolated: float
    index: float


def observed_order(values: Sequence[float], sizes: Sequence[float]) -> float:
    """Observed order p of three values, finest first.

    Parameters
    ----------
    values, sizes : 3 floats each
        The quantity and the mesh size or time step; sizes increase.

    Raises
    ------
    InputError
        For other than three values or sizes that do not increase.
    NumericalError
        When the values do not converge monotonically, so that no order can be observed.
    """
    from scipy.optimize import brentq

    if len(values) != 3 or len(sizes) != 3:
        raise InputError("an observed order needs three values and three sizes, finest first")
    r21, r32 = sizes[1] / sizes[0], sizes[2] / sizes[1]
    if sizes[0] <= 0.0 or r21 <= 1.0 or r32 <= 1.0:
        raise InputError(f"sizes must be positive and increase, finest first: {tuple(sizes)}")
    e21, e32 = values[1] - values[0], values[2] - values[1]
    if e21 == 0.0 or e32 / e21 <= 0.0:
        raise NumericalError(f"no observed order: {tuple(values)} do not converge monotonically")

    # e32 / e21 = (r21 r32)^p - r21^p over r21^p - 1 = r21^p (r32^p - 1) / (r21^p - 1),
    # which increases with p and tends to ln r32 / ln r21 for p -> 0.
    def residual(p: float) -> float:
        growth = r21**p * np.expm1(p * np.log(r32)) / np.expm1(p * np.log(r21))
        return float(np.log(growth) - np.log(e32 / e21))

    low, high = 1e-6, 50.0
    if residual(low) > 0.0 or residual(high) < 0.0:
        raise NumericalError(f"no observed order between 0 and {high:g}: {tuple(values)}")
    return float(brentq(residual, low, high, xtol=1e-12))


def fitted_order(sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Least-squares slope of log error over log size.

    Contact points enter and leave a patch one by one: the error changes its sign with the load
    and the mesh, and three meshes alone show any order. A fit over many averages that out.

    Parameters
    ----------
    sizes, errors : sequences (n,)
        Mesh size (any unit) and size of the error, positive; errors of exactly zero are left out.
    """
    kept = [(h, e) for h, e in zip(sizes, errors, strict=True) if e > 0.0]
    h, e = np.log(np.array(kept)).T
    return float(np.polyfit(h, e, 1)[0])


def grid_convergence(
    values: Sequence[float], sizes: Sequence[float], safety: float = 1.25
) -> GridConvergence:
    """Order, extrapolated value and grid convergence index of three values, finest first.

    With ``r = h2/h1``::

        f_0 = (r^p f1 - f2) / (r^p - 1)
        GCI = safety * |(f1 - f2) / f1| / (r^p - 1)

    Parameters
    ----------
    values, sizes : 3 floats each
        As in `observed_order`.
    safety : float
        1.25 for three grids (Roache), 3 for two.
    """
    p = observed_order(values, sizes)
    gain = (sizes[1] / sizes[0]) ** p
    extrapolated = (gain * values[0] - values[1]) / (gain - 1.0)
    index = safety * abs((values[0] - values[1]) / values[0]) / (gain - 1.0)
    return GridConvergence(p, extrapolated, index)

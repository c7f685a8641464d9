"""What a refinement says: observed order, Richardson's limit, grid convergence index, verdict.

Values of one quantity on grids (or time steps) of size h are taken as ``f(h) = f0 + C h^p``. All
three are fitted by least squares over all sizes (`power_fit`); with three sizes the fit is exact
and gives Roache's order and index.

A value is a scalar, or the norm of a signal's difference from the finest one, which is 0 there:
where the error has a fixed shape, ``|f_i - f_n| = |C| (h_i^p - h_n^p)``, so that ``-f0`` is what
the finest has itself.

Sources: Roache (1994), J. Fluids Eng. 116:405; ASME V&V 20-2009, section 2; Celik et al. (2008),
J. Fluids Eng. 130:078001; Eca & Hoekstra (2014), J. Comput. Phys. 262:104, the band; the same
(2006), 26th Symp. Naval Hydrodynamics, the band where there is no order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.power_fit import fit_of_order, fit_power
from contactstudy.exceptions import InputError

Verdict = Literal["asymptotic", "not yet", "round-off"]

LEAST_ORDER = 0.5
"""A smaller observed order is not believed (Eca & Hoekstra 2014)."""
AGREEMENT = 0.2
"""How far the order of the three finest may be from that of all, and from the expected one."""


@dataclass(frozen=True)
class Convergence:
    """Outcome of a refinement.

    Attributes
    ----------
    order : float
        Observed order p; nan where the values show none.
    order_error : float
        Its standard error from the scatter about the fit; nan for fewer than four values.
    limit : float
        f0, Richardson's value for h -> 0; nan without an order of 0.5 or more.
    uncertainty : float
        Band of about 95 % about the finest value, in the values' unit.
    index : float
        The same relative to the finest value (or the scale that was given): the grid convergence
        index of the finest grid. nan where that is 0.
    verdict : str
        "asymptotic": the sizes are fine enough for order, limit and index to be believed. "not
        yet": they are not, or too few to tell. "round-off": refining changes nothing any more.
    """

    order: float
    order_error: float
    limit: float
    uncertainty: float
    index: float
    verdict: Verdict


def convergence(
    sizes: Sequence[float],
    values: Sequence[float],
    expected: float | None = None,
    scale: float | None = None,
    floor: float = 1e-10,
) -> Convergence:
    """Order, limit, index and verdict of a refinement.

    With the deviation ``s`` of the values from the fit and their mean step ``D``, the band is
    (Eca & Hoekstra 2014, eqs 16 to 18)::

        U = F |C| h1^p + s + |f1 - fit(h1)|,    F = 1.25,    s < D and 0.5 <= p

    With two values the order is the expected one and F = 3 (ASME V&V 20), and so where the
    observed order is above the expected one by more than a fifth. Without an order the band is
    three times the range of the values (Eca & Hoekstra 2006), of the three finest at round-off.

    The verdict is "round-off" when the last step is below `floor` times the scale, or when the
    steps had fallen by 1000 and then no longer fell; "asymptotic" when all values converge from one
    side in steps that fall, s < D, 0.5 <= p, and the order of the three finest is within a fifth of
    that of all and of the expected one; three values need an expected order for that.

    Parameters
    ----------
    sizes : (n,)
        Mesh size, time step or the like, in any unit and sequence; all different.
    values : (n,)
        The quantity, or the norms of the differences from the finest signal; what is not finite
        is left out.
    expected : float, optional
        Order of the scheme.
    scale : float, optional
        What the index and the floor are relative to: the finest value by default; 1 for relative
        norms.
    floor : float
        Rounding, or tolerance of a solver, relative to the scale.
    """
    h, f = _finest_first(sizes, values)
    if len(f) == 0:
        return Convergence(np.nan, np.nan, np.nan, np.nan, np.nan, "not yet")
    own = abs(float(f[0])) if scale is None else scale
    steps = np.diff(f)  # from the finest on
    rounded = _at_rounding(steps, floor * max(own, np.abs(f).max() if scale is None else 0.0))
    observed = fit_power(h, f) if len(f) > 2 else None
    fit, safety = observed, 1.25
    if fit is not None and fit.order < LEAST_ORDER:
        fit = None
    elif expected is not None and (
        len(f) == 2 or (fit is not None and fit.order > (1 + AGREEMENT) * expected)
    ):
        fit, safety = fit_of_order(h, f, expected), 3.0
    if fit is not None:
        band = safety * abs(fit.gain) + fit.deviation + abs(fit.miss)
    else:
        band = 3.0 * np.ptp(f[:3] if rounded else f) if rounded or len(f) > 2 else np.nan
    verdict: Verdict = "not yet"
    if rounded:
        verdict = "round-off"
    elif fit is not None and _settled(h, f, fit.order, expected):
        verdict = "asymptotic"
    return Convergence(
        observed.order if observed else np.nan,
        observed.order_error if observed else np.nan,
        fit.limit if fit else np.nan,
        float(band),
        0.0 if band == 0.0 else float(band / own) if own > 0.0 else np.nan,
        verdict,
    )


def fitted_order(sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Least-squares slope of log error over log size, where the limit is known.

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


def _finest_first(sizes: Sequence[float], values: Sequence[float]) -> tuple[Array, Array]:
    h, f = np.asarray(sizes, dtype=float), np.asarray(values, dtype=float)
    if h.ndim != 1 or h.shape != f.shape:
        raise InputError(f"a refinement needs one value a size; got {h.shape} and {f.shape}")
    if not np.all(np.isfinite(h) & (h > 0.0)) or len(np.unique(h)) < len(h):
        raise InputError(f"sizes must be positive and different: {h.tolist()}")
    kept = np.argsort(h)
    kept = kept[np.isfinite(f[kept])]
    return h[kept], f[kept]


def _at_rounding(steps: Array, floor: float) -> bool:
    """Whether refining changes nothing any more; steps from the finest on."""
    size = np.abs(steps)
    if len(size) and size[0] <= floor:
        return True
    return bool(len(size) > 2 and max(size[:2]) <= 1e-3 * size.max() and size[0] >= size[1])


def _settled(h: Array, f: Array, order: float, expected: float | None) -> bool:
    """Whether the values converge from one side with one order, the expected one if stated."""
    steps = np.diff(f)
    finest = fit_power(h[:3], f[:3]) if len(f) > 2 else None
    if finest is None or np.any(steps * steps[0] <= 0.0) or np.any(np.diff(np.abs(steps)) <= 0.0):
        return False
    against = [order] if len(f) > 3 else []
    against += [expected] if expected is not None else []
    return bool(against) and all(abs(finest.order - p) <= AGREEMENT * p for p in against)

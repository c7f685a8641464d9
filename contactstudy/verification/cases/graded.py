"""Mesh lines that are equal first and then grow."""

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError


def graded_lines(fine_length: float, size: float, total: float, growth: float = 1.35) -> Array:
    """Lines from 0: equal steps up to `fine_length`, then growing geometrically to `total`.

    Parameters
    ----------
    fine_length, size, total : float
        Lengths in m; the fine part is rounded up to whole steps.
    growth : float
        Ratio of neighbouring steps in the graded part (adjusted so that it ends at `total`).

    Returns
    -------
    ndarray (n,)
        Increasing coordinates in m.
    """
    if not (0 < size <= fine_length < total) or growth < 1:
        raise InputError(
            f"graded mesh: needs 0 < size ({size} m) <= fine length ({fine_length} m) < total "
            f"({total} m) and growth >= 1 ({growth})"
        )
    n = int(np.ceil(fine_length / size - 1e-9))
    fine = size * np.arange(n + 1)
    rest = total - fine[-1]
    # size * (q + q^2 + ... + q^m) = rest: m from the wanted growth, then q by bisection
    m = max(int(np.ceil(np.log1p(rest / size * (growth - 1) / growth) / np.log(growth))), 1)
    low, high = 1e-3, growth
    for _ in range(200):
        q = 0.5 * (low + high)
        if size * np.sum(q ** np.arange(1, m + 1)) < rest:
            low = q
        else:
            high = q
    steps = size * q ** np.arange(1, m + 1)
    return np.concatenate([fine, fine[-1] + rest * np.cumsum(steps) / steps.sum()])

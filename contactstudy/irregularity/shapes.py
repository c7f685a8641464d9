"""Shapes of which profiles are made."""

import numpy as np

from contactstudy.arrays import Array


def smoothstep(t: Array) -> Array:
    """``10 t^3 - 15 t^4 + 6 t^5`` from 0 at t = 0 to 1 at 1 (...); first two derivatives vanish."""
    t = np.clip(t, 0.0, 1.0)
    return np.asarray(t**3 * (10.0 - 15.0 * t + 6.0 * t * t))


def haversine(x: Array, length: float) -> Array:
    """``(1 + cos(2 pi x/l))/2`` within half a length of x = 0 (...), 0 beyond; both in m."""
    t = np.minimum(np.abs(x) / length, 0.5)
    return np.asarray(0.5 * (1.0 + np.cos(2.0 * np.pi * t)))

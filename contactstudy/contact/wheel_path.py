"""The way of a wheel along the rail, and the irregularity that its contact points meet there."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array


@dataclass(frozen=True, eq=False)
class WheelPath:
    """Where a wheel goes, and what its points meet there.

    Attributes
    ----------
    positions : ndarray (n_times,)
        X of the wheel in m.
    irregularity : ndarray (n_times, npx)
        r at X + x of the lines of points in m, the same on all points across.
    shape : callable or None
        From X in m to what the wheel's own shape adds to r (npx, npy) there in m.
    """

    positions: Array
    irregularity: Array
    shape: Callable[[float], Array] | None = None

    def level(self, step: int, npy: int) -> Array:
        """r (npx*npy,) at all points in a step in m."""
        level = np.repeat(self.irregularity[step], npy)
        if self.shape is not None:
            level += self.shape(float(self.positions[step])).ravel()
        return level

"""Gaps of contacts at points.

The paper's eqs (4)-(6) put k_r between the wheel and the interpolated rail, with shape
functions N at the wheel: the gap row is B = (+1 on the wheel, -N on the rail), and

    g = B u + c lambda - r(X),

c being the compliance of the loaded element itself, which N leaves out (0 in the paper). A
positive r raises the running surface. Literal eq. (6), f_r = (N, -1) k_r r, pushes the rail up
and the wheel down for positive r, so its positive r is a dip: r here is minus the paper's.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contactstudy.arrays import Array, IntArray


@dataclass(frozen=True)
class PointGaps:
    """Gap of every contact at every state, g = B u + c lambda - r, r (n_times, nc) in m.

    Parameters
    ----------
    wheels : tuple of ndarray
        Dofs and weights (nc, j) of the wheels at the contact: +1 for a displacement, then those
        of elastic modes.
    rail : callable
        From the step to dofs and weights (nc, k) of the rail's row N.
    compliance : ndarray (n_times, nc)
        c [m/N]. Two wheels within one element do not share it: each feels its own.
    deflection : ndarray (n_times, nc)
        What the dofs leave out of the deflection of the rail's centre line [m/N], for the record.
        On a beam it is c.
    shape : ndarray (n_times, nc, m)
        Of the profile under each wheel, for the laws of `contact.patch_laws` [m]; else m = 0.
    """

    wheels: tuple[IntArray, Array]
    rail: Callable[[int], tuple[IntArray, Array]]
    compliance: Array
    deflection: Array
    irregularity: Array
    shape: Array

    def rows(self, step: int) -> tuple[IntArray, Array]:
        """Dofs and weights (nc, j + k) of B at a step."""
        return self.joined(*self.rail(step))

    def joined(self, rail_dofs: IntArray, rail: Array) -> tuple[IntArray, Array]:
        """Those of B from the rail's (..., nc, k): the wheels' less the rail's."""
        # B = (1, -N)
        wheel_dofs, wheel = self.wheels
        if rail.ndim > wheel.ndim:  # of several steps
            shape = *rail.shape[:-1], wheel.shape[-1]
            wheel_dofs, wheel = np.broadcast_to(wheel_dofs, shape), np.broadcast_to(wheel, shape)
        dofs = np.concatenate((wheel_dofs, rail_dofs), axis=-1)
        return dofs, np.concatenate((wheel, -rail), axis=-1)


class PointContacts(Protocol):
    """Gaps of contacts at points, and the law that closes them."""

    @property
    def gaps(self) -> PointGaps:
        """At every step."""

    def forces(self, step: int, compliance: Array, free_gap: Array) -> Array:
        """Forces (nc,) at the end of a step, for W and g*."""

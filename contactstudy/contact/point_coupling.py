"""Point contact: a law between the wheel and the rail at the wheel's position."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.contact.few_contacts import AttachedFew
from contactstudy.contact.laws import LATERAL_STIFFNESS, Law, point_forces
from contactstudy.contact.many_contacts import FEWEST, AttachedMany
from contactstudy.contact.point_gaps import PointGaps
from contactstudy.dynamics.banded import Factor


@dataclass(frozen=True)
class PointCoupling:
    """One point under every wheel, with all positions known in advance; it has no memory.

    Parameters
    ----------
    static_loads : ndarray
        (nc,) [N].
    bilateral : bool
        The contacts hold in tension (a lateral analysis).
    lateral : ndarray of bool, optional
        (nc,) contacts beside the rail, by the linear spring `lateral_stiffness` [N/m].
    """

    law: Law
    gaps: PointGaps
    static_loads: Array
    bilateral: bool = False
    lateral: BoolArray | None = None
    lateral_stiffness: float = LATERAL_STIFFNESS

    @property
    def accuracy(self) -> float:
        """Relative accuracy of the forces: rounding."""
        return 1e-11

    def start(self) -> None:
        """No state."""

    def attached(self, factor: Factor, scale: float) -> AttachedFew | AttachedMany:
        """Join to a system."""
        few = len(self.static_loads) < FEWEST and factor.spread is None
        return AttachedFew(self, factor, scale) if few else AttachedMany(self, factor, scale)

    def forces(self, step: int, compliance: Array, free_gap: Array) -> Array:
        """Forces (nc,) at the end of a step, for W and g*."""
        shape = self.gaps.shape[step]
        return point_forces(
            self.law, compliance, free_gap, self.static_loads, self.bilateral, shape, self._beside
        )

    @cached_property
    def _beside(self) -> Array | None:
        if self.lateral is None:
            return None
        return np.where(self.lateral, self.lateral_stiffness, 0.0)

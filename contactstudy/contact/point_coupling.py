"""Point contact: a law between the wheel and the rail at the wheel's position."""

import math
from dataclasses import dataclass

from contactstudy.arrays import Array, BoolArray
from contactstudy.contact.few_contacts import AttachedFew
from contactstudy.contact.laws import Law, MovingForce, point_forces
from contactstudy.contact.many_contacts import FEWEST, AttachedMany
from contactstudy.contact.point_gaps import PointGaps
from contactstudy.contact.two_directions import forces_in_two_directions
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
    lateral_stiffness: float = math.inf

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
        law, shape, loads = self.law, self.gaps.shape[step], self.static_loads
        if self.lateral is None:
            return point_forces(law, compliance, free_gap, loads, self.bilateral, shape)
        if isinstance(law, MovingForce):
            return loads
        top = ~self.lateral
        return forces_in_two_directions(
            self.lateral,
            self.lateral_stiffness,
            compliance,
            free_gap,
            lambda W, g: point_forces(law, W, g, loads[top], False, shape[top]),
        )

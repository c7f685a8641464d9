"""How the condition of no penetration is enforced: by penalty alone, or augmented Lagrangian.

With the penalty eps a point of the area A gives way by ``c = 1/(eps A)`` a newton, so under the
force lam the bodies overlap by ``c lam``. The augmented Lagrangian takes that overlap away
(Alart & Curnier 1991, Comput. Methods Appl. Mech. Eng. 92:353; Simo & Laursen 1992, Comput.
Struct. 42:97): multipliers lam_k are carried along,

    lam_(k+1) = max(0, lam_k - g/c),   g = g_free + W lam_(k+1)

which is the penalty problem again with shifted gaps, ``M lam + (g_free - c lam_k)``,
``M = W + diag(c)``. The overlap left is ``-g = c (lam_(k+1) - lam_k)``. The penalty now sets the
pace only, no longer the result; where the overlap does not come down to a quarter in an update
it is made ten times as large (Bertsekas 1982, Constrained Optimization, sec. 2.2.5).

Four Gauss points a facet are more conditions than there are nodes to fulfil them: W is singular
on them, and without the penalty's compliance only about as many of them as nodes carry a force,
the others just not touching. The nodes have no such surplus, and suit the augmented Lagrangian.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.contact.complementarity import PatchForces, PressedForces, contact_forces, press
from contactstudy.exceptions import InputError, NumericalError

Mask = BoolArray
Solution = TypeVar("Solution", bound=PatchForces)


class Enforcement(Protocol):
    """A way to solve the contact problem of n points.

    Both methods take ``M = W + diag(compliance)`` (n, n) in m/N, the free gaps (n,) in m, the
    compliance of the penalty (n,) in m/N, forces (n,) in N from which to start, and the points
    expected in contact (n,); `press` as `contact.surface.press` also the normal's components
    along the approach, the resultant in N and a first approach in m. They return the solution
    and how far the bodies overlap at each point, (n,) in m, never negative.
    """

    def forces(
        self, M: Array, gap: Array, compliance: Array, start: Array, guess: Mask | None
    ) -> tuple[PatchForces, Array]:
        """Forces for given free gaps."""

    def press(
        self,
        M: Array,
        gap: Array,
        compliance: Array,
        start: Array,
        guess: Mask | None,
        normal: Array,
        resultant: float,
        approach: float | None,
    ) -> tuple[PressedForces, Array]:
        """Forces and approach for a given resultant."""


@dataclass(frozen=True)
class Penalty:
    """Pressure = penalty x overlap; needs no start."""

    def forces(
        self, M: Array, gap: Array, compliance: Array, start: Array, guess: Mask | None
    ) -> tuple[PatchForces, Array]:
        """See `Enforcement`."""
        solution = contact_forces(M, gap, guess)
        return solution, compliance * solution.forces

    def press(
        self,
        M: Array,
        gap: Array,
        compliance: Array,
        start: Array,
        guess: Mask | None,
        normal: Array,
        resultant: float,
        approach: float | None,
    ) -> tuple[PressedForces, Array]:
        """See `Enforcement`."""
        solution = press(M, gap, normal, resultant, guess, approach)
        return solution, compliance * solution.forces


@dataclass(frozen=True)
class AugmentedLagrangian:
    """No overlap beyond a tolerance.

    Parameters
    ----------
    tolerance : float
        In m. No point in contact is further than this from touching, whether by overlap or, as
        a multiplier may be too large as well, by a gap.
    max_updates : int
        Bound on the number of updates of the multipliers.

    Raises
    ------
    InputError
        If the tolerance is not positive.
    """

    tolerance: float = 1e-9
    max_updates: int = 50

    def __post_init__(self) -> None:
        if not self.tolerance > 0:
            raise InputError(f"penetration tolerance = {self.tolerance} m: must be positive")

    def forces(
        self, M: Array, gap: Array, compliance: Array, start: Array, guess: Mask | None
    ) -> tuple[PatchForces, Array]:
        """See `Enforcement`; NumericalError when the tolerance is not reached."""

        def solve(M: Array, shift: Array, last: PatchForces | None) -> PatchForces:
            return contact_forces(M, gap - shift, guess if last is None else last.active)

        return self._update(solve, M, compliance, start)

    def press(
        self,
        M: Array,
        gap: Array,
        compliance: Array,
        start: Array,
        guess: Mask | None,
        normal: Array,
        resultant: float,
        approach: float | None,
    ) -> tuple[PressedForces, Array]:
        """See `Enforcement`; the stiffness is that with the multipliers held."""

        def solve(M: Array, shift: Array, last: PressedForces | None) -> PressedForces:
            return press(
                M,
                gap - shift,
                normal,
                resultant,
                guess if last is None else last.active,
                approach if last is None else last.approach,
            )

        return self._update(solve, M, compliance, start)

    def _update(
        self,
        solve: Callable[[Array, Array, Solution | None], Solution],
        M: Array,
        compliance: Array,
        start: Array,
    ) -> tuple[Solution, Array]:
        multipliers, last, before = start, None, np.inf
        for _ in range(self.max_updates):
            last = solve(M, compliance * multipliers, last)
            # -g where in contact; where a force has gone to zero the bodies are apart
            overlap = np.where(last.active, compliance * (last.forces - multipliers), 0.0)
            left = float(np.abs(overlap).max(initial=0.0))
            if left <= self.tolerance:
                return last, np.maximum(overlap, 0.0)
            if left > 0.25 * before:
                M = M - np.diag(0.9 * compliance)
                compliance = 0.1 * compliance
            multipliers, before = last.forces, left
        raise NumericalError(
            f"contact: after {self.max_updates} updates of the multipliers a point in contact is "
            f"still {left:.3e} m from touching (tolerance {self.tolerance:g} m): a higher penalty "
            "takes fewer updates, and pressure at the nodes fewer than at Gauss points"
        )


def enforcement(tolerance: float | None) -> Enforcement:
    """Penalty alone for None, else the augmented Lagrangian with a tolerance in m."""
    return Penalty() if tolerance is None else AugmentedLagrangian(tolerance)

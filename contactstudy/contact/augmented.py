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
from dataclasses import dataclass, replace
from typing import Annotated, Protocol, TypeVar

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.contact.complementarity import PatchForces, PressedForces, contact_forces, press
from contactstudy.exceptions import NumericalError
from contactstudy.validation import Above, AtMost, Parameters, Same, Unit

Solution = TypeVar("Solution", bound=PatchForces)


@dataclass(frozen=True, eq=False)
class PointProblem:
    """Contact problem of n points.

    Attributes
    ----------
    M : ndarray (n, n)
        Flexibility with the compliance of the penalty, ``W + diag(compliance)``, in m/N.
    gap : ndarray (n,)
        Free gaps in m.
    compliance : ndarray (n,)
        Of the penalty in m/N.
    start : ndarray (n,)
        Forces in N from which to start.
    guess : ndarray of bool (n,) or None
        Points expected in contact.
    """

    M: Array
    gap: Array
    compliance: Array
    start: Array
    guess: BoolArray | None = None


class Enforcement(Protocol):
    """A way to solve the contact problem of n points.

    Both methods return the solution and how far the bodies overlap at each point, (n,) in m,
    never negative.
    """

    @property
    def accuracy(self) -> float:
        """Relative accuracy of the forces."""

    def compliance(self, area: Array) -> Array:
        """Compliance 1/(eps A) of the penalty at points of these areas, (n,) in m/N."""

    def forces(self, problem: PointProblem) -> tuple[PatchForces, Array]:
        """Forces for given free gaps."""

    def press(
        self, problem: PointProblem, normal: Array, resultant: float, approach: float | None
    ) -> tuple[PressedForces, Array]:
        """Forces and approach for a given resultant, see `contact.complementarity.press`."""


@dataclass(frozen=True)
class Penalty(Parameters):
    """Pressure = penalty x overlap; needs no start."""

    penalty: Annotated[float, Unit("Pa/m"), Above(0), "pressure per penetration"] = 1e16

    @property
    def accuracy(self) -> float:
        """Rounding."""
        return 1e-11

    def compliance(self, area: Array) -> Array:
        """See `Enforcement`."""
        return 1.0 / (self.penalty * area)

    def forces(self, problem: PointProblem) -> tuple[PatchForces, Array]:
        """See `Enforcement`."""
        solution = contact_forces(problem.M, problem.gap, problem.guess)
        return solution, problem.compliance * solution.forces

    def press(
        self, problem: PointProblem, normal: Array, resultant: float, approach: float | None
    ) -> tuple[PressedForces, Array]:
        """See `Enforcement`."""
        solution = press(problem.M, problem.gap, normal, resultant, problem.guess, approach)
        return solution, problem.compliance * solution.forces


@dataclass(frozen=True)
class AugmentedLagrangian(Parameters):
    """No overlap beyond a tolerance.

    Parameters
    ----------
    tolerance : float
        In m. No point in contact is further than this from touching, whether by overlap or, as
        a multiplier may be too large as well, by a gap.
    """

    tolerance: Annotated[
        float, Unit("m"), Above(0), AtMost(1e-5), "penetration that the augmented Lagrangian leaves"
    ] = 1e-9
    penalty: Annotated[float, Same(Penalty, "penalty")] = Penalty.penalty
    max_updates: int = 50

    @property
    def accuracy(self) -> float:
        """Forces that meet a tolerance of the penetration are known no better than so."""
        return 1e-8

    def compliance(self, area: Array) -> Array:
        """See `Enforcement`."""
        return 1.0 / (self.penalty * area)

    def forces(self, problem: PointProblem) -> tuple[PatchForces, Array]:
        """See `Enforcement`; NumericalError when the tolerance is not reached."""

        def solve(shifted: PointProblem, last: PatchForces | None) -> PatchForces:
            guess = problem.guess if last is None else last.active
            return contact_forces(shifted.M, shifted.gap, guess)

        return self._update(solve, problem)

    def press(
        self, problem: PointProblem, normal: Array, resultant: float, approach: float | None
    ) -> tuple[PressedForces, Array]:
        """See `Enforcement`; the stiffness is that with the multipliers held."""

        def solve(shifted: PointProblem, last: PressedForces | None) -> PressedForces:
            guess, first = (
                (problem.guess, approach) if last is None else (last.active, last.approach)
            )
            return press(shifted.M, shifted.gap, normal, resultant, guess, first)

        return self._update(solve, problem)

    def _update(
        self, solve: Callable[[PointProblem, Solution | None], Solution], problem: PointProblem
    ) -> tuple[Solution, Array]:
        M, compliance, multipliers = problem.M, problem.compliance, problem.start
        last, before = None, np.inf
        for _ in range(self.max_updates):
            gap = problem.gap - compliance * multipliers
            last = solve(replace(problem, M=M, gap=gap), last)
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

"""Frictionless unilateral contact with a penalty pressure on contact points.

A contact point i has the area A_i and carries the normal force ``lam_i = eps A_i p_i`` where
``p_i = max(0, -g_i)`` is its penetration and ``eps`` the penalty in Pa/m. The gap follows from
the free gap and the flexibility of all that the forces push on, ``g = g_free + W lam``. So

    M = W + diag(1/(eps A)),   w = g_free + M lam,   lam >= 0,  w >= 0,  lam w = 0

a linear complementarity problem with a symmetric positive definite matrix: exactly one
solution, no tension by construction, ``-g = lam/(eps A)`` where lam > 0.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from contactstudy.arrays import Array, BoolArray
from contactstudy.exceptions import InputError, NumericalError

_APPROACHES = 60
"""Bound on the approaches tried for a resultant."""


@dataclass(frozen=True)
class PatchForces:
    """Solution of a contact problem on points.

    Attributes
    ----------
    forces : ndarray (n,)
        Normal forces in N, never negative.
    active : ndarray of bool (n,)
        Points in contact; a good first guess for the next problem.
    iterations : int
        Linear solves needed.
    """

    forces: Array
    active: BoolArray
    iterations: int


@dataclass(frozen=True)
class PressedForces(PatchForces):
    """Solution with a prescribed resultant.

    Attributes
    ----------
    approach : float
        Rigid approach in m that gives the resultant.
    stiffness : float
        Tangent dF/d(approach) in N/m at the solution.
    """

    approach: float
    stiffness: float


def _solve(M: Array, index: NDArray[np.intp], rhs: Array) -> Array:
    """Solve ``M[index, index] x = rhs`` by Cholesky."""
    _, x, info = lapack.dposv(M[index[:, None], index], rhs, lower=1)
    if info:
        raise NumericalError(
            f"contact: flexibility of the {len(index)} points in contact is not positive "
            f"definite (pivot {info})"
        )
    return np.asarray(x)


def contact_forces(
    M: Array,
    gap: Array,
    guess: BoolArray | None = None,
    *,
    max_iterations: int = 1000,
    patience: int = 8,
) -> PatchForces:
    """Contact forces for given free gaps.

    Primal-dual active set (semismooth Newton): all points that violate their condition change
    sides at once. Newton may cycle; so once the number of violations has not come down for
    `patience` exchanges, the same problem is solved as the convex programme that it is, min
    ``lam M lam/2 + gap lam`` over ``lam >= 0``, by Lawson and Hanson's method (1974, ch. 23),
    which never goes up and therefore ends. The result satisfies the conditions up to rounding.

    Parameters
    ----------
    M : ndarray (n, n)
        Flexibility plus penalty compliance, ``W + diag(1/(eps A))``, in m/N; symmetric
        positive definite.
    gap : ndarray (n,)
        Gaps without contact forces in m, negative where the bodies overlap; these are the points
        first tried in contact without a guess.

    Raises
    ------
    NumericalError
        If `M` is not positive definite or the active set does not settle.
    """
    active = (gap < 0) if guess is None else np.array(guess, dtype=bool)
    # a gap is "open" down to rounding of the largest one
    tolerance = 1e-13 * float(np.abs(gap).max(initial=0.0))
    best, tries = len(gap) + 1, patience
    for iteration in range(1, max_iterations + 1):
        forces, slack = _balance(M, gap, active)
        wrong = np.where(active, forces < 0, slack < -tolerance)
        violations = int(np.count_nonzero(wrong))
        if violations == 0:
            return PatchForces(forces, active, iteration)
        tries = patience if violations < best else tries - 1
        best = min(best, violations)
        if tries < 0:
            return _descend(M, gap, tolerance, iteration, max_iterations)
        active ^= wrong
    raise _unsettled(gap, active, forces, max_iterations)


def _balance(M: Array, gap: Array, active: BoolArray) -> tuple[Array, Array]:
    """Forces that close the gaps of the active points, and the gaps then left."""
    forces, index = np.zeros(len(gap)), np.flatnonzero(active)
    if not len(index):
        return forces, gap
    # M_AA lam_A = -g_A
    forces[index] = _solve(M, index, -gap[index])
    return forces, gap + M[:, index] @ forces[index]


def _descend(
    M: Array, gap: Array, tolerance: float, iteration: int, max_iterations: int
) -> PatchForces:
    """Lawson and Hanson's active set: points enter one at a time, forces stay admissible."""
    active = np.zeros(len(gap), dtype=bool)
    forces, slack = np.zeros(len(gap)), gap
    while True:
        worst = int(np.argmin(np.where(active, np.inf, slack)))
        if active.all() or slack[worst] >= -tolerance:
            return PatchForces(forces, active, iteration)
        active[worst] = True
        while True:
            iteration += 1
            if iteration > max_iterations:
                raise _unsettled(gap, active, forces, max_iterations)
            target, slack = _balance(M, gap, active)
            low = active & (target <= 0)
            if not low.any():
                forces = target
                break
            # go towards the target until the first force vanishes; that point leaves
            share = forces[low] / (forces[low] - target[low])
            forces = forces + share.min() * (target - forces)
            leaving = np.flatnonzero(low)[share <= share.min()]
            forces[leaving], active[leaving] = 0.0, False


def _unsettled(gap: Array, active: BoolArray, forces: Array, limit: int) -> NumericalError:
    return NumericalError(
        f"contact: active set not settled after {limit} linear solves: {len(gap)} points, "
        f"{int(active.sum())} active, least gap {gap.min():.3e} m, sum of forces "
        f"{forces.sum():.6g} N"
    )


def press(
    M: Array,
    gap: Array,
    normal: Array,
    resultant: float,
    guess: BoolArray | None = None,
    approach: float | None = None,
) -> PressedForces:
    """Contact forces and rigid approach for a prescribed resultant.

    The gap without forces is ``gap - approach * normal`` and the resultant is
    ``F = sum(normal * forces)``, an increasing, piecewise linear function of the approach with
    the slope ``normal_A^T M_AA^-1 normal_A``. Newton's iteration, held within the bracket found
    so far, ends on it, to 1e-12 relative; it may start at an approach given in m.

    Parameters
    ----------
    M, gap : ndarray (n, n), (n,)
        As in `contact_forces`, at approach zero.
    normal : ndarray (n,)
        Component of the contact normal along the approach, positive.
    resultant : float
        F in N, positive.

    Raises
    ------
    InputError
        If the resultant is not positive.
    NumericalError
        If an iteration does not converge.
    """
    if not resultant > 0:
        raise InputError(f"contact resultant {resultant} N: must be positive")
    first_touch = float(np.min(gap / normal))
    if approach is None or approach <= first_touch:
        # one point alone would have to give way this much: an upper bound of the approach
        nearest = int(np.argmin(gap / normal))
        approach = first_touch + resultant * float(M[nearest, nearest]) / normal[nearest] ** 2
    active, total, force = guess, 0, 0.0
    low, high = first_touch, np.inf
    for _ in range(_APPROACHES):
        solution = contact_forces(M, gap - approach * normal, active)
        active, total = solution.active, total + solution.iterations
        force = float(normal @ solution.forces)
        index = np.flatnonzero(active)
        stiffness = float(normal[index] @ _solve(M, index, normal[index])) if len(index) else 0.0
        if abs(force - resultant) <= 1e-12 * resultant:
            return PressedForces(solution.forces, active, total, approach, stiffness)
        if force < resultant:
            low = approach
        else:
            high = approach
        approach = approach + (resultant - force) / stiffness if stiffness > 0 else np.inf
        if not low < approach < high:
            approach = (
                0.5 * (low + high) if high < np.inf else first_touch + 2 * (low - first_touch)
            )
    raise NumericalError(
        f"contact: no approach found for the resultant {resultant:.6g} N "
        f"(last approach {approach:.6e} m gave {force:.6g} N)"
    )

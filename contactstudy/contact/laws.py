"""Contact laws of a wheel at a point, and the forces of all wheels in one step.

Per wheel i the gap is g_i = g*_i + sum_j W_ij lambda_j with the free gap g* and the compliance
W of track, wheel and loaded element. Every law gives the TOTAL force lambda in compression.
Vertical contact is unilateral: lambda >= 0 always; lateral contact (`bilateral`) is not.
"""

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import NumericalError
from contactstudy.validation import Above, Parameters, Unit

_ITERATIONS = 100


@dataclass(frozen=True)
class LinearSpring(Parameters):
    """The paper's constant k_r: lambda = static load - k_r g, zero once that is a tension.

    The static load already sits on the rail (eq. 5), so k_r carries the dynamic part only. The
    constant that matches Hertz's law there is its tangent stiffness, 1.5 times the secant of
    eq. (7).
    """

    stiffness: Annotated[float, Unit("N/m"), Above(0), "contact stiffness k_r"]

    @property
    def softness(self) -> float:
        """Least compliance of the law [m/N]."""
        return 1.0 / self.stiffness


@dataclass(frozen=True)
class RigidContact:
    """No contact deformation: g = 0 while pressed."""

    softness: ClassVar[float] = 0.0


@dataclass(frozen=True)
class HertzSpring(Parameters):
    """Hertz's nonlinear law of the total force, lambda = k_H (-g)^(3/2), zero when apart.

    k_H: see `contactstudy.halfspace.hertz`.
    """

    stiffness: Annotated[float, Unit("N/m**1.5"), Above(0), "Hertz stiffness k_H"]
    softness: ClassVar[float] = math.inf


@dataclass(frozen=True)
class MovingForce:
    """The static load itself, whatever wheel and rail do."""

    softness: ClassVar[float] = math.inf


ContactLaw = LinearSpring | RigidContact | HertzSpring | MovingForce


def point_forces(
    law: ContactLaw,
    compliance: Array,
    free_gap: Array,
    static_loads: Array,
    bilateral: bool = False,
) -> Array:
    """Forces lambda (nw,) [N] of all wheels that satisfy the law at the end of a step.

    Parameters
    ----------
    compliance : ndarray
        W, (nw, nw), symmetric positive definite, local compliance included [m/N].
    free_gap : ndarray
        g*, (nw,) [m].
    static_loads : ndarray
        (nw,) [N].
    bilateral : bool
        Whether tension is possible; not for Hertz's law.

    Raises
    ------
    NumericalError
        If the nonlinear equations of several wheels do not converge.
    """
    if len(free_gap) == 1:
        W, gap, load = float(compliance[0, 0]), float(free_gap[0]), float(static_loads[0])
        return np.array([_force_of_one(law, W, gap, load, bilateral)])
    match law:
        case MovingForce():
            return static_loads.copy()
        case HertzSpring(stiffness=k_hertz):
            return _hertz_many(k_hertz, compliance, free_gap)
        case LinearSpring(stiffness=k_r):
            # lambda = F - k_r (g* + W lambda)  =>  (W + 1/k_r) lambda = F/k_r - g*
            flexibility = compliance + np.eye(len(free_gap)) / k_r
            return _linear_many(flexibility, static_loads / k_r - free_gap, bilateral)
        case RigidContact():
            return _linear_many(compliance, -free_gap, bilateral)


def _force_of_one(
    law: ContactLaw, compliance: float, free_gap: float, static_load: float, bilateral: bool
) -> float:
    """Closed forms for a single wheel."""
    match law:
        case MovingForce():
            return static_load
        case HertzSpring(stiffness=k_hertz):
            return _hertz_one(k_hertz, compliance, free_gap)
        case LinearSpring(stiffness=k_r):
            force = (static_load - k_r * free_gap) / (1.0 + k_r * compliance)
        case RigidContact():
            force = -free_gap / compliance
    # max(0.0, nan) would hide a number that is none
    return 0.0 if force < 0.0 and not bilateral else force


def _linear_many(flexibility: Array, target: Array, bilateral: bool) -> Array:
    """Solve flexibility @ lambda = target, or its complementarity problem with lambda >= 0.

    The linear solution counts if nowhere tensile. Otherwise projected Gauss-Seidel sweeps, which
    converge for every positive definite matrix, find who is apart.
    """
    force = np.asarray(np.linalg.solve(flexibility, target))
    if bilateral or not np.any(force < 0.0):
        return force
    force = np.maximum(force, 0.0)
    for _ in range(1000 * _ITERATIONS):
        before = force.copy()
        for i in range(len(force)):
            rest = target[i] - flexibility[i] @ force + flexibility[i, i] * force[i]
            force[i] = max(0.0, rest / flexibility[i, i])
        if np.abs(force - before).max() <= 1e-14 * np.abs(force).max(initial=1e-300):
            return force
    raise NumericalError(f"contact of {len(force)} wheels: the contact forces do not converge")


def _hertz_one(k_hertz: float, compliance: float, free_gap: float) -> float:
    """Scalar Newton in the penetration d: g* + W k_H d^(3/2) + d = 0.

    The left side is convex and increasing, so Newton's method started on its right side, at
    d = -g*, decreases steadily to the solution.
    """
    if free_gap >= 0.0:
        return 0.0
    if not math.isfinite(free_gap):
        return math.nan  # reported by the stepper, with step and position
    d = -free_gap
    stiffness = compliance * k_hertz
    for _ in range(_ITERATIONS):
        root = math.sqrt(d)
        move = (free_gap + stiffness * d * root + d) / (1.5 * stiffness * root + 1.0)
        d -= move
        if abs(move) <= 4e-16 * abs(d):
            break
        d = max(d, 0.0)
    return k_hertz * d * math.sqrt(d)


def _hertz_many(k_hertz: float, compliance: Array, free_gap: Array) -> Array:
    """Newton with a line search on g* + W k_H d_+^(3/2) + d = 0, d < 0 being an open gap."""
    n = len(free_gap)
    if not np.all(np.isfinite(free_gap)):
        return np.full(n, np.nan)  # reported by the stepper, with step and position

    def residual(d: Array) -> Array:
        return free_gap + compliance @ (k_hertz * np.maximum(d, 0.0) ** 1.5) + d

    d = -free_gap
    r = residual(d)
    for _ in range(_ITERATIONS):
        if np.abs(r).max() <= 1e-15 * np.abs(free_gap).max():
            break
        # I + W D is regular for W positive definite and D >= 0
        slope = 1.5 * k_hertz * np.sqrt(np.maximum(d, 0.0))
        move = -np.linalg.solve(np.eye(n) + compliance * slope, r)
        length, size = 1.0, np.linalg.norm(r)
        while length > 1e-10:
            trial = residual(d + length * move)
            if np.linalg.norm(trial) < size:
                break
            length *= 0.5
        else:
            break  # no further decrease: either solved to rounding, or stuck (checked below)
        d, r = d + length * move, trial
    if np.abs(r).max() > 1e-12 * np.abs(free_gap).max():
        raise NumericalError(
            f"Hertz contact of {n} wheels does not converge: {np.abs(r).max():.3g} m left"
        )
    return k_hertz * np.maximum(d, 0.0) ** 1.5

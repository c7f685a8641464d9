"""Contact laws of a wheel at a point, and the forces of all wheels in one step.

Per wheel i the gap is g_i = g*_i + sum_j W_ij lambda_j with the free gap g* and the compliance
W of track, wheel and loaded element. Every law gives the TOTAL force lambda in compression.
Vertical contact is unilateral: lambda >= 0 always; lateral contact (`bilateral`) is not.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Protocol

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact import law_forces
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.validation import Above, Parameters, Unit

LATERAL_STIFFNESS = 1e9
"""N/m, of the contact across the rail without slip: 0.8 of the normal tangent of 1.2 GN/m, the
ratio 2(1 - nu)/(2 - nu) of R. D. Mindlin, J. Appl. Mech. 16 (1949) 259."""


class Law(Protocol):
    """A law as its compiled form knows it, see `law_forces`."""

    @property
    def kind(self) -> int:
        """One of the kinds of `law_forces`."""

    @property
    def numbers(self) -> Array:
        """What its kind wants."""

    @property
    def softness(self) -> float:
        """Least compliance of the law [m/N]."""


@dataclass(frozen=True)
class LinearSpring(Parameters):
    """The paper's constant k_r: lambda = static load - k_r g, zero once that is a tension.

    The static load already sits on the rail (eq. 5), so k_r carries the dynamic part only. The
    constant that matches Hertz's law there is its tangent stiffness, 1.5 times the secant of
    eq. (7).
    """

    stiffness: Annotated[float, Unit("N/m"), Above(0), "contact stiffness k_r"]
    kind: ClassVar[int] = law_forces.LINEAR

    @cached_property
    def numbers(self) -> Array:
        """See `law_forces.wheel_forces`."""
        return np.array([self.stiffness])

    @property
    def softness(self) -> float:
        """Least compliance of the law [m/N]."""
        return 1.0 / self.stiffness


@dataclass(frozen=True)
class RigidContact:
    """No contact deformation: g = 0 while pressed."""

    softness: ClassVar[float] = 0.0
    kind: ClassVar[int] = law_forces.RIGID
    numbers: ClassVar[Array] = np.zeros(0)


@dataclass(frozen=True)
class HertzSpring(Parameters):
    """Hertz's nonlinear law of the total force, lambda = k_H (-g)^(3/2), zero when apart.

    k_H: see `contactstudy.halfspace.hertz`.
    """

    stiffness: Annotated[float, Unit("N/m**1.5"), Above(0), "Hertz stiffness k_H"]
    softness: ClassVar[float] = math.inf
    kind: ClassVar[int] = law_forces.HERTZ

    @cached_property
    def numbers(self) -> Array:
        """See `law_forces.wheel_forces`."""
        return np.array([self.stiffness])

    def approach_at(self, load: float) -> float:
        """Approach [m] under a load [N]."""
        return float((load / self.stiffness) ** (2 / 3))


@dataclass(frozen=True)
class MovingForce:
    """The static load itself, whatever wheel and rail do."""

    softness: ClassVar[float] = math.inf
    kind: ClassVar[int] = law_forces.MOVING
    numbers: ClassVar[Array] = np.zeros(0)


@dataclass(frozen=True, eq=False)
class PressSpring:
    """The force of a static press over its approach, zero when apart.

    F^(2/3), over which Hertz's law is straight, is a monotone cubic with a continuous slope between
    the rows of a table (F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238), and
    straight beyond the last: there F grows with the 3/2 power.

    Approaches (k,) [m] and forces (k,) [N], both growing, without the first touch (0, 0).
    """

    approach: Array
    force: Array
    softness: ClassVar[float] = math.inf
    kind: ClassVar[int] = law_forces.PRESS

    def __post_init__(self) -> None:
        """Refuse a press that gives way less under more load."""
        d, f = np.r_[0.0, self.approach], np.r_[0.0, self.force]
        if not (np.all(np.diff(d) > 0.0) and np.all(np.diff(f) > 0.0)):
            raise InputError(
                "PressSpring: approach and force must grow from row to row, but the approach goes "
                f"from {d[0]:g} over {d.max():.3g} to {d[-1]:.3g} m; where a press gives that, the "
                "rail bends too far under the wheel (without supports, say): use Hertz's law"
            )

    @property
    def largest(self) -> float:
        """Largest force of the table [N]."""
        return float(self.force[-1])

    def approach_at(self, load: float) -> float:
        """Approach [m] under a load [N] of the table."""
        return float(np.interp(load ** (2 / 3), self.force ** (2 / 3), self.approach))

    @cached_property
    def numbers(self) -> Array:
        """See `law_forces.wheel_forces`."""
        from scipy.interpolate import PchipInterpolator

        d, q = np.r_[0.0, self.approach], np.r_[0.0, self.force] ** (2 / 3)
        return np.concatenate([[len(d)], d, q, PchipInterpolator(d, q).derivative()(d)])


ContactLaw = LinearSpring | RigidContact | HertzSpring | PressSpring | MovingForce
"""Laws that feel the irregularity at one place."""


def point_forces(
    law: Law,
    compliance: Array,
    free_gap: Array,
    static_loads: Array,
    bilateral: bool = False,
    shape: Array | None = None,
    beside: Array | None = None,
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
        Whether tension is possible; for linear and rigid contact only.
    shape : ndarray, optional
        Of the profile under each wheel (nw, m), for the laws of `patch_laws` [m].
    beside : ndarray, optional
        (nw,) k_y of contacts beside the rail [N/m]; 0 of those on top, which follow the law.

    Raises
    ------
    NumericalError
        If the equations of several wheels do not converge.
    """
    force = np.empty(len(free_gap))
    left = law_forces.wheel_forces(
        law.kind,
        law.numbers,
        np.zeros((len(free_gap), 0)) if shape is None else shape,
        np.ascontiguousarray(compliance),
        np.ascontiguousarray(free_gap),
        np.ascontiguousarray(static_loads),
        bilateral,
        np.zeros(len(free_gap)) if beside is None else beside,
        force,
    )
    if left:
        raise NumericalError(unsolved(len(force), left))
    return force


def unsolved(n_wheels: int, left: float) -> str:
    """Message about equations of the contact that do not converge."""
    return f"contact of {n_wheels} wheels does not converge: {left:.3g} m left"

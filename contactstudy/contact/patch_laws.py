"""Contact laws that feel the irregularity along the patch, and more of it under more load.

Each gives the solver what is felt at first touch and, beside it, the profile's *shape* under the
wheel in every step, from which `law_forces` has the force.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact import law_forces
from contactstudy.contact.filters import Level, Trajectory
from contactstudy.contact.laws import HertzSpring, PressSpring
from contactstudy.contact.press_table import LARGEST, PressTable

_PER_HALF = 16  # places of a bedding over half the patch at the static load
_ROWS = 32  # approaches at which the mean over the patch is taken
_PLACES = 48  # of the profile over half the longest patch


@dataclass(frozen=True)
class WinklerBedding:
    """Springs side by side along the patch, which do not feel each other, and may be apart.

    P. J. Remington and J. Webb, J. Sound Vib. 193 (1996) 83; R. A. J. Ford and D. J. Thompson,
    J. Sound Vib. 293 (2006) 807. The force per length is ``k (d + r(X + x) - x^2/2R)_+``. With

        R = a^2/(2 d0),    k = 3 F0/(4 a d0)

    patch length and force over approach are those of Hertz's law at all loads on a smooth rail (a,
    d0: half length and approach at the static load F0; R is about half the wheel's radius), and a
    small r is felt as by an elastic contact, its mean over the patch.
    """

    half_length: float
    approach: float
    load: float
    softness: ClassVar[float] = np.inf
    kind: ClassVar[int] = law_forces.BEDDING

    @property
    def step(self) -> float:
        """Distance of the places at which the profile is taken [m]."""
        return self.half_length / _PER_HALF

    @cached_property
    def numbers(self) -> Array:
        """See `law_forces.wheel_forces`; k for the profile between its places, not the parabola."""
        smooth = -self.approach * (np.arange(-_PER_HALF, _PER_HALF + 1) / _PER_HALF) ** 2
        one = np.array([1.0, self.step])
        area, _ = law_forces.of_penetration(self.kind, one, smooth, self.approach)
        return np.array([self.load / area, self.step])

    def seen(self, level: Level, x: Array) -> tuple[Array, Array]:
        """Height of first touch (n,) and the profile below it (n, m), in m, at positions x (n,)."""
        radius = self.half_length**2 / (2.0 * self.approach)
        ahead, _ = Trajectory(radius).rest(level, x)
        reach = 3.0 * self.half_length + float(np.abs(ahead).max(initial=0.0))
        n = int(np.ceil(reach / self.step))
        offsets = self.step * np.arange(-n, n + 1)
        heights = level(x[:, None] + offsets) - offsets**2 / (2.0 * radius)
        top = heights.max(axis=1)
        return top, heights - top[:, None]


@dataclass(frozen=True, eq=False)
class FollowingPatch:
    """A law of the mean over the patch at the force of the moment, instead of the static one.

    To first order in r a contact under the force F feels r weighted as F spreads an added load
    (`press_table.load_weights`). With the law's approach s(F) the gap is ``r(F) - s(F)``: with
    ``lift = r(F(s)) - r(X)`` it is one equation in s.

    Attributes
    ----------
    offsets : ndarray (p,)
        Places along the rail in m.
    weights : ndarray (m, p)
        Weights at the approaches 0, step, 2 step ... in m; those of 0 do not count.
    """

    law: HertzSpring | PressSpring
    step: float
    offsets: Array
    weights: Array
    softness: ClassVar[float] = np.inf

    @property
    def kind(self) -> int:
        """That of the law."""
        return self.law.kind

    @cached_property
    def numbers(self) -> Array:
        """Those of the law, and the step of the approach."""
        return np.r_[self.law.numbers, self.step]

    def seen(self, level: Level, x: Array) -> tuple[Array, Array]:
        """Height at X (n,), and by how much the means are higher (n, m), in m, at x (n,)."""
        here = level(x)
        lift = level(x[:, None] + self.offsets) @ self.weights.T - here[:, None]
        lift[:, 0] = 0.0
        return here, lift

    @classmethod
    def on_ellipse(
        cls, law: HertzSpring | PressSpring, half_length: float, approach: float
    ) -> FollowingPatch:
        """Plain means over Hertz's patch, whose half length grows with the root of the approach.

        Both at the static load in m.
        """
        step = approach * LARGEST ** (2 / 3) / _ROWS
        halves = half_length * np.sqrt(step * np.arange(_ROWS + 1) / approach)
        places = halves[-1] * np.arange(-_PLACES, _PLACES + 1) / _PLACES
        # of the profile straight between the places: integrals of its hat functions over the patch
        half, h = np.maximum(halves, 1e-9)[:, None], halves[-1] / _PLACES
        weights = h * (_hat((half - places) / h) - _hat((-half - places) / h)) / (2.0 * half)
        return cls(law, step, places, weights)

    @classmethod
    def of_press(cls, law: HertzSpring | PressSpring, table: PressTable) -> FollowingPatch:
        """Weights of a press."""
        step = float(table.approach[-1]) / _ROWS
        approaches = step * np.arange(_ROWS + 1)
        weights = [np.interp(approaches, table.approach, column) for column in table.weights.T]
        return cls(law, step, table.offsets, np.stack(weights, axis=1))


PatchLaw = WinklerBedding | FollowingPatch


def _hat(t: Array) -> Array:
    """Integral of the hat function 1 - |t| from -1 to t."""
    t = np.clip(t, -1.0, 1.0)
    return np.where(t < 0.0, 0.5 * (1.0 + t) ** 2, 1.0 - 0.5 * (1.0 - t) ** 2)

"""Defects of the wheel: how far its tread lies below the round wheel's, over angle and y.

Where the wheel has rolled to X, the material that meets the rail at X + x is at the distance
``s = X + x - X_0`` round the wheel from the middle of a defect that meets the rail at X_0: to first
order a missing depth is a dip of the rail that comes back with every revolution.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.shapes import haversine
from contactstudy.validation import (
    AtMost,
    Key,
    Naming,
    Parameters,
    Unit,
    Usual,
    complaint,
)
from contactstudy.validation import quantities as q


@dataclass(frozen=True, eq=False)
class TreadLines:
    """Lines round a wheel on which its shape is wanted.

    Attributes
    ----------
    y : ndarray (n,)
        Lateral positions on the wheel's profile, from the tape circle, in m.
    rise : ndarray (n,)
        Distances of the round wheel from its tangent plane at the touch, into the wheel, in m.
    """

    y: Array
    rise: Array

    @classmethod
    def touch(cls, y: float = 0.0) -> "TreadLines":
        """The one line of first touch, at y [m]."""
        return cls(np.array([y]), np.zeros(1))


@dataclass(frozen=True)
class WheelDefect(Parameters):
    """What all defects of the wheel have."""

    at: Annotated[
        q.LengthOrZero, Key("wheel_defect_at"),
        "X at which its middle first meets the rail, and again after every revolution; of waves, "
        "where their phases are given",
    ] = 12.0  # fmt: skip


class LocalDefect(WheelDefect, ABC):
    """A defect that is not all round the wheel."""

    @abstractmethod
    def half_length(self, radius: float) -> float:
        """How far it reaches to either side of its middle, round the wheel [m]."""

    @abstractmethod
    def depth(self, s: Array, radius: float, lines: TreadLines) -> Array:
        """Missing depth (n, lines) [m] at distances s (n,) [m] of a wheel of that radius [m]."""


@dataclass(frozen=True)
class Flat(LocalDefect):
    """A fresh flat: a plane cut parallel to the tangent plane at the touch.

    A chord of length l on the circle of radius R, ``R - R cos(asin(l/2R))`` = l^2/8R deep. On a
    cylindrical tread it goes all across; on another its outline is where the plane leaves the
    wheel: an ellipse where the tread is convex, widening to the sides where it is hollow.
    """

    length: Annotated[q.Length, AtMost(0.5), Key("wheel_defect_length"), "along the tread"] = 0.04

    def half_length(self, radius: float) -> float:
        """See `LocalDefect`."""
        return 0.5 * self.length

    def depth(self, s: Array, radius: float, lines: TreadLines) -> Array:
        """See `LocalDefect`."""
        # the plane at R - d from the axle:  R - rise - (R - d)/cos(psi),  psi = s/R
        half = np.arcsin(min(0.5 * self.length / radius, 1.0))
        left = radius * np.cos(half) / np.cos(np.clip(s / radius, -1.0, 1.0))
        return np.maximum(radius - left[:, None] - lines.rise, 0.0)


@dataclass(frozen=True)
class RoundedFlat(LocalDefect):
    """A flat with worn ends, ``d/2 (1 + cos(2 pi s/l))`` deep, the same on all lines."""

    length: Annotated[q.Length, AtMost(0.5), Key("wheel_defect_length"), "along the tread"] = 0.04
    middle: Annotated[
        float | None, Unit("m"), Usual(1e-6, 0.01), Key("wheel_defect_depth"),
        "in the middle; that of the chord, l^2/8R, if left out",
    ] = None  # fmt: skip

    def problems(self, key: Naming) -> list[str]:
        """A depth that is none."""
        if self.middle is None or self.middle > 0.0:
            return []
        return [complaint(key("middle"), self.middle, "must be above 0 m")]

    def half_length(self, radius: float) -> float:
        """See `LocalDefect`."""
        return 0.5 * self.length

    def depth(self, s: Array, radius: float, lines: TreadLines) -> Array:
        """See `LocalDefect`."""
        d = self.length**2 / (8.0 * radius) if self.middle is None else self.middle
        return np.repeat(d * haversine(s, self.length)[:, None], len(lines.y), axis=1)

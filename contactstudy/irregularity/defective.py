"""A profile with defects of rail and wheel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.irregularity.flats import LocalDefect, TreadLines, WheelDefect
from contactstudy.irregularity.profile import HarmonicProfile, Profile, check_derivative
from contactstudy.irregularity.rail_defects import RailDefect
from contactstudy.irregularity.wheel_defects import OutOfRound


@dataclass(frozen=True, eq=False)
class RollingDefect:
    """A defect on a wheel of a radius [m] that rolls along the rail and touches it at y [m]."""

    defect: LocalDefect
    radius: float
    touch: float = 0.0

    @property
    def first(self) -> float:
        """X from which on it can meet the rail [m]."""
        return self.defect.at - self.defect.half_length(self.radius)

    def level(self, x: Array, lines: TreadLines | None = None) -> Array:
        """What it adds to the running surface, (n, lines) at places X (n,), both in m.

        Without lines on the one of first touch.
        """
        s = np.asarray(x, dtype=float) - self.defect.at
        turn = 2.0 * np.pi * self.radius
        s = s - turn * np.maximum(np.round(s / turn), 0.0)
        return -self.defect.depth(s, self.radius, lines or TreadLines.touch(self.touch))


@dataclass(frozen=True, eq=False)
class DefectiveProfile:
    """A profile with defects, which are not faded in; made by `with_defects`.

    As a function of X it is what stands on the wheel's line of first touch; where the wheel's
    defect has a shape across, `wheel` has it.
    """

    even: Profile
    rail: RailDefect | None = None
    wheel: RollingDefect | None = None

    @property
    def domain(self) -> tuple[float, float]:
        """That of the profile without defects [m]."""
        return self.even.domain

    @property
    def repeat_length(self) -> float:
        """That of the profile without defects [m]."""
        return self.even.repeat_length

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value at positions x of any shape [m]; defects have edges, so there is no derivative."""
        check_derivative(derivative)
        if derivative:
            raise InputError("irregularity: a profile with defects has no derivatives")
        place = np.asarray(x, dtype=float)
        level = self.without_wheel(place)
        if self.wheel is not None:
            level = level + self.wheel.level(place.ravel())[:, 0].reshape(place.shape)
        return level

    def without_wheel(self, x: Array) -> Array:
        """The same without the defect of the wheel."""
        level = self.even(x)
        return level if self.rail is None else level + self.rail(x)

    def fading(self, even: Profile, end: float) -> DefectiveProfile:
        """The same with another profile below the defects, which is faded in until `end` [m].

        ``InputError`` if a defect lies before the end: it would be there in full.
        """
        firsts = {
            "rail": np.inf if self.rail is None else self.rail.at - self.rail.half_length,
            "wheel": np.inf if self.wheel is None else self.wheel.first,
        }
        problems = [
            f"irregularity: the {body}'s defect begins at X = {first:g} m; must be behind the "
            f"fade-in, from {end:g} m on"
            for body, first in firsts.items()
            if first < end - 1e-9 * max(abs(end), 1.0)
        ]
        if problems:
            raise InputError(problems)
        return replace(self, even=even)


@dataclass(frozen=True, eq=False)
class _Sum:
    """A profile and the waves of a wheel that is not round."""

    one: Profile
    other: HarmonicProfile

    @property
    def domain(self) -> tuple[float, float]:
        """That of the profile [m]."""
        return self.one.domain

    @property
    def repeat_length(self) -> float:
        """That of the profile [m]: the wheel is meant to repeat."""
        return self.one.repeat_length

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value or derivative at positions x of any shape."""
        return self.one(x, derivative) + self.other(x, derivative)


def with_defects(
    even: Profile,
    rail: RailDefect | None = None,
    wheel: WheelDefect | None = None,
    radius: float = 0.43,
    touch: float = 0.0,
) -> Profile:
    """A profile with a defect of the rail and one of a wheel.

    Waves of a wheel that is not round are part of the profile and fade in with it.

    Parameters
    ----------
    radius : float
        Of the wheel [m].
    touch : float
        Where it touches the rail, y on its profile [m].
    """
    if isinstance(wheel, OutOfRound):
        even, wheel = _Sum(even, HarmonicProfile(*wheel.terms(radius))), None
    if rail is None and wheel is None:
        return even
    rolling = RollingDefect(wheel, radius, touch) if isinstance(wheel, LocalDefect) else None
    return DefectiveProfile(even, rail, rolling)


def even(profile: Profile) -> Profile:
    """A profile without its defects."""
    return profile.even if isinstance(profile, DefectiveProfile) else profile

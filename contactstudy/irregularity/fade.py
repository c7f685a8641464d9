"""Profiles that grow smoothly from nothing."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.irregularity.defective import DefectiveProfile
from contactstudy.irregularity.profile import EVERYWHERE, Profile, check_derivative
from contactstudy.irregularity.shapes import smoothstep


@dataclass(frozen=True, eq=False)
class FadedProfile:
    """A profile and its fade-in, which starts at ``start`` [m]; made by ``faded``."""

    profile: Profile
    start: float
    length: float

    @property
    def domain(self) -> tuple[float, float]:
        """The profile's own, and everything before the fade-in starts [m]."""
        low, high = self.profile.domain
        return (-np.inf if low <= self.start else low), high

    @property
    def repeat_length(self) -> float:
        """That of the profile [m]."""
        return self.profile.repeat_length

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value or derivative at positions x of any shape [m, 1, 1/m]."""
        check_derivative(derivative)
        position = np.asarray(x, dtype=float)
        out = np.zeros(position.shape)
        on = position > self.start
        out[on] = self._on(position[on], derivative)
        return out

    def _on(self, x: Array, derivative: int) -> Array:
        # s(t) = 10 t^3 - 15 t^4 + 6 t^5 with t = (X - start)/length: s' and s'' vanish at both
        # ends, so that the wheel feels no jump in velocity or acceleration
        t = np.minimum((x - self.start) / self.length, 1.0)
        s0 = smoothstep(t)
        r0 = self.profile(x)
        if derivative == 0:
            return s0 * r0
        s1 = 30.0 * t**2 * (1.0 - t) ** 2 / self.length
        r1 = self.profile(x, 1)
        if derivative == 1:
            return s1 * r0 + s0 * r1
        s2 = 60.0 * t * (1.0 - t) * (1.0 - 2.0 * t) / self.length**2
        return s2 * r0 + 2.0 * s1 * r1 + s0 * self.profile(x, 2)


@dataclass(frozen=True, eq=False)
class SharedProfile:
    """A share of a profile, itself a function of X; where it is 0, the profile need not be known.

    It has no derivatives.
    """

    profile: Profile
    share: Callable[[Array], Array]
    domain = EVERYWHERE

    @property
    def repeat_length(self) -> float:
        """That of the profile [m]."""
        return self.profile.repeat_length

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value at positions x of any shape [m]."""
        if derivative:
            raise InputError("irregularity: a share of a profile has no derivatives")
        position = np.asarray(x, dtype=float)
        out = self.share(position)
        on = out > 0.0
        out[on] *= self.profile(position[on])
        return out


def faded(profile: Profile, start: float, length: float) -> Profile:
    """Profile multiplied by a quintic smoothstep from 0 at ``start`` to 1 ``length`` later.

    Both in m; a length of 0 leaves the profile as it is, a negative one is an ``InputError``.
    Defects are not faded; one that lies before the end of the fade-in is an ``InputError``.
    """
    if not length >= 0.0 or not np.isfinite(length):
        raise InputError(f"fade-in length is {length} m; allowed: 0 m or more")
    if isinstance(profile, DefectiveProfile):
        return profile.fading(faded(profile.even, start, length), start + length)
    return profile if length == 0.0 else FadedProfile(profile, start, length)

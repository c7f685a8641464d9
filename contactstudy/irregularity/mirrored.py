"""A profile as a train meets it that comes from the other end."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.irregularity.defective import DefectiveProfile
from contactstudy.irregularity.profile import Profile


@dataclass(frozen=True, eq=False)
class MirroredProfile:
    """r(length - s) over the way s from the far end of a track of a length [m]."""

    profile: Profile
    length: float

    @property
    def domain(self) -> tuple[float, float]:
        """Ways between which the profile is known [m]."""
        low, high = self.profile.domain
        return self.length - high, self.length - low

    @property
    def repeat_length(self) -> float:
        """That of the profile [m]."""
        return self.profile.repeat_length

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value or derivative at ways of any shape [m, 1, 1/m]."""
        there = self.length - np.asarray(x, dtype=float)
        return (-1.0) ** derivative * self.profile(there, derivative)


def mirrored(profile: Profile, length: float) -> Profile:
    """The profile over the way from the far end of a track of a length [m].

    Raises
    ------
    InputError
        If it has defects, which are placed along +X.
    """
    if isinstance(profile, DefectiveProfile):
        raise InputError("a profile with defects cannot be run over backward")
    return MirroredProfile(profile, length)

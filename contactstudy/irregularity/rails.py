"""The irregularity of two rails, vertical and transverse, and what follows of gauge and level."""

from dataclasses import dataclass, field
from typing import Literal

from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.irregularity.profile import Profile, SmoothRail


@dataclass(frozen=True)
class RailProfiles:
    """Irregularity of each rail; right and left are seen along +X.

    A vertical one raises the running surface, a lateral one moves it to +Y, the left.
    """

    right: Profile
    left: Profile
    lateral_right: Profile = field(default_factory=SmoothRail)
    lateral_left: Profile = field(default_factory=SmoothRail)

    def of(self, rail: int, direction: Literal["Z", "Y"]) -> Profile:
        """That of the rail 0 (right) or 1 (left)."""
        vertical = (self.right, self.left)
        return vertical[rail] if direction == "Z" else (self.lateral_right, self.lateral_left)[rail]

    def level(
        self, rail: int, direction: Literal["Z", "Y"], x: ArrayLike, derivative: int = 0
    ) -> Array:
        """Irregularity of a rail in a direction at X, or a derivative of it [m, 1, 1/m]."""
        return self.of(rail, direction)(x, derivative)

    def gauge(self, x: ArrayLike) -> Array:
        """By how much the rails are further apart than they should be [m]."""
        return self.lateral_left(x) - self.lateral_right(x)

    def alignment(self, x: ArrayLike) -> Array:
        """Transverse irregularity of the middle of the track [m]."""
        return 0.5 * (self.lateral_left(x) + self.lateral_right(x))

    def cross_level(self, x: ArrayLike) -> Array:
        """By how much the left rail is higher than the right one [m]."""
        return self.left(x) - self.right(x)

    def longitudinal_level(self, x: ArrayLike) -> Array:
        """Vertical irregularity of the middle of the track [m]."""
        return 0.5 * (self.left(x) + self.right(x))

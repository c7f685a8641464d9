"""The irregularity of two rails, vertical and transverse."""

from dataclasses import dataclass, field
from typing import Literal

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

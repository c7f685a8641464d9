"""Where a wheel stands on a rail: both profiles, the position, and the first touch."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.geometry.facing import Facing, surface_gap
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.smooth_touch import SmoothTouch, smooth_touch
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import rail_curve
from contactstudy.solids.wheel_recipe import WheelRecipe


@dataclass(frozen=True, eq=False)
class Geometry:
    """Smooth surfaces of rail and wheel, and their position to each other.

    Parameters
    ----------
    radius : float
        Rolling radius of the wheel at the tape circle [m].
    pose : Pose
        Of the wheel; by default centred and upright on an upright rail.
    """

    rail: ProfileCurve
    wheel: ProfileCurve
    radius: float
    pose: Pose = field(default_factory=Pose)

    @classmethod
    def of(cls, recipe: WheelRecipe, pose: Pose | None = None) -> "Geometry":
        """Of the profiles that a wheel's recipe names; centred and upright without a pose."""
        rail, wheel = rail_curve(recipe.rail_profile), recipe.curve
        return cls(rail, wheel, recipe.dimensions.radius, pose or Pose())

    @cached_property
    def placed(self) -> PlacedWheel:
        """The wheel in its pose, its tape circle level with the crown."""
        return PlacedWheel(self.wheel, self.radius, self.pose)

    @cached_property
    def touch(self) -> SmoothTouch:
        """First touch of the smooth surfaces when the wheel is lowered."""
        return smooth_touch(self.placed, self.rail)

    def facing(self, x: Array, s: Array, down: float = 0.0) -> Facing:
        """Gap, normals and feet of points of the wheel, lowered by `down` from first touch [m].

        Places on the wheel x, s (n,): along it in its own axes, arc length on its profile [m].
        """
        return surface_gap(self.placed, self.rail, self.touch.travel + down, x, s)

    def on_locus(self, s: Array, down: float = 0.0) -> Facing:
        """The same where the wheel's circles of arc lengths s (n,) come nearest to the rail."""
        return self.facing(self.placed.locus(s), s, down)

    def relative_radii(self) -> tuple[float, float]:
        """Relative radii of curvature at the first touch along and across the rail [m].

        Along, a circle of radius r whose plane is tilted by the contact angle a has the normal
        curvature ``cos(a)/r`` (Meusnier).

        Raises
        ------
        InputError
            If the surfaces are conformal across the rail there, so that Hertz does not apply.
        """
        touch = self.touch
        radius = self.radius - float(self.wheel.point(touch.wheel_s)[1])
        across = float(self.rail.curvature(touch.arc) + self.wheel.curvature(touch.wheel_s))
        if not across > 0:
            raise InputError(
                f"Hertz contact of {self.wheel.name} on {self.rail.name}: the relative curvature "
                f"across the rail is {across:.4g} 1/m at the first touch; must be positive"
            )
        return radius / float(np.cos(touch.angle)), 1.0 / across

    def overlap(self, approach: float) -> tuple[Array, Array]:
        """Where the undeformed bodies overlap, the wheel `approach` [m] below touch.

        Returns arc lengths (n,) on wheel and rail in m, at steps of 0.1 mm.
        """
        first, last = self.wheel.s_range
        s = np.linspace(first, last, int((last - first) / 0.1e-3) + 2)
        facing = self.on_locus(s, approach)
        overlaps = facing.gap < 0
        return s[overlaps], facing.arc[overlaps]

    def moved(self, lateral: float) -> "Geometry":
        """The same with the wheel further to the field side by `lateral` in m."""
        pose = replace(self.pose, lateral=self.pose.lateral + lateral)
        return Geometry(self.rail, self.wheel, self.radius, pose)

    def feet(self, s: Array) -> Array:
        """Arc lengths (n,) on the rail where the wheel's s (n,) come nearest at first touch [m]."""
        return self.on_locus(s).arc

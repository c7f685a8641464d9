"""Where the wheel stands on the rail: contact points and candidate facets of the two surfaces."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.geometry.facets import placed_candidates
from contactstudy.geometry.interpolation import SLACK
from contactstudy.geometry.placed import placed_points
from contactstudy.geometry.points import ContactPoints, contact_points, rolling_drop
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.quadrature import Quadrature
from contactstudy.geometry.search import CandidateList, FacetSearch, grid_surface
from contactstudy.geometry.smooth_touch import SmoothTouch, smooth_touch
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.wheel import wheel_profile
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.track.solid import SolidTrack
from contactstudy.track.unreduced import UnreducedTrack


@dataclass(frozen=True, eq=False)
class Geometry:
    """Smooth surfaces of rail and wheel, and their position to each other.

    Parameters
    ----------
    rail, wheel : ProfileCurve
    radius : float
        Rolling radius of the wheel at the tape circle [m].
    pose : Pose
    """

    rail: ProfileCurve
    wheel: ProfileCurve
    radius: float
    pose: Pose

    @classmethod
    def of(cls, wheel: WheelFlexibility, pose: Pose | None = None) -> "Geometry":
        """Of the profiles that a wheel's recipe names."""
        recipe = wheel.recipe
        return cls(
            rail_curve(recipe.rail_profile),
            wheel_curve(recipe.profile),
            recipe.dimensions.radius,
            pose or Pose(),
        )

    @cached_property
    def touch(self) -> SmoothTouch:
        """First touch of the smooth surfaces when the wheel is lowered."""
        return smooth_touch(PlacedWheel(self.wheel, self.radius, self.pose), self.rail)

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
        """Where the undeformed bodies overlap, the wheel standing lower than at first touch.

        Parameters
        ----------
        approach : float
            Vertical, in m, positive.

        Returns
        -------
        s, arc : ndarray (n,)
            Arc lengths on wheel and rail in m, at steps of 0.1 mm.
        """
        placed = PlacedWheel(self.wheel, self.radius, self.pose)
        first, last = self.wheel.s_range
        s = np.linspace(first, last, int((last - first) / 0.1e-3) + 2)
        points, _ = placed.surface(placed.locus(s), s)
        down = (self.touch.travel + approach) * self.pose.vertical
        arc, distance = self.rail.project(points[:, 1:] - down)
        return s[distance < 0], arc[distance < 0]

    def moved(self, lateral: float) -> "Geometry":
        """The same with the wheel further to the field side by `lateral` in m."""
        pose = replace(self.pose, lateral=self.pose.lateral + lateral)
        return Geometry(self.rail, self.wheel, self.radius, pose)

    def feet(self, s: Array) -> Array:
        """Where lines of the wheel come nearest to the rail at the first touch.

        Parameters
        ----------
        s : ndarray (n,)
            Arc lengths on the wheel's profile in m.

        Returns
        -------
        ndarray (n,)
            Arc lengths on the rail in m.
        """
        placed = PlacedWheel(self.wheel, self.radius, self.pose)
        points, _ = placed.surface(placed.locus(s), s)
        arc, _ = self.rail.project(points[:, 1:] - self.touch.travel * self.pose.vertical)
        return np.asarray(arc)


def wheel_points(
    wheel: WheelFlexibility, quadrature: Quadrature = "gauss", geometry: Geometry | None = None
) -> ContactPoints:
    """Contact points of a wheel.

    Parameters
    ----------
    wheel : WheelFlexibility
        Half of it, for a wheel centred on an upright rail, or the whole one.
    quadrature : {"gauss", "nodes"}
    geometry : Geometry, optional
        Of a whole wheel; the recipe's profiles, centred and upright, when not given.
    """
    recipe = wheel.recipe
    if recipe.symmetric:
        return contact_points(
            wheel.x,
            wheel.y,
            recipe.dimensions.radius,
            rail_profile(recipe.rail_profile),
            wheel_profile(recipe.profile),
            quadrature=quadrature,
        )
    g = geometry or Geometry.of(wheel)
    return placed_points(
        wheel.x, wheel.y, g.radius, g.rail, g.wheel, g.pose, g.touch, quadrature=quadrature
    )


def candidate_list(
    track: SolidTrack | UnreducedTrack, wheel: WheelFlexibility, geometry: Geometry | None = None
) -> CandidateList:
    """Search of the wheel's tread facets over the rail's running surface."""
    recipe = wheel.recipe
    if not recipe.symmetric:
        g = geometry or Geometry.of(wheel)
        return placed_candidates(wheel.x, wheel.y, g.radius, g.rail, g.wheel, g.pose, g.touch)
    rail, radius = rail_profile(recipe.rail_profile), recipe.dimensions.radius
    drop = rolling_drop(wheel.x, wheel_profile(recipe.profile).height(wheel.y), radius)
    reach = 1.5 * float(wheel.x[-1])
    y = track.surface_y
    top = np.broadcast_to(rail.running_surface(y), (2, len(y)))
    step = max(float(np.diff(wheel.x).max()), float(np.diff(y).max()))
    return CandidateList(
        FacetSearch(grid_surface(wheel.x, wheel.y, drop)),
        grid_surface(np.array([-reach, reach]), y, top),
        y,
        sagitta=step**2 / 8 * (1 / radius + 1 / rail.crown_radius),
    )


def mesh_problems(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility,
    points: ContactPoints,
    geometry: Geometry | None,
) -> list[str]:
    """What speaks against pressing this wheel on this rail."""
    half, recipe = track.recipe.symmetric, wheel.recipe
    problems = []
    if recipe.rail_profile != track.recipe.profile:
        problems.append(
            f"surface contact: the wheel was made for rail {recipe.rail_profile}, the track "
            f"has {track.recipe.profile}"
        )
    if half != recipe.symmetric:
        kinds = {True: "half", False: "whole"}
        problems.append(
            f"surface contact: the rail is a {kinds[half]} section, the wheel a "
            f"{kinds[recipe.symmetric]} one; both must be the same"
        )
    if recipe.symmetric and geometry is not None:
        problems.append("surface contact: a half section has no pose; mesh whole sections")
    slack = SLACK * float(np.diff(track.surface_arc).min())
    first, last = (-np.inf if half else track.surface_arc[0] - slack), track.surface_arc[-1] + slack
    if points.arc.min() < first or points.arc.max() > last:
        problems.append(
            f"wheel contact_half_width = {recipe.contact_half_width:.4g} m: its contact points "
            f"lie from {points.arc.min():.4g} to {points.arc.max():.4g} m of the rail's arc "
            "length, beyond the finely meshed running surface, "
            f"{track.surface_arc[0]:.4g} to {track.surface_arc[-1]:.4g} m"
        )
    return problems

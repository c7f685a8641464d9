"""A wheelset on two rails: the pose of each wheel, and the roll at which both touch.

Wheelset's axes for shift, yaw and roll: to the right, clockwise seen from above, right side down.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.validation import not_negative, positive, raise_if

Side = Literal["left", "right"]
SIDES: tuple[Side, ...] = ("left", "right")
_LARGEST_ROLL = 0.1


@dataclass(frozen=True, eq=False)
class Wheelset:
    """Two equal wheels on an axle over two equal rails.

    Parameters
    ----------
    wheel, rail : ProfileCurve
        Profiles, as seen from the track's centre for either side.
    radius : float
        Rolling radius at the tape circles [m].
    rail_inclination : float
        Of both rails towards the track's centre [rad].
    gauge, gauge_depth : float
        Distance of the rails' inner faces, measured so far below their tops [m].
    flange_backs, tape_line : float
        Distance between the flanges' backs, and of a tape circle outside its back [m].
    """

    wheel: ProfileCurve
    rail: ProfileCurve
    radius: float
    rail_inclination: float = math.atan(1 / 40)
    gauge: float = 1.435
    gauge_depth: float = 0.014
    flange_backs: float = 1.360
    tape_line: float = 0.070

    def __post_init__(self) -> None:
        raise_if(
            positive("wheel radius", self.radius, "m")
            + positive("gauge", self.gauge, "m")
            + positive("gauge depth", self.gauge_depth, "m")
            + positive("distance of the flange backs", self.flange_backs, "m")
            + not_negative("tape line", self.tape_line, "m")
        )

    @property
    def half(self) -> float:
        """Distance of a tape circle from the middle of the wheelset [m]."""
        return self.flange_backs / 2 + self.tape_line

    def gauge_point(self) -> float:
        """Y of the rail's inner face at the gauge's depth, from the crown, in track axes [m].

        Raises
        ------
        InputError
            If the rail's profile does not reach so deep.
        """
        from scipy.optimize import brentq, minimize_scalar

        rail, pose = self.rail, Pose(self.rail_inclination)

        def height(s: float) -> float:
            return float(pose.track_of_rail(rail.point(s))[1])

        found = minimize_scalar(
            lambda s: -height(s), bounds=(-0.02, 0.02), method="bounded", options={"xatol": 1e-12}
        )
        level = height(float(found.x)) - self.gauge_depth
        if height(rail.s_range[0]) > level:
            raise InputError(
                f"gauge depth = {self.gauge_depth:g} m: the profile {rail.name} does not reach so "
                "far below its top"
            )
        s = brentq(lambda s: height(s) - level, rail.s_range[0], float(found.x), xtol=1e-15)
        return float(pose.track_of_rail(rail.point(s))[0])

    def pose(self, side: Side, shift: float, yaw: float, roll: float) -> Pose:
        """Position of one wheel on its rail, Y to the field side.

        Parameters
        ----------
        side : {"left", "right"}
        shift, yaw, roll : float
            Of the wheelset [m, rad, rad].
        """
        sign = 1.0 if side == "right" else -1.0
        # tape circle's lowest point, from the middle of the wheelset: turned by roll, then by yaw
        y = sign * self.half * math.cos(roll) - self.radius * math.sin(roll)
        lateral = sign * (shift + y * math.cos(yaw)) - self.gauge / 2 + self.gauge_point()
        # Z is up here, and Y to the left on the left: turns change their signs
        return Pose(self.rail_inclination, lateral, -sign * roll, sign * yaw)

    def geometry(self, side: Side, shift: float, yaw: float, roll: float) -> Geometry:
        """One wheel in its pose on its rail; those of the last positions are remembered."""
        return _geometry(self, side, shift, yaw, roll)

    def rest_roll(self, shift: float, yaw: float) -> float:
        """Roll at which both wheels just touch their rails [rad].

        Raises
        ------
        NumericalError
            If there is none below 0.1 rad.
        """
        from scipy.optimize import brentq

        def misfit(roll: float) -> float:
            # heights of the axle's middle by either wheel: h = z_tape +- half sin(roll) + R cos
            down = {side: self.geometry(side, shift, yaw, roll).touch.travel for side in SIDES}
            travel = down["left"] - down["right"]
            return travel + 2.0 * self.half * math.sin(roll)

        start = misfit(0.0)
        if start == 0.0:
            return 0.0
        # from zero towards the root by growing steps, so that steep flanges are not jumped over
        low, step = 0.0, -math.copysign(max(abs(start) / (4.0 * self.half), 1e-9), start)
        while abs(low) < _LARGEST_ROLL:
            high = low + step
            if misfit(high) * start <= 0.0:
                return float(brentq(misfit, low, high, xtol=1e-10))
            low, step = high, 1.5 * step
        raise NumericalError(
            f"wheelset at a shift of {shift:g} m and a yaw of {yaw:g} rad: no roll below "
            f"{_LARGEST_ROLL} rad lets both wheels touch"
        )


@lru_cache(maxsize=1024)
def _geometry(wheelset: Wheelset, side: Side, shift: float, yaw: float, roll: float) -> Geometry:
    pose = wheelset.pose(side, shift, yaw, roll)
    return Geometry(wheelset.rail, wheelset.wheel, wheelset.radius, pose)

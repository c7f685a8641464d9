"""A wheelset on two rails: the pose of each wheel, and the roll at which both touch.

Wheelset's axes for shift, yaw and roll: to the right, clockwise seen from above, right side down.
"""

import math
import re
from dataclasses import dataclass, field, fields
from functools import lru_cache
from typing import Annotated, Any, Literal

from contactstudy.exceptions import InputError, NumericalError
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.units import UnitError
from contactstudy.validation import Parameters, Same, Written
from contactstudy.validation import quantities as q
from contactstudy.vehicle import WheelColumn

Side = Literal["left", "right"]
SIDES: tuple[Side, ...] = ("left", "right")
INCLINATION = math.atan(1 / 40)
_LARGEST_ROLL = 0.1
_RATIO = re.compile(r"\s*1\s*:\s*(\d+(?:\.\d+)?)\s*")


def _of_ratio(value: Any, unit: str) -> Any:
    """Angle of a ratio like "1:40"; anything else as it is."""
    if isinstance(value, str) and (match := _RATIO.fullmatch(value)):
        if float(match[1]) < 5:
            raise UnitError("must be 1:5 or flatter")
        return math.atan(1.0 / float(match[1]))
    return value


@dataclass(frozen=True)
class WheelsetDimensions(Parameters):
    """How two equal wheels on an axle fit over two equal rails."""

    rail_inclination: Annotated[
        q.SmallAngle, Written(_of_ratio, "a ratio like 1:40"), "of the rails, inwards"
    ] = INCLINATION
    gauge: Annotated[q.Length, "distance of the rails' inner faces"] = 1.435
    gauge_depth: Annotated[
        q.Length, "depth below the rails' tops at which the gauge is measured"
    ] = 0.014
    flange_backs: Annotated[
        q.Length, "distance between the backs of the flanges"
    ] = 1.360  # fmt: skip
    tape_line: Annotated[q.LengthOrZero, "distance of the tape circle from the flange's back"] = (
        0.070
    )


@dataclass(frozen=True, eq=False)
class Wheelset(WheelsetDimensions):
    """Two equal wheels on an axle over two equal rails, `radius` at the tape circles [m].

    The profiles are those seen from the track's centre for either side.
    """

    wheel: ProfileCurve = field(kw_only=True)
    rail: ProfileCurve = field(kw_only=True)
    radius: Annotated[float, Same(WheelColumn, "wheel_radius")] = field(kw_only=True)
    # each is itself: the dimensions' own, inherited, would leave out the profiles
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    @classmethod
    def of(
        cls, dimensions: WheelsetDimensions, wheel: ProfileCurve, rail: ProfileCurve, radius: float
    ) -> "Wheelset":
        """Wheelset of given dimensions."""
        values = {f.name: getattr(dimensions, f.name) for f in fields(WheelsetDimensions)}
        return cls(**values, wheel=wheel, rail=rail, radius=radius)

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
        """One wheel's position on its rail, Y to the field side, from the wheelset's [m, rad]."""
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

"""The table ``[wheelset]``: profiles, and where the wheel stands on its rail."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Any, Literal

import numpy as np

from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.wheelset import SIDES, Side, Wheelset, WheelsetDimensions
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import Ways, rail_curve, wheel_curve
from contactstudy.profiles.orientation import problems_of_ways
from contactstudy.validation import AtLeast, AtMost, File, Naming, Unit, raise_if
from contactstudy.validation import quantities as q

PATHS = ("wheel_profile", "rail_profile")
"""Keys that may hold a file's name instead of a profile's."""
ProfileWay = Literal["own", "to field", "to flange", "to gauge", "up", "down"]
_MAKERS = {"rail_profile": rail_curve, "wheel_profile": wheel_curve}
CLIMBED = math.atan(0.5)
"""Contact angle on the flange's tip below which a wheel counts as derailed: our limit.

Friction with a coefficient of 0.5, taken as an upper value for dry steel, holds a wheel on any
flatter slope.
"""
_FLANGE = math.radians(45)
_BESIDE = 0.05


@dataclass(frozen=True)
class ProfileFiles(WheelsetDimensions):
    """A wheelset whose profiles may be files, and where their axes point."""

    wheel_y: Annotated[ProfileWay, "where y points in the file of the wheel's profile"] = "own"
    wheel_z: Annotated[ProfileWay, "where z points in it"] = "own"
    rail_y: Annotated[ProfileWay, "where y points in the file of the rail's profile"] = "own"
    rail_z: Annotated[ProfileWay, "where z points in it"] = "own"

    @property
    def wheel_ways(self) -> Ways:
        """Where y and z of the wheel's file point."""
        return self.wheel_y, self.wheel_z

    @property
    def rail_ways(self) -> Ways:
        """Where y and z of the rail's file point."""
        return self.rail_y, self.rail_z

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value, axes only where they are stated."""
        return {k: v for k, v in super().resolved().items() if v != "own"}

    def problems(self, key: Naming) -> list[str]:
        """Axes that are none."""
        return [
            *problems_of_ways(self.wheel_ways, (key("wheel_y"), key("wheel_z"))),
            *problems_of_ways(self.rail_ways, (key("rail_y"), key("rail_z"))),
        ]


@dataclass(frozen=True)
class WheelsetPosition(ProfileFiles):
    """Profiles, and where the wheelset stands; used with ``solid.section = "whole"``.

    Shift, yaw and roll are those of the wheelset: to the right, clockwise seen from above, right
    side down; ``side`` is the wheel that is studied. The rail's surface is that of the rail which
    is meshed unless ``rail_profile`` names another one.
    """

    wheel_profile: Annotated[
        str, File(True), "S1002, cone, cylinder, or a CSV file with points"
    ] = "S1002"
    rail_profile: Annotated[
        str, File(True), "a profile or a CSV file; the meshed rail's if left out"
    ] = ""
    side: Annotated[Side, "which wheel"] = "right"
    lateral_shift: Annotated[
        float, Unit("m"), AtLeast(-0.05), AtMost(0.05), "of the wheelset, to the right"
    ] = 0.0
    yaw: Annotated[q.SmallAngle, "of the wheelset, clockwise seen from above"] = 0.0
    roll: Annotated[
        float | Literal["rest"], *q.SMALL_ANGLE, "right side down; at rest both wheels touch"
    ] = "rest"

    def curves(self, meshed_rail: str) -> tuple[ProfileCurve, ProfileCurve]:
        """Smooth profiles of rail and wheel."""
        rail, wheel = smooth_profiles(
            lambda name: f"wheelset.{name}",
            self,
            rail_profile=self.rail_profile or meshed_rail,
            wheel_profile=self.wheel_profile,
        )
        return rail, wheel

    def pose(self, rail: ProfileCurve, wheel: ProfileCurve, radius: float) -> Pose:
        """Position of the wheel on its rail.

        Raises
        ------
        InputError
            If the wheelset does not fit on the track, or has climbed a rail.
        """
        return _pose(self, rail, wheel, radius)


def smooth_profiles(key: Naming, files: ProfileFiles, **names: str) -> list[ProfileCurve]:
    """Profiles by ``rail_profile`` and ``wheel_profile``, in the order of these names.

    Raises
    ------
    InputError
        Naming each `key` whose profile does not exist or cannot be read.
    """
    problems, found = [], []
    for name, profile in names.items():
        try:
            ways = files.rail_ways if name == "rail_profile" else files.wheel_ways
            found.append(_MAKERS[name](profile, ways))
        except InputError as error:
            problems += [f"{key(name)}: {problem}" for problem in error.problems]
    raise_if(problems)
    return found


def problems_of(table: WheelsetPosition, meshed_rail: str, radius: float) -> list[str]:
    """What is wrong with profiles and position together."""
    try:
        table.pose(*table.curves(meshed_rail), radius)
    except InputError as error:
        return [p if p.startswith("wheelset") else f"wheelset: {p}" for p in error.problems]
    except ContactStudyError as error:
        return [f"wheelset: {error}"]
    return []


@lru_cache(maxsize=16)
def _pose(table: WheelsetPosition, rail: ProfileCurve, wheel: ProfileCurve, radius: float) -> Pose:
    wheelset = Wheelset.of(table, wheel, rail, radius)
    if beside := off_track(lambda name: f"wheelset.{name}", wheelset):
        raise InputError(beside)
    shift, yaw, roll = table.lateral_shift, table.yaw, table.roll
    at_rest = isinstance(roll, str)
    if isinstance(roll, str):
        roll = wheelset.rest_roll(shift, yaw)
    if climbed := derailed(wheelset, SIDES if at_rest else (table.side,), shift, yaw, roll):
        given = complaint_of_position("wheelset.lateral_shift", shift, yaw)
        raise InputError([f"{given}: {problem}" for problem in climbed])
    return wheelset.pose(table.side, shift, yaw, roll)


def complaint_of_position(key: str, shift: float, yaw: float) -> str:
    """Where a position is meant, e.g. "wheelset.lateral_shift = 40 mm with a yaw of 0 mrad"."""
    return f"{key} = {1e3 * shift:g} mm with a yaw of {1e3 * yaw:g} mrad"


def off_track(key: Naming, wheelset: Wheelset) -> list[str]:
    """Complaint about a wheelset that is too wide or too narrow for its track."""
    beside = wheelset.half - wheelset.gauge / 2 + wheelset.gauge_point()
    if abs(beside) <= _BESIDE:
        return []
    given = ", ".join(
        f"{key(name)} = {getattr(wheelset, name):g} m"
        for name in ("gauge", "flange_backs", "tape_line")
    )
    return [
        f"{given}: the tape circles of a centred wheelset lie "
        f"{1e3 * abs(beside):.4g} mm {'outside' if beside > 0 else 'inside'} the rails' crowns; "
        f"must be at most {1e3 * _BESIDE:g} mm"
    ]


def derailed(
    wheelset: Wheelset, sides: tuple[Side, ...], shift: float, yaw: float, roll: float
) -> list[str]:
    """Complaints about wheels that touch their rail with the tip or the back of the flange.

    ``sides`` are the wheels that touch; shift [m], yaw [rad] and roll [rad].
    """
    wheel = wheelset.wheel
    s = np.linspace(*wheel.s_range, 2001)
    normal = np.asarray(wheel.normal(s))
    slope = np.arctan2(normal[:, 0], -normal[:, 1]) * np.where(s < 0, 1.0, 0.0)
    if not slope.max() > _FLANGE:
        return []  # no flange
    steepest = float(s[np.argmax(slope)])
    problems = []
    for side in sides:
        touch = wheelset.geometry(side, shift, yaw, roll).touch
        if touch.wheel_s < steepest and touch.angle < CLIMBED:
            problems.append(
                f"the {side} wheel stands on its rail with the flange's tip (contact angle "
                f"{math.degrees(touch.angle):.1f} degrees, {-1e3 * touch.wheel_s:.1f} mm from the "
                f"tape circle): it has derailed; must be above {math.degrees(CLIMBED):.1f} degrees"
            )
    return problems

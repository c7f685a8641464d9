"""The table ``[wheelset]``: profiles, and where the wheel stands on its rail."""

from __future__ import annotations

import math
from typing import Literal

from contactstudy.contact.pose import Pose
from contactstudy.contact.wheelset import Wheelset
from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.profiles.curve import ProfileCurve, rail_curve, wheel_curve
from contactstudy.study import quantities as q
from contactstudy.study.section import Section

PATHS = ("wheel_profile", "rail_profile")
"""Keys that may hold a file's name instead of a profile's."""


class WheelsetTable(Section):
    """``[wheelset]``: used with ``solid.section = "whole"``.

    Shift, yaw and roll are those of the wheelset: to the right, clockwise seen from above, right
    side down; ``side`` is the wheel that is studied. The rail's surface is that of the rail which
    is meshed unless ``rail_profile`` names another one.
    """

    wheel_profile: str = "S1002"
    rail_profile: str = ""
    rail_inclination: q.Inclination = math.atan(1 / 40)
    side: Literal["left", "right"] = "right"
    lateral_shift: q.LateralShift = 0.0
    yaw: q.SmallAngle = 0.0
    roll: q.RestOrAngle = "rest"
    gauge: q.Length = 1.435
    gauge_depth: q.Length = 0.014
    flange_backs: q.Length = 1.360
    tape_line: q.LengthOrZero = 0.070

    def units(self) -> dict[str, str]:
        """Key -> SI unit."""
        found = super().units() | {"rail_inclination": "rad", "roll": "rad"}
        return found if self.roll != "rest" else {k: v for k, v in found.items() if k != "roll"}

    def curves(self, meshed_rail: str) -> tuple[ProfileCurve, ProfileCurve]:
        """Smooth profiles of rail and wheel.

        Raises
        ------
        InputError
            Naming the keys whose profile does not exist or cannot be read.
        """
        problems, found = [], []
        for key, make, name in (
            ("rail_profile", rail_curve, self.rail_profile or meshed_rail),
            ("wheel_profile", wheel_curve, self.wheel_profile),
        ):
            try:
                found.append(make(name))
            except InputError as error:
                problems += [f"wheelset.{key}: {problem}" for problem in error.problems]
        if problems:
            raise InputError(problems)
        return found[0], found[1]

    def pose(self, rail: ProfileCurve, wheel: ProfileCurve, radius: float) -> Pose:
        """Position of the wheel on its rail.

        Raises
        ------
        InputError
            If the wheelset does not fit on the track.
        """
        wheelset = Wheelset(
            wheel, rail, radius, self.rail_inclination, self.gauge, self.gauge_depth,
            self.flange_backs, self.tape_line,
        )  # fmt: skip
        roll = self.roll
        if isinstance(roll, str):
            roll = wheelset.rest_roll(self.lateral_shift, self.yaw)
        return wheelset.pose(self.side, self.lateral_shift, self.yaw, roll)


def problems_of(table: WheelsetTable, meshed_rail: str, radius: float) -> list[str]:
    """What is wrong with profiles and position together."""
    try:
        table.pose(*table.curves(meshed_rail), radius)
    except InputError as error:
        return [p if p.startswith("wheelset") else f"wheelset: {p}" for p in error.problems]
    except ContactStudyError as error:
        return [f"wheelset: {error}"]
    return []

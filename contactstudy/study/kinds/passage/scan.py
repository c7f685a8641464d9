"""The table ``[scan]``: scanned surfaces in place of the drawn ones, for the gap."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Any, Literal

from contactstudy.exceptions import InputError
from contactstudy.geometry.pose import Pose
from contactstudy.given_files import changed
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.orientation import Way, problems_of_ways
from contactstudy.profiles.outliers import LARGEST_RESIDUAL
from contactstudy.scans import Meeting, Scan, meeting, read_scan
from contactstudy.scans.reading import Ways3
from contactstudy.validation import (
    AtLeast,
    AtMost,
    File,
    Naming,
    Parameters,
    Unit,
    complaint,
    raise_if,
)
from contactstudy.validation import quantities as q

PATHS = ("rail", "wheel")
"""Keys that hold a file's name."""
LengthUnit = Literal["", "mm", "m", "cm", "um", "in"]


@dataclass(frozen=True)
class ScanFiles(Parameters):
    """``[scan]``: STL, PLY or OBJ files, X along the rail, Y to the field side, Z up.

    Files with other axes say where these point, e.g. ``wheel_z = "down"``; they are turned first.

    The gap is taken from the smooth surfaces that are fitted to the scans; the bodies that are
    meshed below them stay those of the drawn profiles. ``rail_middle`` and ``wheel_tape`` are Y in
    the scan of the rail's middle plane, half way along, and of the wheel's tape circle, at its
    lowest point.
    """

    rail: Annotated[str, File(), "scanned rail head"] = ""
    rail_unit: Annotated[LengthUnit, "length unit of that file"] = ""
    rail_x: Annotated[Way, "where x points in that file"] = "own"
    rail_y: Annotated[Way, "where y points in it"] = "own"
    rail_z: Annotated[Way, "where z points in it"] = "own"
    rail_middle: Annotated[q.Position, "Y of the rail's middle plane in the scan"] = 0.0
    wheel: Annotated[str, File(), "scanned tread"] = ""
    wheel_unit: Annotated[LengthUnit, "length unit of that file"] = ""
    wheel_x: Annotated[Way, "where x points in that file"] = "own"
    wheel_y: Annotated[Way, "where y points in it"] = "own"
    wheel_z: Annotated[Way, "where z points in it"] = "own"
    wheel_tape: Annotated[q.Position, "Y of the tape circle in the scan"] = 0.0
    smoothing: Annotated[
        float, Unit("m"), AtLeast(1e-5), AtMost(0.01), "least distance of the fitted curve's knots"
    ] = 1e-3
    residual_limit: Annotated[q.Length, "largest root mean square of the residual"] = (
        LARGEST_RESIDUAL
    )

    @property
    def used(self) -> bool:
        """Whether there is a scan at all."""
        return bool(self.rail or self.wheel)

    def problems(self, key: Naming) -> list[str]:
        """A file without its unit, and other keys without a file."""
        found = []
        for body, origin in (("rail", "rail_middle"), ("wheel", "wheel_tape")):
            file, unit = getattr(self, body), getattr(self, f"{body}_unit")
            if file and not unit:
                allowed = 'is missing; state the length unit of the file, e.g. "mm"'
                found.append(f"{key(f'{body}_unit')}: {allowed}")
            found += [
                complaint(key(name), getattr(self, name), f"applies only with {key(body)}")
                for name in (f"{body}_unit", origin, *(f"{body}_{axis}" for axis in "xyz"))
                if not file and self.given(name) and getattr(self, name)
            ]
            names = [key(f"{body}_{axis}") for axis in "xyz"]
            found += problems_of_ways(self.ways(body), names)
        if not self.used:
            found += [
                complaint(key(name), getattr(self, name), "applies only with a scan")
                for name in ("smoothing", "residual_limit")
                if self.given(name)
            ]
        return found

    def ways(self, body: str) -> Ways3:
        """Where x, y and z of a body's file point."""
        x, y, z = (getattr(self, f"{body}_{axis}") for axis in "xyz")
        return x, y, z

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value, axes only where they are stated."""
        return {k: v for k, v in super().resolved().items() if v != "own"}

    def surfaces(self) -> tuple[Scan | None, Scan | None]:
        """The scans of rail and wheel that there are.

        Raises
        ------
        InputError
            Listing everything that is wrong with either file.
        """
        found: list[Scan | None] = []
        problems: list[str] = []
        for body, origin in (("rail", self.rail_middle), ("wheel", self.wheel_tape)):
            file, unit = getattr(self, body), getattr(self, f"{body}_unit")
            try:
                scanned = (
                    file,
                    unit,
                    body,
                    origin,
                    self.smoothing,
                    self.residual_limit,
                    self.ways(body),
                )
                found.append(_read(changed(file), *scanned) if file else None)
            except InputError as error:
                problems += [f"scan.{body}: {problem}" for problem in error.problems]
        raise_if(problems)
        return found[0], found[1]

    def curves(self, rail: ProfileCurve, wheel: ProfileCurve) -> tuple[ProfileCurve, ProfileCurve]:
        """Profiles of rail and wheel, the fitted ones where there are scans."""
        if not self.used:
            return rail, wheel
        scans = self.surfaces()
        return (scans[0].curve if scans[0] else rail), (scans[1].curve if scans[1] else wheel)

    def touch(
        self,
        rail: ProfileCurve,
        wheel: ProfileCurve,
        radius: float,
        pose: Pose,
        half_length: float,
        half_width: float,
    ) -> Meeting:
        """First touch of the scans, and whether their facets cover the zone of contact.

        The drawn profiles serve for a body that is not scanned; for the rest see
        `contactstudy.scans.meeting`.

        Raises
        ------
        InputError
            If they never touch, have holes there, or the wheel's radius is another one.
        """
        scans = self.surfaces()
        if scans[1] is not None:
            fit = scans[1].fit
            # a hundredth of the radius, or what a short scan leaves open
            if abs(fit.radius - radius) > max(0.01 * radius, 4.0 * fit.radius_error):
                raise InputError(
                    f"vehicle.wheel_radius = {radius:g} m: the scan {scans[1].name} has "
                    f"{fit.radius:.4g} m at its tape circle"
                )
        try:
            return meeting(
                scans[0] or rail, scans[1] or wheel, radius, pose, half_length, half_width
            )
        except InputError as error:
            raise InputError([f"scan: {problem}" for problem in error.problems]) from error

    def fitted(self) -> dict[str, Any]:
        """What was fitted, as plain data in SI for the results."""
        values: dict[str, Any] = {}
        for body, scan in zip(PATHS, self.surfaces(), strict=True):
            if scan is not None:
                values[f"{body}_residual_rms"] = scan.fit.rms
                values[f"{body}_residual_largest"] = scan.fit.largest
                values[f"{body}_points"] = scan.fit.points
        return values


@lru_cache(maxsize=8)
def _read(changed: int, *scanned: Any) -> Scan:
    """A scan; of a file that has changed it is read again."""
    return read_scan(*scanned)

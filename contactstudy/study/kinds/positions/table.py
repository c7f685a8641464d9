"""Studies of a wheelset pressed on its rails at given positions: the table ``[positions]``."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from contactstudy.exceptions import InputError, gathered
from contactstudy.geometry.wheelset import SIDES, Side, Wheelset
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.profiles.wheel_file import named_file_digest
from contactstudy.study.axes.series import by_step
from contactstudy.study.kinds.passage.wheelset import (
    PATHS,
    ProfileFiles,
    WheelsetPosition,
    off_track,
    smooth_profiles,
)
from contactstudy.study.overrides import Overrides, override
from contactstudy.study.study import Study, read_texts
from contactstudy.track.rail import Rail
from contactstudy.units import UnitError, to_si
from contactstudy.validation import (
    AtLeast,
    AtMost,
    File,
    Key,
    Naming,
    Same,
    Unit,
    Written,
    asked,
    listed,
    raise_if,
    read,
    resolve_paths,
    units,
    unknown,
)
from contactstudy.validation import quantities as q
from contactstudy.vehicle import WheelColumn

_RANGE = re.compile(r"(.+?)\s+to\s+(.+?)\s+by\s+(.+)")
_MOST = 1001
_TOP_LEVEL = ("title", "description", "positions")


def _series(value: Any, unit: str) -> Any:
    """List of one quantity, or of "0 mm to 10 mm by 0.5 mm"; a list, or "rest", as it is."""
    if isinstance(value, str) and (match := _RANGE.fullmatch(value.strip())):
        first, last, step = (to_si(part, unit) for part in match.groups())
        return [float(f"{x:.12g}") for x in by_step(first, last, step, _MOST)]
    if not (given := listed(value)):
        raise UnitError("must hold at least one value")
    return given


SERIES = Written(_series)


@dataclass(frozen=True)
class Positions(ProfileFiles):
    """``[positions]``: a wheelset, its rails, where it stands, and the load on each wheel."""

    wheels: Annotated[tuple[Side, ...], "which wheels are pressed"] = SIDES
    lateral: Annotated[
        tuple[float, ...], Unit("m"), AtLeast(-0.1), AtMost(0.1), SERIES,
        "lateral shifts of the wheelset, to the right",
    ] = (0.0,)  # fmt: skip
    yaw: Annotated[
        tuple[float, ...], *q.SMALL_ANGLE, SERIES, "one for all or for each, clockwise from above"
    ] = (0.0,)
    roll: Annotated[
        Literal["rest"] | tuple[float, ...], *q.SMALL_ANGLE, SERIES,
        "right side down, one for all or for each; at rest both wheels touch",
    ] = "rest"  # fmt: skip
    load: Annotated[q.Force, "vertical load on each wheel"] = 67.4e3
    wheel_profile: Annotated[str, Same(WheelsetPosition, "wheel_profile")] = "S1002"
    rail_profile: Annotated[str, File(True), "profile, or a CSV file with points"] = "60E1"
    wheel_radius: Annotated[float, Same(WheelColumn, "wheel_radius")] = WheelColumn.wheel_radius
    origin: Annotated[
        q.Position, "Y of the rail's crown that lateral positions are measured from"
    ] = 0.0
    youngs_modulus: Annotated[float, Same(Rail, "youngs_modulus")] = Rail.youngs_modulus
    poisson_ratio: Annotated[float, Same(Rail, "poisson_ratio")] = Rail.poisson_ratio
    cell: Annotated[
        float, Unit("m"), AtLeast(2e-5), AtMost(1e-3), "side of the half-spaces' cells"
    ] = 0.2e-3

    def problems(self, key: Naming) -> list[str]:
        """Series of unequal lengths, and wheels named twice."""
        wrong_ways = super().problems(key)
        problems = wrong_ways + asked(self._unequal, key) + asked(self._not_once, key)
        return problems + ([] if wrong_ways else asked(self._misfits, key))

    def _misfits(self, key: Naming) -> list[str]:
        problems = list[str]()
        with gathered(problems):
            self._wheelset(key)
        return problems

    def _unequal(self, key: Naming) -> list[str]:
        n = len(self.lateral)
        return [
            f"{key(name)}: has {len(values)} values; must have one, or one for each of the "
            f"{n} of {key('lateral')}"
            for name in ("yaw", "roll")
            if not isinstance(values := getattr(self, name), str) and len(values) not in (1, n)
        ]

    def _not_once(self, key: Naming) -> list[str]:
        if self.wheels and len(set(self.wheels)) == len(self.wheels):
            return []
        return [f'{key("wheels")}: must name "left", "right" or both, once each']

    @property
    def wheelset(self) -> Wheelset:
        """The wheelset on its track, with its profiles."""
        return self._wheelset(lambda name: name)

    def _wheelset(self, key: Naming) -> Wheelset:
        profiles = {name: getattr(self, name) for name in PATHS}
        wheel, rail = smooth_profiles(key, self, **profiles)
        made = Wheelset.of(self, wheel, rail, self.wheel_radius)
        try:
            beside = off_track(key, made)
        except InputError as error:
            beside = [f"{key('gauge_depth')}: {problem}" for problem in error.problems]
        raise_if(beside)
        return made


@dataclass(frozen=True)
class PositionsStudy(Study):
    """A study of positions that has been read and found possible."""

    kind: ClassVar[str] = "positions"

    companions: Annotated[tuple[str, ...], Key("")] = ()
    table: Positions = field(default_factory=Positions)

    @cached_property
    def wheelset(self) -> Wheelset:
        """The wheelset on its track, with its profiles."""
        return self.table.wheelset

    @property
    def positions(self) -> list[tuple[float, float, float | None]]:
        """Lateral shift [m], yaw [rad] and roll [rad] of each; None: the roll at rest."""
        t = self.table
        n = len(t.lateral)
        rolls: tuple[float | None, ...] = (None,) * n
        if not isinstance(t.roll, str):
            rolls = t.roll * (n if len(t.roll) == 1 else 1)
        return list(zip(t.lateral, t.yaw * (n if len(t.yaw) == 1 else 1), rolls, strict=True))

    @property
    def modulus(self) -> float:
        """E* of two equal bodies [Pa]."""
        return contact_modulus(self.table.youngs_modulus, self.table.poisson_ratio)

    def config(self) -> dict[str, Any]:
        """Table as plain data in SI; of paths the file's name only."""
        values = self.table.resolved()
        return {"positions": {k: Path(v).name if k in PATHS else v for k, v in values.items()}}

    def units(self) -> dict[str, str]:
        """Dotted key of `config` -> SI unit."""
        found = units(Positions, self.table.resolved())
        return {f"positions.{key}": unit for key, unit in found.items()}

    def files(self) -> dict[str, str]:
        """Name of each profile's file -> SHA-256 of its content."""
        names = [getattr(self.table, key) for key in PATHS]
        return {Path(n).name: found for n in names if (found := named_file_digest(n))}


def load_positions(
    path: Path, data: dict[str, Any], overrides: Overrides = (), main: Any = None
) -> PositionsStudy:
    """Check the content of a study file that has a table ``[positions]``; overridden in place.

    Raises
    ------
    InputError
        Listing every problem.
    """
    resolve_paths(Positions, data["positions"], path.parent)
    found = override(data, overrides, {"positions": Positions})
    found += [unknown("", key, _TOP_LEVEL) for key in data if key not in _TOP_LEVEL]
    texts, wrong_texts = read_texts(data)
    table, wrong = read(Positions, data["positions"], "positions")
    raise_if(found + wrong_texts + wrong)
    return PositionsStudy(path.stem, **texts, table=table)

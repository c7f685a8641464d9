"""Studies of a wheelset pressed on its rails at given positions: the table ``[positions]``."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ValidationError

from contactstudy.exceptions import InputError
from contactstudy.geometry.wheelset import Wheelset
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.study import quantities as q
from contactstudy.study.kinds.passage.wheelset import PATHS, off_track
from contactstudy.study.loading import find_study
from contactstudy.study.messages import complaint, from_validation, unknown
from contactstudy.study.overrides import override
from contactstudy.study.paths import resolve_paths
from contactstudy.study.section import Section
from contactstudy.units import Limits, UnitError, to_si

_RANGE = re.compile(r"(.+?)\s+to\s+(.+?)\s+by\s+(.+)")
_MOST = 1001
_TOP_LEVEL = ("title", "description", "positions")


@dataclass(frozen=True)
class Series(Limits):
    """Reads one quantity, a list of them, or "0 mm to 10 mm by 0.5 mm", each within limits."""

    def __call__(self, value: Any) -> tuple[float, ...]:  # type: ignore[override]
        """SI values; `UnitError` with what is allowed otherwise."""
        if isinstance(value, str) and (match := _RANGE.fullmatch(value.strip())):
            first, last, step = (to_si(part, self.unit) for part in match.groups())
            count = (last - first) / step if step else math.inf
            if not 0 <= count <= _MOST - 1 or abs(count - round(count)) > 1e-6:
                raise UnitError(
                    f"must lead from the first to the last value in whole steps, {_MOST} at most"
                )
            value = [float(f"{first + k * step:.12g}") for k in range(round(count) + 1)]
        values = value if isinstance(value, list | tuple) else [value]
        if not values:
            raise UnitError("must hold at least one value")
        one = Limits.__call__
        return tuple(float(one(self, v)) for v in values)


def _rest_or(series: Series) -> Callable[[Any], Any]:
    def read(value: Any) -> Any:
        return value if value == "rest" else series(value)

    return read


_ANGLE = Series("rad", at_least=-0.2, at_most=0.2)
Lengths = Annotated[tuple[float, ...], BeforeValidator(Series("m", at_least=-0.1, at_most=0.1))]
Angles = Annotated[tuple[float, ...], BeforeValidator(_ANGLE)]
Rolls = Annotated[Literal["rest"] | tuple[float, ...], BeforeValidator(_rest_or(_ANGLE))]
CellSide = Annotated[float, BeforeValidator(Limits("m", at_least=2e-5, at_most=1e-3))]


class PositionsTable(Section):
    """``[positions]``: a wheelset, its rails, where it stands, and the load on each wheel."""

    wheels: tuple[Literal["left", "right"], ...] = ("left", "right")
    lateral: Lengths = (0.0,)
    yaw: Angles = (0.0,)
    roll: Rolls = "rest"
    load: q.Force = 67.4e3
    wheel_profile: str = "S1002"
    rail_profile: str = "60E1"
    wheel_radius: q.Length = 0.43
    rail_inclination: q.Inclination = math.atan(1 / 40)
    gauge: q.Length = 1.435
    gauge_depth: q.Length = 0.014
    flange_backs: q.Length = 1.360
    tape_line: q.LengthOrZero = 0.070
    origin: q.Position = 0.0
    youngs_modulus: q.Modulus = 210e9
    poisson_ratio: q.Ratio = 0.3
    cell: CellSide = 0.2e-3

    def units(self) -> dict[str, str]:
        """Key -> SI unit."""
        return (
            super().units()
            | {"rail_inclination": "rad"}
            | ({} if self.roll == "rest" else {"roll": "rad"})
        )


@dataclass(frozen=True)
class PositionsStudy:
    """A study of positions that has been read and found possible.

    Attributes
    ----------
    name, title, description : str
    table : PositionsTable
    wheelset : Wheelset
        With the profiles of the table.
    """

    name: str
    title: str
    description: str
    table: PositionsTable
    wheelset: Wheelset

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
        return {k: Path(v).name if k in PATHS else v for k, v in values.items()}


def load_positions(study: str | Path, overrides: Iterable[str] = ()) -> PositionsStudy | None:
    """Read a study file that has a table ``[positions]``; None if it has none.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    overrides : iterable of str
        ``positions.key=value``.

    Raises
    ------
    InputError
        Listing every problem of such a file. Other files are left to `load_study`.
    """
    path = find_study(study)
    try:
        data = tomllib.loads(path.read_text("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError):
        return None  # `load_study` says what is wrong
    if "positions" not in data:
        return None
    resolve_paths(data["positions"], PATHS, path.parent, or_name=True)
    problems = override(data, overrides, {"positions": PositionsTable})
    return _parsed(path.stem, data, problems)


def _parsed(name: str, data: Mapping[str, Any], problems: list[str]) -> PositionsStudy:
    found = problems + [unknown("", key, _TOP_LEVEL) for key in data if key not in _TOP_LEVEL]
    title, description = data.get("title", name), data.get("description", "")
    found += [
        complaint(key, value, "must be text")
        for key, value in (("title", title), ("description", description))
        if not isinstance(value, str)
    ]
    table, wheelset = None, None
    if not isinstance(data["positions"], Mapping):
        found.append(complaint("positions", data["positions"], "must be a table"))
    else:
        try:
            table = PositionsTable.model_validate(data["positions"])
        except ValidationError as error:
            found += from_validation(error, PositionsTable, "positions")
    if table is not None:
        found += _lengths(table)
        wheelset, wrong = _wheelset(table)
        found += wrong
    if found or table is None or wheelset is None:
        raise InputError(found)
    return PositionsStudy(name, title, description, table, wheelset)


def _lengths(table: PositionsTable) -> list[str]:
    n = len(table.lateral)
    problems = [
        f"positions.{key}: has {len(values)} values; must have one, or one for each of the "
        f"{n} of positions.lateral"
        for key in ("yaw", "roll")
        if not isinstance(values := getattr(table, key), str) and len(values) not in (1, n)
    ]
    if not table.wheels or len(set(table.wheels)) < len(table.wheels):
        problems.append('positions.wheels: must name "left", "right" or both, once each')
    return problems


def _wheelset(table: PositionsTable) -> tuple[Wheelset | None, list[str]]:
    problems: list[str] = []

    def curve(key: str, make: Callable[[str], ProfileCurve]) -> ProfileCurve | None:
        try:
            return make(getattr(table, key))
        except InputError as error:
            problems.extend(f"positions.{key}: {problem}" for problem in error.problems)
            return None

    wheel, rail = curve("wheel_profile", wheel_curve), curve("rail_profile", rail_curve)
    if wheel is None or rail is None:
        return None, problems
    t = table
    made = Wheelset(
        wheel, rail, t.wheel_radius, t.rail_inclination, t.gauge, t.gauge_depth, t.flange_backs,
        t.tape_line,
    )  # fmt: skip
    try:
        return made, off_track("positions", made)
    except InputError as error:
        return None, [f"positions.gauge_depth: {problem}" for problem in error.problems]

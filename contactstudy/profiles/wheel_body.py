"""Rim, web and hub of a wheel: its cross-section but for the tread."""

import hashlib
import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.resources import resource
from contactstudy.validation import raise_if

DEFAULT = "straight_860"
"""The shipped wheel."""

# table, key -> field; lengths in mm, diameters are halved
_NUMBERS = {
    ("", "tread_diameter"): ("radius", 0.5e-3),
    ("", "bore_diameter"): ("bore_radius", 0.5e-3),
    ("rim", "inside"): ("rim_inside", 1e-3),
    ("rim", "outside"): ("rim_outside", 1e-3),
    ("rim", "thickness"): ("rim_thickness", 1e-3),
    ("hub", "inside"): ("hub_inside", 1e-3),
    ("hub", "outside"): ("hub_outside", 1e-3),
    ("hub", "diameter"): ("hub_radius", 0.5e-3),
}
_LISTS = {
    ("web", "station"): ("web_station", 1.0),
    ("web", "offset"): ("web_offset", 1e-3),
    ("web", "thickness"): ("web_thickness", 1e-3),
}
_TEXTS = ("name", "source")
_TABLES = ("rim", "web", "hub")


@dataclass(frozen=True)
class WheelDimensions:
    """Dimensions of a wheel; the defaults are those of ``meshes/wheels/straight_860.toml``.

    y from the tape circle, positive to the field side.

    Attributes
    ----------
    radius : float
        Of the tape circle in m.
    rim_inside, rim_outside : float
        y of the faces of the rim in m; inside is the back of the flange.
    rim_thickness : float
        In m; the rim reaches from ``radius - rim_thickness`` to the tread.
    web_station : tuple of float
        Places along the web from 0 (hub) to 1 (rim), increasing.
    web_offset, web_thickness : tuple of float
        Middle line's y and the thickness there in m, linear between.
    hub_inside, hub_outside : float
        y of the faces of the hub in m.
    hub_radius, bore_radius : float
        In m.
    """

    radius: float = 0.430
    rim_inside: float = -0.070
    rim_outside: float = 0.065
    rim_thickness: float = 0.060
    web_station: tuple[float, ...] = (0.0, 1.0)
    web_offset: tuple[float, ...] = (0.0, 0.0)
    web_thickness: tuple[float, ...] = (0.025, 0.025)
    hub_inside: float = -0.090
    hub_outside: float = 0.090
    hub_radius: float = 0.130
    bore_radius: float = 0.095

    def __post_init__(self) -> None:
        """Refuse dimensions that make no wheel; all problems at once."""
        raise_if(_problems(self))

    @property
    def inner_radius(self) -> float:
        """Radius at which the rim ends and the web begins [m]."""
        return self.radius - self.rim_thickness

    @property
    def rim_width(self) -> float:
        """Width of the rim [m]."""
        return self.rim_outside - self.rim_inside

    @property
    def hub_width(self) -> float:
        """Width of the hub [m]."""
        return self.hub_outside - self.hub_inside

    def web(self, rho: ArrayLike) -> tuple[Array, Array]:
        """Faces of the web (y inside, y outside) at distances `rho` from the axis [m]."""
        at = (np.asarray(rho, dtype=float) - self.hub_radius) / (
            self.inner_radius - self.hub_radius
        )
        middle = np.interp(at, self.web_station, self.web_offset)
        half = 0.5 * np.interp(at, self.web_station, self.web_thickness)
        return middle - half, middle + half

    def with_radius(self, radius: float) -> "WheelDimensions":
        """Same rim and hub on a web that is longer or shorter."""
        return replace(self, radius=radius)


def _problems(d: WheelDimensions) -> list[str]:
    numbers = {k: v for k, v in vars(d).items() if not isinstance(v, tuple)}
    lists = {k: v for k, v in vars(d).items() if isinstance(v, tuple)}
    infinite = [k for k, v in numbers.items() if not math.isfinite(v)]
    infinite += [k for k, v in lists.items() if not np.all(np.isfinite(v))]
    if infinite:
        return [f"wheel {name} = {vars(d)[name]}: must be finite" for name in infinite]
    problems = [
        f"wheel {name} = {numbers[name]:.6g} m: must be positive"
        for name in ("radius", "rim_thickness", "hub_radius", "bore_radius")
        if not numbers[name] > 0
    ]
    if not d.bore_radius < d.hub_radius < d.inner_radius:
        problems.append(
            f"wheel: bore_radius ({d.bore_radius:.6g} m) < hub_radius ({d.hub_radius:.6g} m) < "
            f"radius - rim_thickness ({d.inner_radius:.6g} m) is required"
        )
    for part in ("rim", "hub"):
        inside, outside = numbers[f"{part}_inside"], numbers[f"{part}_outside"]
        if not inside < 0 < outside:
            problems.append(
                f"wheel {part}: its faces at y = {inside:.6g} and {outside:.6g} m must lie on "
                "both sides of the tape circle (y = 0), the inside one first"
            )
    stations = d.web_station
    if not len(stations) == len(d.web_offset) == len(d.web_thickness) >= 2:
        problems.append(
            f"wheel web: station ({len(stations)} values), offset ({len(d.web_offset)}) and "
            f"thickness ({len(d.web_thickness)}) must be equally many, two or more"
        )
        return problems
    if stations[0] != 0 or stations[-1] != 1 or np.any(np.diff(stations) <= 0):
        problems.append(f"wheel web station = {list(stations)}: must increase from 0 to 1")
    thickness = np.array(d.web_thickness)
    if np.any(thickness <= 0):
        problems.append(f"wheel web_thickness = {list(d.web_thickness)} m: must be positive")
    low, high = np.array(d.web_offset) - 0.5 * thickness, np.array(d.web_offset) + 0.5 * thickness
    for part, k in (("hub", 0), ("rim", -1)):
        inside, outside = numbers[f"{part}_inside"], numbers[f"{part}_outside"]
        if not inside < low[k] < high[k] < outside:
            problems.append(
                f"wheel web at the {part}: from y = {low[k]:.6g} to {high[k]:.6g} m, must lie "
                f"within the {part}, {inside:.6g} to {outside:.6g} m"
            )
    return problems


def wheel_dimensions(section: str = DEFAULT) -> WheelDimensions:
    """Dimensions of a wheel from its cross-section file.

    Parameters
    ----------
    section : str
        Name of a shipped wheel, or the path of a file like ``meshes/wheels/straight_860.toml``.

    Returns
    -------
    WheelDimensions

    Raises
    ------
    InputError
        Listing everything that is wrong with the file.
    """
    path = Path(section)
    if path.suffix != ".toml":
        shipped = wheel_sections()
        if section not in shipped:
            raise InputError(
                f"wheel section '{section}' is unknown; allowed: {', '.join(sorted(shipped))}, or "
                "a file ending in .toml"
            )
        path = shipped[section]
    try:
        content = path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(f"wheel section {section}: cannot be read ({reason})") from error
    return _parsed(section, content)


def wheel_sections() -> dict[str, Path]:
    """Name -> file of the wheels that come with the program."""
    return {path.stem: path for path in sorted(resource("meshes", "wheels").glob("*.toml"))}


def file_digest(path: str) -> str:
    """SHA-256 of a file's content; "" if there is no such file (a shipped name)."""
    file = Path(path)
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


@lru_cache(maxsize=8)
def _parsed(section: str, content: bytes) -> WheelDimensions:
    try:
        data = tomllib.loads(content.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"wheel section {section}: is not TOML ({error})") from error
    values, problems = _values(data)
    if not problems:
        try:
            return WheelDimensions(**values)
        except InputError as error:
            problems = list(error.problems)
    raise InputError([f"wheel section {section}: {problem}" for problem in problems])


def _values(data: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Fields of `WheelDimensions` in m, and what is wrong with the file."""
    tables: dict[str, Mapping[str, Any]] = {"": {k: v for k, v in data.items() if k not in _TABLES}}
    problems, values = [], dict[str, Any]()
    for name in _TABLES:
        table = data.get(name, {})
        if not isinstance(table, Mapping):
            problems.append(f"{name} = {table!r}: must be a table [{name}]")
            table = {}
        tables[name] = table
    known = [*_NUMBERS, *_LISTS, *(("", text) for text in _TEXTS)]
    for name, table in tables.items():
        allowed = [key for where, key in known if where == name]
        problems += [
            f"{_dotted(name, key)}: unknown key; allowed: {', '.join(allowed)}"
            for key in table
            if key not in allowed
        ]
    for (name, key), (field, factor) in (_NUMBERS | _LISTS).items():
        dotted, unit = _dotted(name, key), "" if key == "station" else " in mm"
        if key not in tables[name]:
            problems.append(f"{dotted}: is missing; a value{unit} is needed")
            continue
        value, many = tables[name][key], (name, key) in _LISTS
        items = value if many and isinstance(value, list) else [value]
        if many != isinstance(value, list) or not all(_is_number(v) for v in items):
            wanted = f"a list of numbers{unit}" if many else f"a number{unit}"
            problems.append(f"{dotted} = {value!r}: must be {wanted}")
            continue
        scaled = tuple(factor * float(v) for v in items)
        values[field] = scaled if many else scaled[0]
    return values, problems


def _dotted(table: str, key: str) -> str:
    return f"{table}.{key}" if table else key


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)

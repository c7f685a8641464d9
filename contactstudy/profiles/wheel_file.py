"""Cross-section files of wheels, like ``meshes/wheels/straight_860.toml``."""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.given_files import (
    changed,
    content_digest,
    is_file,
    named_file,
    toml_file,
)
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.resources import shipped

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


def wheel_dimensions(section: str = DEFAULT) -> WheelDimensions:
    """Dimensions of a wheel from its cross-section file.

    The name of a shipped wheel, or the path of a file like ``meshes/wheels/straight_860.toml``.

    Raises
    ------
    InputError
        Listing everything that is wrong with the file.
    """
    path = named_file(section, wheel_sections(), "wheel section")
    return _read(section, path, changed(path))


@lru_cache(maxsize=8)
def _read(section: str, path: Path, changed: int) -> WheelDimensions:
    """Dimensions from a file as it was `changed` last."""
    values, problems = _values(toml_file(path))
    if not problems:
        try:
            return WheelDimensions(**values)
        except InputError as error:
            problems = list(error.problems)
    raise InputError([f"wheel section {section}: {problem}" for problem in problems])


def wheel_sections() -> dict[str, Path]:
    """Name -> file of the wheels that come with the program."""
    return shipped("meshes", "wheels")


def named_file_digest(path: str) -> str:
    """SHA-256 of a file's content; "" if there is no such file (a shipped name)."""
    return content_digest(path) if is_file(path) else ""


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

"""Keys of a study that the command line, or a caller from Python, overrides."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from copy import deepcopy
from typing import Any

from contactstudy.validation import Table, entries

Overrides = Iterable[str] | Mapping[str, Any]
"""``key=value`` as on a command line, or dotted key -> value as in a study file.

Values as in TOML; on a command line quotes around text may be left out.
"""


def override(
    data: dict[str, Any],
    values: Overrides,
    tables: Mapping[str, Table],
    groups: Mapping[str, Table] | None = None,
) -> list[str]:
    """Set dotted keys of a study file's content, in place.

    A key of the file that means nothing beside an overridden one (the seed, once the spectrum
    is "smooth") is left out; one that was itself overridden stays, to be complained about.

    `tables` are those of the file, `groups` tables in tables, "runs" for ``[runs.NAME]``. Returns
    complaints.
    """
    groups = groups or {}
    values, problems = read_texts(values, "--set", tables, groups)
    for key, value in values.items():
        problems += _put(data, key, value)
    given = set(values)
    for name, table in tables.items():
        _leave_out(data.get(name), table, name, given)
    for group, table in groups.items():
        members = data.get(group)
        for name, member in members.items() if isinstance(members, dict) else ():
            _leave_out(member, table, f"{group}.{name}", given)
    return problems


def flat(tables: Mapping[str, Any], path: str = "") -> dict[str, Any]:
    """Dotted key -> value of nested tables."""
    found: dict[str, Any] = {}
    for key, value in tables.items():
        full = f"{path}.{key}" if path else key
        found |= flat(value, full) if isinstance(value, dict) else {full: value}
    return found


def _leave_out(data: Any, table: Table, path: str, given: set[str]) -> None:
    """Take keys out of a table whose overridden deciding key does not let them apply."""
    for key, entry in entries(table).items() if isinstance(data, dict) else ():
        if (
            key in data
            and f"{path}.{key}" not in given
            and any(
                f"{path}.{decider}" in given and data.get(decider) not in values
                for decider, values in entry.conditions
            )
        ):
            del data[key]


def read_texts(
    given: Overrides, option: str, tables: Mapping[str, Table], groups: Mapping[str, Table]
) -> tuple[dict[str, Any], list[str]]:
    """Values of dotted keys that an option of the command line, or a mapping, gives."""
    if isinstance(given, Mapping):
        good = {k: v for k, v in given.items() if isinstance(k, str) and all(k.split("."))}
        return good, [
            f"{key!r}: must be a dotted key, e.g. 'journey.speed'"
            for key in given
            if key not in good
        ]
    values, problems = dict[str, Any](), []
    for text in given:
        key, equals, written = (part.strip() for part in text.partition("="))
        parts = key.split(".")
        if not equals or not all(parts):
            problems.append(
                f"{option} {text}: must be KEY=VALUE with a dotted key, "
                "e.g. journey.speed='250 km/h'"
            )
            continue
        value = _value(written)
        found = (tables if len(parts) == 2 else groups).get(parts[0])
        if found is not None and not isinstance(value, str):
            entry = entries(found).get(parts[-1])
            if entry is not None and entry.parameter.only_text:
                value = written  # 60E1 is a profile, not 600
        if key in values:
            problems.append(f"{option} {text}: {key} is given twice; give it once")
        values[key] = value
    return values, problems


def _put(data: dict[str, Any], key: str, value: Any) -> list[str]:
    *path, last = key.split(".")
    for part in path:
        data = data.setdefault(part, {})
        if not isinstance(data, dict):
            return [f"{key}: goes through a value that is no table"]
    data[last] = list(value) if isinstance(value, tuple) else deepcopy(value)
    return []


def _value(text: str) -> Any:
    """Read `text` as a TOML value, else take it, or what stands in its brackets, as text."""
    try:
        parsed = tomllib.loads(f"value = {text}")
    except RecursionError:
        return text  # more brackets than any value has
    except ValueError:  # no TOML, or a number of thousands of digits
        if text.startswith("[") and text.endswith("]"):
            return [_value(part.strip()) for part in text[1:-1].split(",")]
        return text
    return parsed["value"] if list(parsed) == ["value"] else text

"""Keys of a study that the command line overrides."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from typing import Any

from contactstudy.validation import Table, entries


def override(
    data: dict[str, Any],
    texts: Iterable[str],
    tables: Mapping[str, Table],
    groups: Mapping[str, Table] | None = None,
) -> list[str]:
    """Set dotted keys of a study file's content, in place.

    A key of the file that means nothing beside an overridden one (the seed, once the spectrum
    is "smooth") is left out; one that was itself overridden stays, to be complained about.

    Parameters
    ----------
    data : dict
        Content as TOML gives it.
    texts : iterable of str
        ``key=value``; values as in TOML, quotes around text may be left out.
    tables : mapping of str to type of Parameters or Variants
        The tables of the file.
    groups : mapping, optional
        The same for tables in tables, "runs" for ``[runs.NAME]``.

    Returns
    -------
    list of str
        Complaints.
    """
    problems, given = [], set()
    for text in texts:
        problems += _override(data, text, tables, groups or {})
        given.add(text.partition("=")[0].strip())
    for name, table in tables.items():
        _leave_out(data.get(name), table, name, given)
    for group, table in (groups or {}).items():
        members = data.get(group)
        for name, member in members.items() if isinstance(members, dict) else ():
            _leave_out(member, table, f"{group}.{name}", given)
    return problems


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


def _override(
    data: dict[str, Any], text: str, tables: Mapping[str, Table], groups: Mapping[str, Table]
) -> list[str]:
    key, equals, value = text.partition("=")
    parts = key.strip().split(".")
    if not equals or not all(parts):
        return [f"--set {text}: must be KEY=VALUE with a dotted key, e.g. journey.speed='250 km/h'"]
    table = data
    for part in parts[:-1]:
        table = table.setdefault(part, {})
        if not isinstance(table, dict):
            return [f"--set {text}: {key.strip()} goes through a value that is no table"]
    read = _value(value.strip())
    found = (tables if len(parts) == 2 else groups).get(parts[0])
    if found is not None and not isinstance(read, str):
        entry = entries(found).get(parts[-1])
        if entry is not None and entry.parameter.only_text:
            read = value.strip()  # 60E1 is a profile, not 600
    table[parts[-1]] = read
    return []


def _value(text: str) -> Any:
    """Read `text` as a TOML value, else take it as the text itself."""
    try:
        parsed = tomllib.loads(f"value = {text}")
    except tomllib.TOMLDecodeError:
        return text
    return parsed["value"] if list(parsed) == ["value"] else text

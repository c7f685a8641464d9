"""Keys of a study that the command line overrides."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from typing import Any, Literal, get_args, get_origin

from contactstudy.study.kinds.passage.schema import SECTIONS, SOLVERS
from contactstudy.study.section import Section


def override(
    data: dict[str, Any], texts: Iterable[str], tables: Mapping[str, type[Section]] = SECTIONS
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
    tables : mapping of str to type of Section
        The tables of the file.

    Returns
    -------
    list of str
        Complaints.
    """
    problems, given = [], set()
    for text in texts:
        problems += _override(data, text, tables)
        given.add(text.partition("=")[0].strip())
    for name, section in tables.items():
        _leave_out(data.get(name), section, name, given)
    runs = data.get("runs")
    for name, run in runs.items() if isinstance(runs, dict) else ():
        if isinstance(run, dict) and run.get("solver") in SOLVERS:
            _leave_out(run, SOLVERS[run["solver"]], f"runs.{name}", given)
    return problems


def _leave_out(table: Any, model: type[Section], path: str, given: set[str]) -> None:
    """Take keys out of a table whose overridden deciding key does not let them apply."""
    if not isinstance(table, dict):
        return
    for field, (decider, values) in model.applies.items():
        key = model.model_fields[field].alias or field
        if (
            f"{path}.{decider}" in given
            and f"{path}.{key}" not in given
            and table.get(decider) not in values
        ):
            table.pop(key, None)


def _override(data: dict[str, Any], text: str, tables: Mapping[str, type[Section]]) -> list[str]:
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
    if not isinstance(read, str) and len(parts) == 2 and _only_text(tables.get(parts[0]), parts[1]):
        read = value.strip()  # 60E1 is a profile, not 600
    table[parts[-1]] = read
    return []


def _only_text(model: type[Section] | None, key: str) -> bool:
    """Whether a key of a table takes nothing but text."""
    if model is None or key not in model.model_fields:
        return False
    kind = model.model_fields[key].annotation
    return kind is str or (
        get_origin(kind) is Literal and all(isinstance(v, str) for v in get_args(kind))
    )


def _value(text: str) -> Any:
    """Read `text` as a TOML value, else take it as the text itself."""
    try:
        parsed = tomllib.loads(f"value = {text}")
    except tomllib.TOMLDecodeError:
        return text
    return parsed["value"] if list(parsed) == ["value"] else text

"""A commented study file to start from: the keys of a shipped study, and beside them all others."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import MISSING
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.files import write_file
from contactstudy.given_files import toml_file
from contactstudy.study.keys import allowed, shown
from contactstudy.study.kind import Kind, kind_of_file
from contactstudy.study.loading import find_study
from contactstudy.validation import Entry, Table, entries

_WIDTH, _COLUMN = 99, 32
_HEAD = """\
# Made from the study {name}.
# A line that begins with "#" is a key that is not set, with the value that holds then. Numbers are
# SI, or texts with a unit: "300 km/h". Other choices have further keys; "contactstudy keys" lists
# them all. "contactstudy check FILE" says what is wrong with the file and how long it takes,
# "contactstudy run FILE --out results" runs it.
"""


def write_new(path: Path, study: str | Path) -> None:
    """Write the file `path`, which must not be there, from a study's file.

    Raises
    ------
    InputError
        If there is such a file, or no such study.
    """
    if path.exists():
        raise InputError(f"{path}: is there already; give the name of a new file")
    if path.suffix != ".toml":
        raise InputError(f'{path}: a study file ends in ".toml"')
    write_file(path, new_study(study))


def new_study(study: str | Path) -> str:
    """Text of a study file that means what the file of `study` means."""
    data = toml_file(find_study(study))
    kind = kind_of_file(data)
    return "\n".join([_HEAD.format(name=Path(study).stem), *_lines(data, kind)]).rstrip() + "\n"


def _lines(data: dict[str, Any], kind: Kind) -> Iterator[str]:
    above = {key: value for key, value in data.items() if not isinstance(value, dict)}
    yield from _set(above)
    for name, table in kind.tables.items():
        if "." in name:
            continue
        yield from ("", f"[{name}]", *_table(data.get(name, {}), table))
    for group, table in kind.inner_tables.items():
        for name, values in data.get(group, {}).items():
            yield from ("", f"[{group}.{name}]", *_set(values))
        yield from ("", f"# Keys of any table [{group}.NAME]:", *_others({}, table))
    for name, values in data.items():
        if isinstance(values, dict) and name not in {*kind.tables, *kind.inner_tables}:
            yield from ("", f"[{name}]", *_set(values))


def _table(values: Mapping[str, Any], table: Table) -> Iterator[str]:
    known = entries(table)
    for key, value in values.items():
        yield from _explained(f"{_key(key)} = {_toml(value)}", known.get(key))
    yield from _others(values, table)


def _others(values: Mapping[str, Any], table: Table) -> Iterator[str]:
    """Keys that may be set beside `values`, with the value that holds without them."""
    known = entries(table)
    for key, entry in known.items():
        if key not in values and _applies(entry, values, known):
            p = entry.parameter
            given = p.default not in (None, MISSING, ()) and p.by is None
            yield from _explained(f"# {_key(key)} = {shown(p.default) if given else '...'}", entry)


def _applies(entry: Entry, values: Mapping[str, Any], known: Mapping[str, Entry]) -> bool:
    return all(
        values.get(decider, known[decider].parameter.default) in allowing
        for decider, allowing in entry.conditions
    )


def _explained(line: str, entry: Entry | None) -> list[str]:
    """The line, and beside it or above it unit, meaning and limits of its key."""
    if entry is None:
        return [line]
    p, limits = entry.parameter, allowed(entry.parameter)
    limits = f"({limits})" if limits else ""
    text = " ".join(part for part in (f"[{p.unit}]" * bool(p.unit), p.meaning, limits) if part)
    beside = f"{line:<{_COLUMN}}  # {text}"
    if len(beside) <= _WIDTH and "\n" not in line:
        return [beside]
    return [*textwrap.wrap(text, _WIDTH, initial_indent="## ", subsequent_indent="## "), line]


def _set(values: Mapping[str, Any]) -> list[str]:
    return [f"{_key(key)} = {_toml(value)}" for key, value in values.items()]


def _key(key: str) -> str:
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else _toml(key)


def _toml(value: Any) -> str:
    """Value as TOML writes it; texts in JSON's quotes, which are TOML's too."""
    if isinstance(value, str) and "\n" in value and "\\" not in value and '"""' not in value:
        return f'"""\n{value}"""'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return f"[{', '.join(_toml(item) for item in value)}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return str(value).lower() if isinstance(value, bool) else repr(value)

"""Keys that axes name, and the table ``[quick]``."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from contactstudy.study.kind import Kind
from contactstudy.study.study import TEXTS
from contactstudy.validation import Parameter, Variants, entries, unknown, wrong_for_all
from contactstudy.validation.base import read_one

TABLES = ("sweep", "refine", "quick")
"""Tables that are not a kind's."""
ABOUT = ("expected", "why")
"""What ``[refine]`` says of its keys, by key."""


def find_parameter(key: str, kind: Kind, data: Mapping[str, Any]) -> Parameter | str:
    """The parameter of a dotted key of a study of a kind; a complaint if there is none."""
    table, *rest = key.split(".")
    if len(rest) == 1 and table in kind.tables:
        known = entries(kind.tables[table])
    elif len(rest) == 2 and table in kind.inner_tables:
        members = data.get(table)
        if not isinstance(members, Mapping) or rest[0] not in members:
            return unknown(table, rest[0], list(members) if isinstance(members, Mapping) else [])
        known = entries(kind.inner_tables[table])
    else:
        names = [*kind.tables, *(f"{group}.NAME" for group in kind.inner_tables)]
        return f"{key}: is no key of a study of {kind.name}; its tables: {', '.join(names)}"
    if rest[-1] in known:
        return known[rest[-1]].parameter
    return unknown(key.rpartition(".")[0], rest[-1], list(known))


def apply_quick(data: dict[str, Any], quick: Mapping[str, Any]) -> dict[str, Any]:
    """Enter what ``[quick]`` says of axes, in place; the other keys, of the study itself.

    A varied key is the study's own where the table also has a series for it, as "refine.KEY".
    """
    own = {}
    for key, value in quick.items():
        table, _, rest = key.partition(".")
        if table in TABLES[:2] and rest:
            data.setdefault(table, {})[rest] = value
        elif (holders := [t for t in TABLES[:2] if key in (data.get(t) or {})]) and not any(
            f"{holder}.{key}" in quick for holder in holders
        ):
            for holder in holders:
                data[holder][key] = value
        else:
            own[key] = value
    return own


def wrong_alone(
    table: str, values: Iterable[tuple[str, Any]], kind: Kind, data: Mapping[str, Any]
) -> list[str]:
    """Complaints about keys that a table of axes gives values, each looked at by itself."""
    problems = dict[str, None]()
    for key, value in values:
        if key in TEXTS:
            continue
        found = find_parameter(key, kind, data)
        if isinstance(found, str):
            problems[f"{table}: {found}"] = None
            continue
        path, _, last = key.rpartition(".")
        first = path.partition(".")[0]
        model = kind.inner_tables.get(first, kind.tables.get(first))
        if isinstance(model, Variants):
            wrong = wrong_for_all(model, {last: value}, path)
        else:
            wrong = read_one(found, value, key)[1]
        problems |= dict.fromkeys(f"{table}: {problem}" for problem in wrong)
    return list(problems)


def without_keys(axes: Mapping[str, Any], keys: Collection[str]) -> dict[str, Any]:
    """A table of axes without some of its keys, and without what it says of them by key."""
    return {
        name: {k: v for k, v in value.items() if k not in keys}
        if isinstance(value, Mapping) and name in ABOUT
        else value
        for name, value in axes.items()
        if name not in keys
    }

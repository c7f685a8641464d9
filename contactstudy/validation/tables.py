"""Tables of a study file: which keys there are, objects read from them, values and units."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import MISSING, dataclass, fields, replace
from pathlib import Path
from typing import Any, Literal, cast

from contactstudy.exceptions import InputError
from contactstudy.units import Limits
from contactstudy.validation.base import (
    Parameters,
    Place,
    check,
    flat,
    naming,
    of_variant,
    only_with,
    read_one,
)
from contactstudy.validation.definition import Parameter, parameters
from contactstudy.validation.messages import any_of, complaint, did_you_mean, unknown
from contactstudy.validation.metadata import Variants
from contactstudy.validation.unread import UnreadError, is_partly, partly

Table = type[Parameters] | Variants
"""What a table is read as: one class, or one of several that a key chooses."""


@dataclass(frozen=True)
class Entry:
    """A key of a table; deciding keys and their values with which it applies, outermost first."""

    parameter: Parameter
    conditions: tuple[tuple[str, tuple[str, ...]], ...] = ()


def entries(table: Table) -> dict[str, Entry]:
    """All keys of a table in the order in which they are shown."""
    if isinstance(table, Variants):
        return _of_variants(table)
    own = parameters(table)
    keys = {p.name: p.key for p in own}
    found = {
        p.key: Entry(p, tuple((keys.get(w.key, w.key), w.values) for w in p.when))
        for p in own
        if p.key and p.variants is None
    }
    for p in own:
        if p.variants is not None:
            found |= _of_variants(p.variants)
    return found


def _of_variants(variants: Variants) -> dict[str, Entry]:
    names = tuple(variants.classes)
    kind = Literal[names]  # type: ignore[valid-type]
    decider = Parameter("", variants.key, kind, variants.default, Limits(), variants.meaning)
    found = {variants.key: Entry(decider)}
    for name, made in variants.classes.items():
        for key, entry in entries(made).items() if made is not None else ():
            with_it: tuple[str, ...] = (name,)
            if key in found:
                with_it = (*found[key].conditions[0][1], name)
            found[key] = replace(entry, conditions=((variants.key, with_it), *entry.conditions))
    everywhere = tuple(name for name, made in variants.classes.items() if made is not None)
    return {
        key: replace(entry, conditions=entry.conditions[1:])
        if entry.conditions and entry.conditions[0][1] == everywhere == names
        else entry
        for key, entry in found.items()
    }


def read(table: Table, data: Any, path: str, **others: Any) -> tuple[Any, list[str]]:
    """Object that a table of a study file describes, and everything that is wrong with it.

    With anything wrong the object is there for further rules (`asked`) and must not be used: it
    raises `UnreadError` when it is asked for a value that is wrong. None where nothing could be
    read.

    Parameters
    ----------
    data : object
        The table as TOML gives it.
    path : str
        Its dotted name.
    **others
        Values of fields that have no key.
    """
    if not isinstance(data, Mapping):
        return None, [complaint(path, data, "must be a table")]
    known = entries(table)
    chosen: dict[str, str] = {}
    made, wrong = _made(table, data, path, chosen, others)
    here = [
        key
        for key, entry in known.items()
        if all(chosen[d] in values for d, values in entry.conditions if d in chosen)
    ]
    problems = [unknown(path, key, here) for key in data if key not in known] + wrong
    for key in sorted(key for key in data if key in known):
        for decider, values in known[key].conditions:
            if decider in chosen and chosen[decider] not in values:
                problems.append(only_with(f"{path}.{key}", decider, values, chosen[decider]))
                break
    return made, problems


def _made(
    table: Table,
    data: Mapping[str, Any],
    path: str,
    chosen: dict[str, str],
    others: Mapping[str, Any],
) -> tuple[Any, list[str]]:
    if isinstance(table, Variants):
        name = data.get(table.key, table.default)
        if not isinstance(name, str) or name not in table.classes:
            hint = did_you_mean(name, table.classes) if isinstance(name, str) else ""
            allowed = f"must be {any_of(table.classes)}{hint}"
            problems = [complaint(f"{path}.{table.key}", name, allowed)]
            return None, problems + wrong_for_all(table, data, path)
        chosen[table.key] = name
        made = table.classes[name]
        return (None, []) if made is None else _made(made, data, path, chosen, others)
    own, key = parameters(table), naming(table, path)
    given = {p.name: data[p.key] for p in own if p.key in data and p.variants is None}
    wrong = check(table, given, key)[1]
    wrong |= {
        p.name: [f"{path}.{p.key}: is missing; must be {p.limits.description()}"]
        for p in own
        if p.key and p.needed and p.name not in given and p.name not in others
    }
    problems, parts = flat(wrong), {}
    for p in own:
        if p.variants is not None:
            parts[p.name], found = _made(p.variants, data, path, chosen, {})
            problems += found
            if found and parts[p.name] is None:
                wrong[p.name] = found
    place = Place(path, frozenset(given))
    if wrong or any(map(is_partly, parts.values())):
        return _in_part(table, given | parts | dict(others), place, wrong, problems)
    made = object.__new__(table)
    object.__setattr__(made, "_place", place)
    try:
        cast(Any, table).__init__(made, **given, **parts, **others)
    except InputError as error:
        problems += error.problems
    return made, problems


def _in_part(
    table: type[Parameters],
    given: Mapping[str, Any],
    place: Place,
    wrong: Collection[str],
    problems: list[str],
) -> tuple[Any, list[str]]:
    """Object without the fields that are `wrong`, and the complaints with those of its rules."""
    key, own = naming(table, place.path), {f.name: f for f in fields(cast(Any, table))}
    unread = set(wrong) | {name for name, f in own.items() if not f.init}
    unread |= {
        p.name for p in parameters(table) if p.by and p.by.decider in unread and p.name not in given
    }
    values: dict[str, Any] = {}
    for name, f in own.items():
        if name in given:
            values[name] = given[name]
        else:
            values[name] = f.default if f.default_factory is MISSING else f.default_factory()
    values = {name: value for name, value in values.items() if name not in unread}
    values |= check(table, values, key)[0] | {"_place": place}
    made = partly(table, values, unread)
    problems = problems + made.broken(key)
    try:
        made.settle()
    except UnreadError:
        made = partly(table, values, {*unread, *table.settled})
    return made, problems


def wrong_for_all(table: Variants, data: Mapping[str, Any], path: str) -> list[str]:
    """Complaints about keys that are wrong whichever class is chosen."""
    problems: list[str] = []
    classes = [entries(made) for made in table.classes.values() if made is not None]
    for key, value in data.items():
        found = [
            read_one(known[key].parameter, value, f"{path}.{key}")[1]
            for known in classes
            if key in known
        ]
        if found and all(found):
            problems += found[0]
    return problems


def resolve_paths(table: Table, data: Any, base: Path) -> None:
    """Make files in a table of a study file, relative to its folder `base`, relative to here.

    `data` is changed in place; what is no table is left to the check of its values.
    """
    for key, entry in entries(table).items() if isinstance(data, dict) else ():
        named, file = data.get(key), entry.parameter.file
        if file and isinstance(named, str):
            data[key] = file.relative_to(named, base)
        elif file and isinstance(named, list):
            data[key] = [file.relative_to(n, base) if isinstance(n, str) else n for n in named]


def resolved(table: Table, made: Parameters) -> dict[str, Any]:
    """Key -> SI value of all keys that apply, as plain data."""
    return of_variant(table, made) if isinstance(table, Variants) else made.resolved()


def units(table: Table, values: Mapping[str, Any]) -> dict[str, str]:
    """Key -> SI unit of those of `values` that have one; "rest" and other texts have none."""
    known = entries(table)
    return {
        key: unit
        for key, value in values.items()
        if (unit := known[key].parameter.unit) and not isinstance(value, str)
    }

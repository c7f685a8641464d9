"""All keys of study files as Markdown, derived from the parameters of the domain's classes."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import MISSING
from typing import Any, Literal, get_origin

from contactstudy.validation import Entry, Parameter, Table, entries


def key_reference(tables: Mapping[str, Table]) -> str:
    """Markdown table of the keys of each table, by its name in a file: "track", "runs.NAME"."""
    return "\n\n".join(_section(name, table) for name, table in tables.items()) + "\n"


def _section(name: str, table: Table) -> str:
    known = entries(table)
    rows = [
        "| key | unit | default | allowed | meaning |",
        "|---|---|---|---|---|",
        *(_row(key, entry, known) for key, entry in known.items()),
    ]
    about = "" if not isinstance(table, type) else _summary(table)
    return "\n".join([f"## [{name}]", "", *about, *rows])


def _summary(owner: type) -> list[str]:
    """First paragraph of a class's docstring."""
    text = textwrap.dedent(owner.__doc__ or "").strip().split("\n\n")[0]
    return [" ".join(text.split()), ""]


def _row(key: str, entry: Entry, known: Mapping[str, Entry]) -> str:
    p = entry.parameter
    meaning = p.meaning + "".join(f"; {only(*c, known)}" for c in entry.conditions)
    cells = (f"`{key}`", p.unit, _default(p), allowed(p), meaning)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def only(decider: str, values: Sequence[str], known: Mapping[str, Entry]) -> str:
    """With which values of a deciding key another applies; without which, if these are fewer."""
    others = [name for name in known[decider].parameter.choices if name not in values]
    fewer, word = (others, "not") if len(others) < len(values) else (values, "only")
    return f"{word} with {decider} = {' or '.join(fewer)}"


def _default(p: Parameter) -> str:
    if p.by is not None:
        return ", ".join(f"{shown(value)} ({name})" for name, value in p.by.defaults.items())
    return "" if p.default in (None, MISSING) else shown(p.default)


def allowed(p: Parameter) -> str:
    """What a parameter may be, in words."""
    names = " or ".join(f'"{name}"' for name in p.choices)
    if p.only_text:
        return names or "text"
    if isinstance(p.default, bool):
        return "true or false"
    if p.listed is None:
        form = f", or {p.written.form}" if p.written and p.written.form else ""
        more = p.multiples.form if p.multiples else ""
        return " or ".join(part for part in (p.limits.description() + form, names, more) if part)
    of_names = get_origin(p.listed[0]) is Literal
    each = names if of_names else p.limits.description()
    listed = f"{'a list' if p.listed[-1] is Ellipsis else 'two'}, each {each}"
    return f"{listed}, or {names}" if names and not of_names else listed


def shown(value: Any) -> str:
    """Value as in a study file."""
    if isinstance(value, tuple):
        return f"[{', '.join(shown(item) for item in value)}]"
    if isinstance(value, str):
        return f'"{value}"'
    return str(value).lower() if isinstance(value, bool) else f"{value:.6g}"

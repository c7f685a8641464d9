"""All keys of study files as Markdown, derived from the parameters of the domain's classes."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import MISSING
from typing import Any, Literal, get_origin

from contactstudy.validation import Entry, Parameter, Parameters, Table, entries

AXES = """\
# Any kind

## [sweep]

`"TABLE.KEY" = VALUES` varies a key; all combinations are computed. VALUES are a list, `"1 to 50"`,
`"0 m to 7 m by 0.5 m"` (steps), `"20 mm to 3 m by 14, logarithmic"` or `"..., linear"` (number of
values), or `"2 to 32 x 2"` (factors).

| key | unit | default | allowed | meaning |
|---|---|---|---|---|
| `combine` |  | "grid" | "grid" or "zip" or "sobol" or "latin_hypercube" | all combinations, \
value by value, or a sample, whose VALUES may be `"uniform 1 m to 2 m"`, `"log-uniform ..."` or \
`"normal 65 MN/m, 5 MN/m"` |
| `samples` |  | 64 | a whole number at least 2 | size of a sample; a power of 2 with "sobol" |
| `seed` |  | 1 | a whole number at least 0 | of a sample |
| `keep` |  | [] | a list of texts | histories that are kept whole of every variant |

## [refine]

`"TABLE.KEY" = VALUES`, numbers from coarse to fine, each key by itself, and crossed with the keys
of `[sweep]`; three or more give observed order, limit, grid convergence index and a verdict, two
the difference.
`expected = { "TABLE.KEY" = 2 }` states the order of the scheme, `why = { "TABLE.KEY" = "text" }`
why it is that, or why none can be expected.

## [quick]

`"TABLE.KEY" = VALUE` takes its place with `--quick`, of a varied key its series. Where a varied key
also has another value by itself, `"sweep.TABLE.KEY"` or `"refine.TABLE.KEY"` gives the series.
"""


def key_reference(tables: Mapping[str, Table], study: type[Parameters] | None = None) -> str:
    """Markdown table of the keys of each table, by its name in a file: "track", "runs.NAME".

    First come those of the `study`, which stand above the tables.
    """
    above = [] if study is None else [_section("", study)]
    return "\n\n".join([*above, *(_section(name, table) for name, table in tables.items())]) + "\n"


def _section(name: str, table: Table) -> str:
    known = entries(table)
    rows = [
        "| key | unit | default | allowed | meaning |",
        "|---|---|---|---|---|",
        *(_row(key, entry, known) for key, entry in known.items()),
    ]
    about = _summary(table) if name and isinstance(table, type) else ""
    return "\n".join([f"## [{name}]" if name else "## Above the tables", "", *about, *rows])


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
    few = 0 < len(others) < len(values)
    fewer, word = (others, "not") if few else (values, "only")
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
    each = names if of_names else "text" if p.listed[0] is str else p.limits.description()
    listed = f"{'a list' if p.listed[-1] is Ellipsis else 'two'}, each {each}"
    return f"{listed}, or {names}" if names and not of_names else listed


def shown(value: Any) -> str:
    """Value as in a study file."""
    if isinstance(value, tuple):
        return f"[{', '.join(shown(item) for item in value)}]"
    if isinstance(value, str):
        return f'"{value}"'
    return str(value).lower() if isinstance(value, bool) else f"{value:.6g}"

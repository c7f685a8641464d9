"""What is made of the program itself: keys, commands, verification cases, explorer."""

import contextlib
import importlib.util
import io
import json
import os
import shutil
from pathlib import Path

import error_study
import explorer

from contactstudy import cli
from contactstudy.verification.cases import CASES
from contactstudy.verification.check import Check
from contactstudy.verification.outcome import from_data

BOOK = "verification.json"
_SCRIPTS = ("bokeh.min.js", "bokeh-api.min.js")
_RESULT = ("name", "title", "method", "checks", "tables", "figures")


def write(docs: Path) -> None:
    """Write them into folders of docs where they are not kept."""
    for folder in ("reference", "book", "generated"):
        (docs / folder).mkdir(exist_ok=True)
    _save(docs / "reference" / "keys.md", _under("Keys of study files", printed("keys")))
    _save(docs / "reference" / "commands.md", commands())
    for name, text in book(docs / BOOK).items():
        _save(docs / "book" / f"{name}.md", text)
    found = json.loads((docs / error_study.DATA).read_text("utf-8"))
    _save(docs / "how_wrong.md", error_study.page(found))
    data = json.loads((docs / explorer.DATA).read_text("utf-8"))
    _save(docs / "generated" / "trust_map.js", explorer.script(data))
    for name in _SCRIPTS:
        shutil.copy(_bokeh(name), docs / "generated" / name)


def _bokeh(name: str) -> Path:
    """A script of Bokeh's package."""
    found = importlib.util.find_spec("bokeh")
    assert found is not None and found.origin is not None
    return Path(found.origin).parent / "server" / "static" / "js" / name


def printed(*arguments: str) -> str:
    """What a command prints, as wide as a page."""
    out = io.StringIO()
    os.environ["COLUMNS"] = "88"
    with contextlib.redirect_stdout(out), contextlib.suppress(SystemExit):
        cli.main(list(arguments))
    return out.getvalue()


def commands() -> str:
    """The help of each command."""
    from contactstudy.commands import app

    names = sorted(n for n in app if not n.startswith("-"))
    parts = [f"# Commands\n\n```text\n{printed('--help')}```\n"]
    parts += [f"## contactstudy {n}\n\n```text\n{printed(n, '--help')}```\n" for n in names]
    return "\n".join(parts)


def book(file: Path) -> dict[str, str]:
    """Page of each verification case, from what ``contactstudy verify`` wrote; and the list."""
    data = json.loads(file.read_text("utf-8"))
    every = {case["name"]: case for case in data["cases"]}
    found = {name: case for name, case in every.items() if "checks" in case}
    names = [case.name for case in CASES if case.name in found]
    rows = [f"| [{n}]({n}.md) | {found[n]['title']} | {found[n]['status']} |" for n in names]
    for case in (case for case in CASES if case.name not in found):
        why = every.get(case.name, {"status": "not in this run", "reason": ""})
        told = ": ".join(part for part in (why["status"], why["reason"]) if part)
        rows.append(f"| {case.name} | {_cell(case.about)} | {_cell(told)} |")
    versions = ", ".join(f"{name} {number}" for name, number in data["versions"].items())
    index = [
        "# Verification book",
        "",
        "Each page is one case as `contactstudy verify` computed it: the problem, the exact or",
        "published figure, and ours beside it. No number on these pages is typed. The error is",
        "computed less reference, over the size of the reference; the band is what is allowed.",
        "Some differences are reported and not judged.",
        "",
        f"Computed with {versions}; code {data['code']}.",
        "",
        "| case | what | outcome |\n|---|---|---|",
        *rows,
        "",
        "```{toctree}\n:hidden:\n",
        *names,
        "```",
    ]
    return {"index": "\n".join(index) + "\n"} | {n: _case(found[n], file.parent) for n in names}


def _case(case: dict, docs: Path) -> str:
    from contactstudy.plot.draw import draw
    from contactstudy.plot.style import figure_style, save

    result = from_data({key: case[key] for key in _RESULT})
    parts = [f"# {result.title}", f"`contactstudy verify {result.name}`", result.method]
    head = "| | reference | computed | error | band | source |\n|---|---|---|---|---|---|"
    parts.append("\n".join([head, *map(_check, result.checks)]))
    for table in result.tables:
        rows = [" | ".join(map(_cell, row)) for row in (table.header, *table.rows)]
        rows.insert(1, " | ".join("---" for _ in table.header))
        parts += [table.caption, "\n".join(f"| {row} |" for row in rows)]
    for k, plot in enumerate(result.figures, 1):
        name = f"{result.name}-{k}"
        with figure_style():
            save(draw(plot), docs / "book", name)
        parts.append(f"![{plot.y_label} over {plot.x_label}]({name}.png)\n\n{plot.caption}")
    return "\n\n".join(parts) + "\n"


def _check(check: Check) -> str:
    limit = {"equal": "", "at_most": "at most ", "at_least": "at least "}[check.sense]
    cells = (
        check.quantity,
        f"{limit}{check.reference:.6g} {check.unit}",
        f"{check.computed:.6g} {check.unit}",
        f"{100 * check.error:.3g} %" if check.sense == "equal" else "",
        _band(check),
        check.source,
    )
    return f"| {' | '.join(map(_cell, cells))} |"


def _band(check: Check) -> str:
    """What is allowed: a limit has no band, unless it may be exceeded by one."""
    if check.band is None:
        return "reported"
    return f"{100 * check.band:.3g} %" if check.sense == "equal" or check.band > 1e-9 else "limit"


def _cell(value: object) -> str:
    text = f"{value:.4g}" if isinstance(value, float) else "–" if value is None else str(value)
    return text.replace("|", "\\|").replace("\n", " ").strip()


def _under(title: str, text: str) -> str:
    """A page of its own: the headings of the text one level lower."""
    lines = [f"#{line}" if line.startswith("#") else line for line in text.splitlines()]
    return "\n".join([f"# {title}", "", *lines]) + "\n"


def _save(path: Path, text: str) -> None:
    """Write what has changed only, so that Sphinx reads only that again."""
    if not path.is_file() or path.read_text("utf-8") != text:
        path.write_text(text, "utf-8")

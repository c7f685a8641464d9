"""Tutorials: their blocks are run as they stand, and what they print is what the page says.

The blocks of a page are run one after the other in a folder of its own:

- ``toml``: a file; the comment in the first line names it, ``# line.toml``, or one that these lines
  are added to, ``# more of line.toml``, or one whose tables these replace, ``# in line.toml``;
- ``bash``: each line that begins with ``contactstudy`` is run;
- ``python``: run with the names of the blocks before it;
- ``text``: lines that the block before it printed, in this order. A number with decimals may be off
  by one in the last of them, as another machine may round it; ``...`` stands for anything.

Percentages in the text around must be among the page's numbers.
"""

import contextlib
import io
import os
import re
import shlex
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from contactstudy import cli
from contactstudy.files import write_file
from contactstudy.store import store_key

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
_WHOLE = re.DOTALL | re.MULTILINE
_NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
_PERCENT = re.compile(rf"({_NUMBER}) %")


class PageError(Exception):
    """A block does not run, or does not print what the page says."""


def run_all(docs: Path) -> None:
    """Run the tutorials that have changed since they were last run, or the program has."""
    for page in sorted((docs / "tutorials").glob("*.md")):
        folder, text = docs / "tutorials" / "made" / page.stem, page.read_text("utf-8")
        key, slip = store_key(text, None), folder / "key"
        if slip.is_file() and slip.read_text("utf-8") == key:
            continue
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        with contextlib.chdir(folder), _in_place():
            run_page(page.name, text)
        write_file(slip, key)


def run_page(name: str, text: str) -> None:
    """Run the blocks of a page in the working directory, and hold its percentages against them.

    Raises
    ------
    PageError
        With the line of the block.
    """
    every = run_blocks(name, text)
    code, prose = "\n".join(m[2] for m in _BLOCK.finditer(text)), _BLOCK.sub("", text)
    known = [float(n) for n in re.findall(_NUMBER, "\n".join([*every, code]))]
    for percent in _PERCENT.findall(prose):
        if not any(_equal(percent, n) or _equal(percent, 100.0 * n) for n in known):
            raise PageError(f"{name}: {percent} % is no number of the page's blocks")


def run_blocks(name: str, text: str) -> list[str]:
    """Run the blocks of a page in the working directory; what each of them printed."""
    names: dict[str, Any] = {"__name__": "__main__"}
    printed, every = "", []
    for block in _BLOCK.finditer(text):
        language, content = block.groups()
        place = f"{name}:{text.count(chr(10), 0, block.start()) + 1}"
        if language == "text":
            held_against(printed, content, place)
        elif language == "toml":
            _file(content, place)
        elif language in ("bash", "python"):
            out = io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                _run(language, content, names, place)
            printed = out.getvalue()
            every.append(printed)
        else:
            raise PageError(f"{place}: no block of {language}")
    if drawing := sys.modules.get("matplotlib.pyplot"):
        drawing.close("all")  # the gallery would take them for those of its first example
    return every


def held_against(printed: str, shown: str, place: str) -> None:
    """Find the lines shown in what was printed, one after the other."""
    at, printed = 0, printed.replace("−", "-")
    for line in filter(str.strip, shown.splitlines()):
        numbers = re.findall(_NUMBER, line)
        for found in _pattern(line).finditer(printed, at):
            if all(map(_equal, numbers, map(float, found.groups()))):
                at = found.end()
                break
        else:
            raise PageError(f"{place}: “{line}” was not printed, but:\n{printed}")


def _pattern(line: str) -> re.Pattern[str]:
    """Any numbers for its numbers, any space for its spaces, anything for an ellipsis."""
    parts = re.split(rf"(\s*\.\.\.\s*|\s+|{_NUMBER})", line.strip())
    kinds = {"": r"\s+", "...": ".*?"}
    numbers = {p: f"({_NUMBER})" for p in parts if re.fullmatch(_NUMBER, p)}
    return re.compile(
        "".join(p and (kinds.get(p.strip()) or numbers.get(p) or re.escape(p)) for p in parts)
    )


def _equal(shown: str, number: float) -> bool:
    """To one in the last decimal shown; a whole number is a rounded one."""
    digits, _, power = shown.partition("e")
    decimals = len(digits.partition(".")[2])
    last = 10.0 ** (int(power or 0) - decimals)
    return abs(float(shown) - number) <= (1.0001 if decimals else 0.5) * last


def _file(content: str, place: str) -> None:
    first = re.match(r"# (more of |in )?(\S+)\n", content)
    if not first:
        raise PageError(f"{place}: its first line does not name a file")
    how, path = first[1], Path(first[2])
    before = path.read_text("utf-8") + "\n" if how else ""
    if how != "in ":
        path.write_text(before + content, "utf-8")
        return
    for table in re.split(r"^(?=\[)", content, flags=re.MULTILINE)[1:]:
        head = table.partition("\n")[0]
        parts = before.partition(f"{head}\n")
        if not parts[1]:
            raise PageError(f"{place}: {path} has no table {head}")
        before = parts[0] + table + re.sub(r"\A.*?(?=^\[|\Z)", "", parts[2], flags=_WHOLE)
    path.write_text(before, "utf-8")


def _run(language: str, content: str, names: dict[str, Any], place: str) -> None:
    if language == "python":
        try:
            exec(compile(content, place, "exec"), names)
        except Exception as error:
            raise PageError(f"{place}: {type(error).__name__}: {error}") from error
        return
    for line in content.splitlines():
        if line.startswith("contactstudy "):
            status = cli.main(shlex.split(line, comments=True)[1:])
            differ = line.startswith("contactstudy diff ") and status == 1
            if status and not differ:  # of different results diff says so by its status
                raise PageError(f"{place}: “{line}” ends with {status}: {sys.stdout.getvalue()}")


@contextlib.contextmanager
def _in_place() -> Iterator[None]:
    """Tables as wide as a page."""
    before = os.environ.get("COLUMNS")
    os.environ["COLUMNS"] = "94"
    try:
        yield
    finally:
        os.environ.pop("COLUMNS") if before is None else os.environ.update(COLUMNS=before)

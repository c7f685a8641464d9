"""Rows of a CSV file with their line numbers, and how its faults are listed."""

import csv
import io
import math
import re
from collections import Counter
from pathlib import Path

from contactstudy.exceptions import InputError
from contactstudy.given_files import file_text

MOST_ROWS = 1_000_000
"""Of a CSV file: so many are read in ten seconds and half a gigabyte."""
_LONGEST = 60  # characters of a cell that are shown
_SHOWN = 10  # faults of one kind that are listed before "and n more"


def read_rows(path: Path) -> list[tuple[int, list[str]]]:
    """Line number and cells of every line that is not blank.

    ``InputError`` if the file cannot be read, or is empty.
    """
    text = file_text(path, "CSV")
    if (count := text.count("\n")) > MOST_ROWS:
        raise InputError(f"{path}: has {count} lines; allowed: up to {MOST_ROWS}")
    try:
        reader = csv.reader(io.StringIO(text, newline=""))
        rows = [(reader.line_num, cells) for cells in reader if any(c.strip() for c in cells)]
    except csv.Error as error:
        raise InputError(f"{path}: this is not a CSV file ({error})") from None
    if rows and len(rows[0][1]) == 1 and (mark := re.search(r"[;\t]", rows[0][1][0])):
        shown = {";": "semicolons", "\t": "tabs"}[mark[0]]
        raise InputError(
            f"{path}, line {rows[0][0]}: its columns are parted by {shown}; allowed: commas, and a "
            "decimal point"
        )
    if not rows:
        raise InputError(f"{path}: the file is empty; allowed: a header line and numbers")
    return rows


_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


def finite_number(cell: str) -> float | None:
    """Number in a cell, or None if it is not a finite one in plain digits (``1_0`` is none)."""
    value = float(cell) if _NUMBER.fullmatch(cell) else math.nan
    return value if math.isfinite(value) else None


def shown_cell(cell: str) -> str:
    """A cell as messages show it: on one line, and of a long one the beginning."""
    text = cell if len(cell) <= _LONGEST else f"{cell[:_LONGEST]}..."
    return f"'{' '.join(text.split())}'" if cell else "empty"


def header_cells(path: Path, rows: list[tuple[int, list[str]]]) -> list[str]:
    """Names in the first row, which must differ; no row may have more cells than it.

    Cells without text behind the last column are passed over.
    """
    line, cells = rows[0]
    header = [name.strip() for name in cells]
    while header and not header[-1]:
        header.pop()
    times = Counter(header)
    faults = [
        f"line {line}: there is more than one column '{name}'"
        for name in dict.fromkeys(header)
        if name and times[name] > 1
    ]
    problems = listed(path, faults)
    if len(header) == 1 and len(rows) > 1 and all(len(cells) > 1 for _, cells in rows[1:]):
        raise InputError(
            f"{path}, line {line} is {shown_cell(header[0])}; allowed: names of columns, parted by "
            "commas, in the first line"
        )
    wide = [
        (line, len(cells))
        for line, cells in rows[1:]
        if any(cell.strip() for cell in cells[len(header) :])
    ]
    problems += listed(
        path,
        [
            f"line {line} has {count} cells, the header {len(header)}; numbers need a decimal "
            "point and no thousands separator (is it a decimal comma?)"
            for line, count in wide
        ],
    )
    if problems:
        raise InputError(problems)
    return header


def listed(path: Path | str, faults: list[str]) -> list[str]:
    """The first faults of one kind with the file's name, and how many more there are."""
    shown = [f"{path}, {fault}" for fault in faults[:_SHOWN]]
    if len(faults) > _SHOWN:
        shown.append(f"{path}: and {len(faults) - _SHOWN} more faults of this kind")
    return shown

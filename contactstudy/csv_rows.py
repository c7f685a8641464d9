"""Rows of a CSV file with their line numbers, and how its faults are listed."""

import csv
import math
from pathlib import Path

from contactstudy.exceptions import InputError

_SHOWN = 10  # faults of one kind that are listed before "and n more"


def read_rows(path: Path) -> list[tuple[int, list[str]]]:
    """Line number and cells of every line that is not blank.

    ``InputError`` if the file cannot be read, or is empty.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file)
            rows = [(reader.line_num, cells) for cells in reader if any(c.strip() for c in cells)]
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: this is not a text file; allowed: CSV in UTF-8") from None
    except csv.Error as error:
        raise InputError(f"{path}: this is not a CSV file ({error})") from None
    except OSError as error:
        raise InputError(f"{path}: the file cannot be read ({error.strerror})") from None
    if not rows:
        raise InputError(f"{path}: the file is empty; allowed: a header line and numbers")
    return rows


def finite_number(cell: str) -> float | None:
    """Number in a cell, or None if it is not a finite one."""
    try:
        value = float(cell)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def listed(path: Path, faults: list[str]) -> list[str]:
    """The first faults of one kind with the file's name, and how many more there are."""
    shown = [f"{path}, {fault}" for fault in faults[:_SHOWN]]
    if len(faults) > _SHOWN:
        shown.append(f"{path}: and {len(faults) - _SHOWN} more faults of this kind")
    return shown

"""Points of a worn profile in a CSV file, y and z in columns of these names."""

import re
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.csv_rows import finite_number, header_cells, listed, read_rows, shown_cell
from contactstudy.exceptions import InputError
from contactstudy.profiles.profile_file import FilePoints

UNITS = {"m": 1.0, "mm": 1e-3}


def points_of_csv(file: Path, unit: str | None, problems: list[str]) -> tuple[FilePoints, str]:
    """Points [m] of a CSV file, and the unit that it states; adds what is wrong with them."""
    rows = read_rows(file)
    header = header_cells(file, rows)
    index, stated, wrong = _columns(file, rows[0][0], header, unit)
    if wrong:
        raise InputError(wrong)
    points, lines, faults = _points(rows[1:], index, header)
    points *= UNITS[stated]
    problems += listed(file, faults)
    return FilePoints(points, lines, []), stated


def _columns(
    path: Path, line: int, header: list[str], unit: str | None
) -> tuple[list[int], str, list[str]]:
    """Places of the columns y and z, the unit, and what is wrong with the header."""
    problems, index, units = [], [], {unit} - {None}
    for name in ("y", "z"):
        found = [
            (k, match.group(1))
            for k, cell in enumerate(header)
            if (match := re.fullmatch(rf"{name}\s*(?:[\[(_ ]\s*([^\])\s]+)\s*[\])]?)?", cell))
        ]
        if len(found) != 1:
            problems.append(
                f"{path}, line {line}: there is {'no' if not found else 'more than one'} column "
                f"'{name}'; the file has: {', '.join(header)}"
            )
            continue
        index.append(found[0][0])
        units |= {found[0][1]} - {None}
    if len(units) != 1 or not units <= set(UNITS):
        given = " and ".join(f"'{u}'" for u in sorted(str(u) for u in units)) or "not stated"
        problems.append(
            f"{path}: the unit of y and z is {given}; allowed: mm or m, in the header as "
            "'y [mm],z [mm]' or beside the file's name"
        )
    return index, str(next(iter(units), "")), problems


def _points(
    rows: list[tuple[int, list[str]]], index: list[int], header: list[str]
) -> tuple[Array, list[int], list[str]]:
    """Points (n, 2) with their line numbers, and the cells that are no numbers."""
    points, lines, faults = [], [], []
    for line, cells in rows:
        values = []
        for k in index:
            cell = cells[k].strip() if k < len(cells) else ""
            value = finite_number(cell)
            if value is None:
                shown = shown_cell(cell)
                faults.append(
                    f"line {line}, column '{header[k]}' is {shown}; allowed: finite numbers"
                )
            else:
                values.append(value)
        if len(values) == 2:
            points.append(values)
            lines.append(line)
    return np.array(points, dtype=float).reshape(-1, 2), lines, faults

"""Position and level from a CSV file, with every fault of the file reported at once."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.csv_rows import finite_number, header_cells, listed, read_rows, shown_cell
from contactstudy.exceptions import InputError
from contactstudy.validation import raise_if


def read_numbers(path: Path, columns: Sequence[str]) -> tuple[Array, IntArray, list[str]]:
    """Columns of numbers (n, k), the line of each row (n,) from 1, and faults of single cells.

    The file is comma-separated and its first line names the columns; blank lines are skipped.

    Raises
    ------
    InputError
        For a file that cannot be read, a missing column or two of one name, or rows that are wider
        than the header.
    """
    rows = read_rows(path)
    header = header_cells(path, rows)
    missing = [name for name in columns if name not in header]
    if missing:
        raise InputError(
            f"{path}, line {rows[0][0]}: there is no column '{name}'; the file has: "
            + ", ".join(header)
            for name in missing
        )
    index = [header.index(name) for name in columns]
    faults: list[str] = []
    table = np.full((len(rows) - 1, len(columns)), np.nan)
    for row, (line, cells) in enumerate(rows[1:]):
        for k, name in enumerate(columns):
            cell = cells[index[k]].strip() if index[k] < len(cells) else ""
            value = finite_number(cell)
            if value is None:
                shown = shown_cell(cell)
                faults.append(f"line {line}, column '{name}' is {shown}; allowed: finite numbers")
            else:
                table[row, k] = value
    return table, np.array([line for line, _ in rows[1:]], dtype=np.int64), listed(path, faults)


def read_columns(
    path: Path, columns: tuple[str, str], min_rows: int = 4
) -> tuple[Array, Array, IntArray]:
    """Two columns of numbers, the first of them increasing, as in `read_numbers`.

    Positions and values (n,) stay in the file's own units, the lines (n,) count from 1.

    Raises
    ------
    InputError
        As in `read_numbers`; for cells that are empty, not numbers or not finite, positions that
        do not increase, or too few rows: file, line and column of each.
    """
    if columns[0] == columns[1]:
        raise InputError(f"{path}: '{columns[0]}' is named as the position and as the level")
    table, lines, problems = read_numbers(path, columns)
    problems += listed(path, _disorder(lines, table[:, 0], columns[0]))
    if len(table) < min_rows:
        problems.append(f"{path}: {len(table)} rows of numbers; allowed: {min_rows} or more")
    raise_if(problems)
    return table[:, 0].copy(), table[:, 1].copy(), lines


def _disorder(lines: IntArray, positions: Array, name: str) -> list[str]:
    """Lines at which the position does not increase; unreadable cells are passed over."""
    good = np.flatnonzero(np.isfinite(positions))
    if good.size > 1 and np.all(np.diff(positions[good]) < 0.0):
        return [
            f"line {lines[good[0]]}, column '{name}': positions fall from {positions[good[0]]:g} "
            f"to {positions[good[-1]]:g}; allowed: increasing positions (turn the rows round)"
        ]
    found = []
    for i in good[1:][np.diff(positions[good]) <= 0.0]:
        before = positions[good[np.searchsorted(good, i) - 1]]
        kind = "repeats" if positions[i] == before else "falls below"
        found.append(
            f"line {lines[i]}, column '{name}': {positions[i]:g} {kind} the position before "
            f"it ({before:g}); allowed: increasing positions"
        )
    return found

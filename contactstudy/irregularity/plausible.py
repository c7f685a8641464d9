"""Whether a column of numbers can be a measured level: gaps, placeholders, size, dead channels."""

import re
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.csv_rows import listed
from contactstudy.irregularity.size import wrong_size

LARGEST = 0.1
"""Largest level [m]: a rail that far off its mean is not travelled; the unit is wrong."""
FEW_ROWS = 4
"""Rows that may be missing where no shortest wavelength is asked for."""

_PLACEHOLDER = re.compile(r"-?(9{3,}(\.9*)?|32768|32767|2147483648|2147483647)")
_STATED = re.compile(
    r"[ _](k?m|cm|mm|[uµμ]m)$|[ _]?[\[(] *(k?m|cm|mm|[uµμ]m|in|inch|ft) *[\])]$", re.IGNORECASE
)
_FAR = 10.0  # robust standard deviations from the median


def implausible(
    file: Path,
    x: Array,
    level: Array,
    lines: IntArray,
    column: str,
    unit: tuple[str, float],
    shortest: float | None,
) -> list[str]:
    """Complaints with their lines; level (n,) in the unit [name, m], positions (n,) in m.

    A gap is longer than half the shortest wavelength that is kept [m], which no interpolation can
    bridge, or without one longer than a few rows.
    """
    spacing = float(np.median(np.diff(x)))
    longest = FEW_ROWS * spacing if shortest is None else max(0.5 * shortest, 1.5 * spacing)
    why = "a few rows" if shortest is None else "half the shortest wavelength that is kept"
    steps = np.diff(x)
    problems = listed(
        file,
        [
            f"lines {lines[k]} to {lines[k + 1]}: {steps[k]:.4g} m without a row; allowed: at "
            f"most {longest:.4g} m, {why} (use one side of the gap)"
            for k in np.flatnonzero(steps > longest * (1 + 1e-9))
        ],
    )
    empty = placeholders(level)
    problems += listed(file, no_values(empty, level, lines, column))
    name, metre = unit
    huge = np.abs(level) * metre > LARGEST
    problems += listed(
        file,
        [
            f"line {lines[k]}, column '{column}' is {level[k]:g} {name}; allowed: at most "
            f"{LARGEST / metre:g} {name} (is the unit right?)"
            for k in np.flatnonzero(huge & ~empty)
        ],
    )
    if not huge.any() and (complaint := wrong_size(file, x, level, column, unit)):
        problems.append(complaint)
    if level[0] != 0.0 and np.all(level == level[0]):
        problems.append(f"{file}, column '{column}' is {level[0]:g} in all rows: a dead channel")
    return problems


def no_values(
    empty: BoolArray, values: Array, lines: IntArray, column: str, then: str = "leave such rows out"
) -> list[str]:
    """A complaint of each placeholder among values (n,), and what to do then."""
    return [
        f"line {lines[k]}, column '{column}' is {values[k]:g}, which looks like a placeholder for "
        f"no value; {then}"
        for k in np.flatnonzero(empty)
    ]


def placeholders(level: Array) -> BoolArray:
    """Which values (n,) are runs of nines or ends of integers, far from all that is measured."""
    middle = float(np.median(level))
    spread = 1.4826 * float(np.median(np.abs(level - middle)))
    found = np.abs(level - middle) > _FAR * spread
    found[found] = [bool(_PLACEHOLDER.fullmatch(f"{value:.10g}")) for value in level[found]]
    return np.asarray(found)


def other_unit(file: Path, column: str, unit: str) -> list[str]:
    """Complaint where a column's own name ends in a unit of length that is not the one taken."""
    stated = _STATED.search(column.strip())
    name = (stated[1] or stated[2]).lower() if stated else unit
    if re.sub("[µμ]", "u", name) == re.sub("[µμ]", "u", unit):
        return []
    return [f"{file}: column '{column}' says {name}, and is to be read in {unit}"]

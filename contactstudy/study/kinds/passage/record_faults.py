"""What in the columns of a measured record is no measurement: gaps, placeholders, doubled ones."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.csv_rows import listed
from contactstudy.irregularity.plausible import no_values, placeholders

_GAP = 10  # median steps of time that a record may be without a row


def wrong_columns(time_column: str, columns: Sequence[str]) -> dict[int, str]:
    """Number of a channel -> what is wrong with the column that it names."""
    times = Counter(columns)
    found = {}
    for k, column in enumerate(columns):
        if column == time_column:
            found[k] = "must be another column than measured.time_column"
        elif times[column] > 1:
            found[k] = f"column '{column}' is named {times[column]} times; allowed: once"
    return found


def gaps(file: str, time: Array, lines: IntArray) -> list[str]:
    """Complaints of times (n,) [s] between which rows are missing: they would be interpolated."""
    steps = np.diff(time)
    allowed = _GAP * float(np.median(steps))
    return listed(
        file,
        [
            f"lines {lines[k]} to {lines[k + 1]}: {steps[k]:.4g} s without a row; allowed: at most "
            f"{allowed:.4g} s, {_GAP} usual steps (use one side of the gap)"
            for k in np.flatnonzero(steps > allowed)
        ],
    )


def jumps_to_nothing(file: str, column: str, values: Array, lines: IntArray) -> list[str]:
    """Complaints of placeholders among values (n,) of a column, where they begin and end."""
    # a peak may reach 999, but does not jump there
    jumps = np.abs(np.diff(values, prepend=values[:1], append=values[-1:]))
    begin_or_end = np.maximum(jumps[:-1], jumps[1:]) > 0.5 * np.abs(values)
    return listed(file, no_values(placeholders(values) & begin_or_end, values, lines, column))

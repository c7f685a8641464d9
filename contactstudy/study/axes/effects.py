"""What each of many keys changes, over all values of the others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.study.axes.shown import Shown, drawn

SHARE = 0.8
"""Share of the values between the lower and upper edge of an effect."""
MOST = 3
"""Keys that a figure can show value by value."""
PANELS = 9
"""Values of the shortest of three keys, each of which has a map."""


@dataclass(frozen=True)
class Effect:
    """Of a key with n values: (n,) over all values of the other keys; nan where all failed.

    Attributes
    ----------
    median : ndarray
        Medians: not moved by a few combinations in which a quantity is many times larger.
    low, high : ndarray
        Between them lie `SHARE` of the values.
    """

    median: Array
    low: Array
    high: Array

    @property
    def change(self) -> float:
        """Largest median less the smallest."""
        return float(np.nanmax(self.median) - np.nanmin(self.median))


def too_many(quantity: Shown, free: list[str]) -> bool:
    """Whether these keys are too many to show all their combinations."""
    return len(free) > MOST or (
        len(free) == MOST and min(quantity.data.sizes[key] for key in free) > PANELS
    )


def effects(quantity: Shown, run: str, free: list[str]) -> dict[str, Effect]:
    """Effect of each key on a run, of means over samples."""
    mean = quantity.of_run(run).mean([d for d in quantity.axes if drawn(quantity.data, d)])
    found = {}
    edges = [0.5, 0.5 * (1.0 - SHARE), 0.5 * (1.0 + SHARE)]
    for key in free:
        rows = mean.transpose(key, ...).values.reshape(mean.sizes[key], -1)
        there = [row[np.isfinite(row)] for row in rows]
        values = [np.quantile(row, edges) if len(row) else np.full(3, np.nan) for row in there]
        found[key] = Effect(*np.array(values).T)
    return found

"""Whether a table of numbers can be the depth that is missing on a wheel's tread."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.csv_rows import listed
from contactstudy.irregularity.plausible import no_values, placeholders

if TYPE_CHECKING:
    from contactstudy.irregularity.depth_map import DepthTable

DEEPEST = 10.0
"""Largest depth or height [mm]: that of a fresh flat of 0.18 m, which no wheel runs on with."""
_LEAST = 1e-6  # m; polished treads have as much
_STEEPEST = 0.3  # along the wheel; the edge of a flat of 0.1 m is 0.1 steep
_CLIFF = 0.1  # share of the largest depth that may be left at an end


def impossible(file: Path, depth: Array, lines: IntArray) -> list[str]:
    """Complaints of depths (n,) [mm] in those lines (n,) that no wheel has."""
    empty = placeholders(depth)
    then = "a map needs a depth at every place"
    problems = listed(file, no_values(empty, depth, lines, "depth", then))
    faults = [
        f"line {lines[k]}, column 'depth' is {depth[k]:g} mm; allowed: -{DEEPEST:g} to "
        f"{DEEPEST:g} mm (is the unit right?)"
        for k in np.flatnonzero((np.abs(depth) > DEEPEST) & ~empty)
    ]
    return problems + listed(file, faults)


def doubtful(file: Path, table: "DepthTable", radius: float) -> list[str]:
    """Warnings of a map on a wheel of that radius [m]."""
    name, size = file.name, float(np.abs(table.depths).max())
    if size == 0.0:
        return [f"{name}: the depth is zero throughout: the wheel is round"]
    found = []
    if size < _LEAST:
        found.append(
            f"{name}: the largest depth is {1e6 * size:.3g} um; column 'depth' is in mm (is the "
            "unit right?)"
        )
    if table.depths.max() <= 0.0:
        found.append(
            f"{name}: no depth is above 0: the tread stands up by {1e3 * size:.3g} mm; a depth "
            "counts into the wheel"
        )
    if not table.y[0] <= 0.0 <= table.y[-1]:
        found.append(
            f"{name}: y goes from {1e3 * table.y[0]:g} to {1e3 * table.y[-1]:g} mm; the tape "
            "circle, y = 0, has no defect"
        )
    s = table.distances(radius)
    if s[-1] - s[0] < 1.99 * np.pi * radius:  # a map of the whole wheel has no ends
        left = float(np.abs(table.depths[[0, -1]]).max())
        if left > _CLIFF * size:
            found.append(
                f"{name}: at the map's ends along the wheel {1e3 * left:.3g} mm of depth are left, "
                "steps to the round wheel"
            )
    slope = np.abs(np.diff(table.depths, axis=0)) / np.diff(s)[:, None]
    k, j = np.unravel_index(int(np.argmax(slope)), slope.shape)
    if slope[k, j] > _STEEPEST:
        jump = abs(table.depths[k + 1, j] - table.depths[k, j])
        found.append(
            f"{name}: between s = {1e3 * s[k]:.4g} and {1e3 * s[k + 1]:.4g} mm, y = "
            f"{1e3 * table.y[j]:g} mm, the depth changes by {1e3 * jump:.3g} mm: a spike of the "
            "measurement?"
        )
    return found

"""What is wrong with the points of a worn profile."""

from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.csv_rows import listed

POINTS = 20
"""Fewest points of a profile."""
WIDTHS = (0.02, 0.3)
"""Narrowest and widest profile [m]: anything else has the wrong unit."""
LARGEST_GAP = 4e-3
"""Longest stretch without a point [m]."""


def wrong_order(path: Path, points: Array, lines: list[int]) -> list[str]:
    """Points that repeat or go back on the walk, which may lead either way."""
    y = points[:, 0]
    steps = np.diff(y)
    if not len(steps):
        return []
    if np.median(steps) < 0:
        steps = -steps
    faults = [
        f"line {lines[k + 1]}: y = {1e3 * y[k + 1]:g} mm "
        + ("repeats" if steps[k] == 0 else "goes back behind")
        + f" line {lines[k]} ({1e3 * y[k]:g} mm); allowed: y grows, or falls, all the way"
        for k in np.flatnonzero(steps <= 0)
    ]
    return listed(path, faults)


def wrong_width(path: Path, points: Array, unit: str) -> str:
    """An impossible width, "" for a possible one or too few points for any."""
    if len(points) < POINTS or WIDTHS[0] <= (width := float(np.ptp(points[:, 0]))) <= WIDTHS[1]:
        return ""
    return (
        f"{path}: the profile is {1e3 * width:.4g} mm wide with y in {unit}; allowed: "
        f"{1e3 * WIDTHS[0]:g} to {1e3 * WIDTHS[1]:g} mm (is the unit right?)"
    )


def wrong_extent(path: Path, points: Array, lines: list[int], unit: str) -> list[str]:
    """Too few points, gaps between them, an impossible width, no point at y = 0."""
    if len(points) < POINTS:
        return [f"{path}: {len(points)} points; allowed: {POINTS} or more"]
    if wrong := wrong_width(path, points, unit):
        return [wrong]
    problems = []
    low, high = float(points[:, 0].min()), float(points[:, 0].max())
    if not low < 0.0 < high:
        problems.append(
            f"{path}: y goes from {1e3 * low:.4g} to {1e3 * high:.4g} mm; allowed: from below to "
            "above 0, the rail's middle plane or the wheel's tape circle"
        )
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    faults = [
        f"between lines {lines[k]} and {lines[k + 1]}: {1e3 * chords[k]:.3g} mm without a point; "
        f"allowed: at most {1e3 * LARGEST_GAP:g} mm"
        for k in np.flatnonzero(chords > LARGEST_GAP)
    ]
    return problems + listed(path, faults)

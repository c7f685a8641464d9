"""Shapes of a wheel's flats, written down plainly, and a file of one of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity import DepthMap

RADIUS = 0.43
"""Of the wheel, m."""
LENGTH = 0.030
"""Of the fresh and of the rounded flat, m."""
DISH, WIDTH, DEPTH = 0.026, 0.020, 0.06e-3
"""Of a worn dish, along and across, and its depth, m."""

Depth = Callable[[Array, Array], Array]
"""From distances s round the wheel and y to the depth, all in m."""


def fresh_depth(s: Array, y: Array) -> Array:
    """Of the chord at distances s round the wheel, in m; the same at all y."""
    chord = np.sqrt(RADIUS**2 - LENGTH**2 / 4) / np.cos(s / RADIUS)
    return np.asarray(np.maximum(RADIUS - chord, 0.0) + 0.0 * y)


def _haversine(s: Array, length: float) -> Array:
    return np.where(np.abs(s) < length / 2, 0.5 * (1 + np.cos(2 * np.pi * s / length)), 0.0)


def rounded_depth(s: Array, y: Array) -> Array:
    """Of the chord's depth with rounded ends, in m; the same at all y."""
    return LENGTH**2 / (8 * RADIUS) * _haversine(s, LENGTH) + 0.0 * y


def dish_depth(s: Array, y: Array) -> Array:
    """Of a dish that nearly fits the rail's crown at its bottom, in m."""
    return DEPTH * _haversine(s, DISH) * _haversine(y, WIDTH)


def dish_map(folder: Path) -> DepthMap:
    """The dish as a file of depths every 0.5 mm along and across."""
    s, y = np.linspace(-15.0, 15.0, 61), np.linspace(-12.0, 12.0, 49)
    depth = 1e3 * dish_depth(1e-3 * s[:, None], 1e-3 * y)
    rows = [f"{a},{b},{d}" for a, line in zip(s, depth, strict=True)
            for b, d in zip(y, line, strict=True)]  # fmt: skip
    file = folder / "dish.csv"
    file.write_text("\n".join(["s,y,depth", *rows]))
    return DepthMap(at=0.0, file=str(file))

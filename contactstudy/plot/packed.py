"""Panels of figures as one JSON text: arrays in base64, each once, lines thinned to a size."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.plot.looks import Shape
from contactstudy.plot.panels import Panels
from contactstudy.texts import json_text

_BYTES = 2 * 4 * 4 / 3
"""Of a point: two numbers of 4 bytes, in base64."""
_TRIALS = 3
_FEWEST = 300
"""Points of a line that are never thinned."""


def packed(figures: Mapping[str, Panels], room: float) -> tuple[str, int]:
    """JSON text of figures in about `room` bytes, and the points that its lines have at most.

    ``arrays`` are little-endian 4-byte floats, which ``figures`` name by their number. The points
    are 0 where all are there; lines are thinned to no less than `_FEWEST`.
    """
    sizes = [len(s["x"]) for f in figures.values() for p in f.panels for s in p.shapes if _long(s)]
    longest = max(sizes, default=0)
    if len(text := _text(figures, longest)) <= room:
        return text, 0
    most = _share(sizes, (room - len(_text(figures, _FEWEST))) / _BYTES)
    for _ in range(_TRIALS):  # arrays that stand there once leave room
        larger = min(int(most * room / len(text := _text(figures, most))), longest - 1)
        if len(tried := _text(figures, larger)) > room or larger <= most:
            break
        text, most = tried, larger
    return text, most


def _text(figures: Mapping[str, Panels], most: int) -> str:
    known: dict[bytes, int] = {}

    def plain(value: Any) -> Any:
        if isinstance(value, np.ndarray):
            return known.setdefault(value.astype("<f4").tobytes(), len(known))
        return vars(value)

    thinned = {name: _thinned(figure, most) for name, figure in figures.items()}
    shown = json_text(thinned, default=plain)
    texts = json_text([base64.b64encode(data).decode("ascii") for data in known])
    return f'{{"arrays": {texts}, "figures": {shown}}}'


def thin(y: Array, most: int) -> IntArray:
    """Indices (k,), ascending, of at most `most` of the values (n,), extremes and gaps among them.

    Of each of many equal stretches the smallest, the largest and the first gap are kept: what is
    drawn are values that were computed, and no peak is lost.
    """
    if len(y) <= most:
        return np.arange(len(y))
    stretches = max(most // (3 if np.isnan(y).any() else 2), 1)
    size = -(-len(y) // stretches)
    rows = np.pad(y, (0, stretches * size - len(y)), constant_values=np.nan).reshape(-1, size)
    gaps = np.isnan(rows)
    low = np.where(gaps, np.inf, rows).argmin(axis=1)
    high = np.where(gaps, -np.inf, rows).argmax(axis=1)
    first_gap = np.where(gaps.any(axis=1), gaps.argmax(axis=1), low)
    kept = np.unique([low, high, first_gap] + size * np.arange(stretches))
    return kept[kept < len(y)]


def _long(shape: Shape) -> bool:
    return shape["kind"] == "line" and len(shape["x"]) > _FEWEST


def _share(sizes: list[int], room: float) -> int:
    """The largest number of points that a line may have for all to take the room."""
    for k, size in enumerate(sorted(sizes)):
        share = room / (len(sizes) - k)
        if size > share:
            return max(int(share), _FEWEST)
        room -= size
    return max(sizes, default=0)


def _thinned(figure: Panels, most: int) -> Panels:
    panels = []
    for panel in figure.panels:
        shapes = list(panel.shapes)
        for k, shape in enumerate(shapes):
            if _long(shape):
                kept = thin(shape["y"], most)
                shapes[k] = shape | {"x": shape["x"][kept], "y": shape["y"][kept]}
        panels.append(replace(panel, shapes=tuple(shapes)))
    return replace(figure, panels=tuple(panels))

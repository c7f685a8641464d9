"""How results are compressed in their file, without loss."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr

LARGE = 100_000
"""Bytes from which on a variable is compressed."""


def packed(tree: xr.DataTree) -> dict[str, dict[str, dict[str, Any]]]:
    """How netCDF writes what is large, for each group.

    On a planar track both wheels of a wheelset have one history, and neighbouring instants have the
    same leading bytes: less than half is left.
    """
    found = {}
    for node in tree.subtree:
        variables = node.to_dataset(inherit=False).variables
        found[node.path] = {
            str(name): {
                "zlib": True,
                "complevel": 4,
                "shuffle": True,
                "chunksizes": _pieces(one.shape),
            }
            for name, one in variables.items()
            if one.nbytes >= LARGE and one.dtype.kind in "fiu"
        }
    return {path: own for path, own in found.items() if own}


def _pieces(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Size of the pieces that are compressed: two wheels within the 32 kB that zlib looks back.

    It sees all first bytes, then all second bytes and so on.
    """
    room, pieces = 16_384, list[int]()
    for size in reversed(shape):
        pieces.append(math.ceil(size / math.ceil(size / room)))
        room = max(1, room // pieces[-1])
    pieces[-1] = max(pieces[-1], min(2, shape[0]))
    return tuple(reversed(pieces))

"""Mapped blocks of quadrilaterals: graded edges, Coons patches, joined numbering."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray


def graded(length: float, first: float, growth: float, largest: float) -> Array:
    """Positions 0..length whose steps start at `first` at most and grow to `largest` at most.

    Steps follow ``min(first*growth**i, largest)`` until the length is reached; all are then
    shortened by the same factor, so that the last position is exact.
    """
    steps = [first]
    while sum(steps) < length * (1 - 1e-9):
        steps.append(min(steps[-1] * growth, largest))
    positions = np.r_[0.0, np.cumsum(steps)]
    return np.asarray(positions * (length / positions[-1]))


@dataclass(frozen=True)
class Grading:
    """Element sizes of a section: `size` in the fine part, along its surface and in depth [m].

    They grow by the ratio `growth` up to `coarse` far away [m].
    """

    size: float
    coarse: float
    growth: float

    def steps(self, length: float, first: float | None = None) -> Array:
        """Positions 0..length that grow from `first`, by default one step above the fine part."""
        first = self.size * self.growth if first is None else first
        return graded(length, first, self.growth, self.coarse)


def along(polyline: Array, fractions: Array) -> Array:
    """Points of a polyline at fractions of its arc length."""
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(polyline, axis=0).T))]
    return np.stack([np.interp(fractions * s[-1], s, polyline[:, i]) for i in (0, 1)], axis=1)


def transfinite(bottom: Array, top: Array, left: Array, right: Array) -> Array:
    """Coons patch (rows, columns, 2) of four matching edges; rows run from bottom to top."""
    rows, columns = len(left), len(bottom)
    # blending weights: the mean of the normalised arc lengths of opposite edges
    u = 0.5 * (_normalised(bottom) + _normalised(top))
    v = 0.5 * (_normalised(left) + _normalised(right))
    U, V = np.broadcast_to(u, (rows, columns)), np.broadcast_to(v[:, None], (rows, columns))
    U, V = U[..., None], V[..., None]
    # P = (1-v) B + v T + (1-u) L + u R - bilinear interpolation of the corners
    return np.asarray(
        (1 - V) * bottom[None]
        + V * top[None]
        + (1 - U) * left[:, None]
        + U * right[:, None]
        - (1 - U) * (1 - V) * bottom[0]
        - U * (1 - V) * bottom[-1]
        - (1 - U) * V * top[0]
        - U * V * top[-1]
    )


def _normalised(edge: Array) -> Array:
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(edge, axis=0).T))]
    return np.asarray(s / s[-1])


def join(*blocks: Array) -> tuple[Array, IntArray, list[IntArray]]:
    """Number the nodes of mapped blocks once, joining coincident ones."""
    flat = np.vstack([b.reshape(-1, 2) for b in blocks])
    keys = np.round(flat / 1e-8).astype(np.int64)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.ravel()
    ids, quads, start = [], [], 0
    for block in blocks:
        rows, columns, _ = block.shape
        number = inverse[start : start + rows * columns].reshape(rows, columns)
        start += rows * columns
        ids.append(number)
        quads.append(
            np.stack(
                [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1
            ).reshape(-1, 4)
        )
    return flat[first], np.vstack(quads), ids


def on_mirror(nodes: Array, symmetric: bool) -> IntArray:
    """Nodes (n, 2) on the plane y = 0 of a half mesh; none of a whole one."""
    return np.flatnonzero(symmetric & (np.abs(nodes[:, 0]) < 1e-12))

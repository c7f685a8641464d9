"""The rails' rows under contacts that travel along a track."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.track.rail import Direction

_AT_ONCE = 400_000
"""Weights that are made and kept at a time: for many wheels far fewer than all of a run."""


class UnderWheels(Protocol):
    """A track, or a part of it, that says what a wheel feels, see `DiscreteTrack`."""

    def contact_rows(self, x: Array, rail: int, direction: Direction) -> tuple[IntArray, Array]:
        """Dofs and weights (m, k) under a wheel at X (m,) [m]."""


class TravellingRows:
    """Dofs and weights (nc, k) of the rail under each contact at each step, made as they come.

    A pure cache: which steps were asked for before changes the time, not the answer.

    Parameters
    ----------
    positions : ndarray (n_times, nc)
        X of the contacts [m].
    rails, directions : sequence
        Of each contact.

    Attributes
    ----------
    width : int
        k.
    """

    def __init__(
        self,
        track: UnderWheels,
        positions: Array,
        rails: IntArray,
        directions: Sequence[Direction],
    ) -> None:
        self._track, self._positions = track, positions
        kinds = list(zip(rails.tolist(), directions, strict=True))
        self._kinds = {
            kind: np.flatnonzero([one == kind for one in kinds]) for kind in dict.fromkeys(kinds)
        }
        self.width: int = max(self._of(kind, np.zeros(1))[0].shape[1] for kind in self._kinds)
        self._length = max(1, _AT_ONCE // (len(kinds) * self.width))
        self._first, self._rows = -1, (np.zeros(0, dtype=np.int64), np.zeros(0))

    def at(self, step: int) -> tuple[IntArray, Array]:
        """Rows at a step."""
        first = step - step % self._length
        if first != self._first:
            self._first, self._rows = first, self._made(self._positions[first:][: self._length])
        dofs, weights = self._rows
        return dofs[step - first], weights[step - first]

    def between(self, first: int, stop: int) -> tuple[IntArray, Array]:
        """Rows (steps, nc, k) at steps first .. stop - 1."""
        return self._made(self._positions[first:stop])

    def _made(self, positions: Array) -> tuple[IntArray, Array]:
        shape = (*positions.shape, self.width)
        dofs, weights = np.zeros(shape, dtype=np.int64), np.zeros(shape)
        for kind, contacts in self._kinds.items():
            of, by = self._of(kind, positions[:, contacts].ravel())
            rows = np.s_[:, contacts, : of.shape[1]]
            dofs[rows] = of.reshape(len(positions), len(contacts), of.shape[1])
            weights[rows] = by.reshape(len(positions), len(contacts), by.shape[1])
        return dofs, weights

    def _of(self, kind: tuple[int, Direction], x: Array) -> tuple[IntArray, Array]:
        return self._track.contact_rows(x, *kind)

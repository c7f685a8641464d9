"""Columns of S^-1 near a travelling wheel that presses a stretch of rail."""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import LocalColumns
from contactstudy.track.stretch import RailStretch


class NearbyColumns:
    """Columns of S^-1 for the dofs of the stretch under the wheel, side by side.

    A pure cache: which patches were asked for before changes the time, not the answer.

    Attributes
    ----------
    compliance : ndarray (nd, nd)
        S^-1 on the dofs of the stretch asked for last.
    reach : slice
        Dofs of the system that a load on that stretch moves.
    response : ndarray (nd, reach)
        Their displacements for unit loads on the dofs of the stretch.
    """

    def __init__(self, factor: Factor) -> None:
        self._columns = LocalColumns(factor)
        self._key: int | None = None

    def move_to(self, stretch: RailStretch) -> None:
        """Have the columns of a stretch at hand."""
        if stretch.key == self._key:
            return
        self._key = stretch.key
        first, self.response = self._columns.block(stretch.dofs)
        self.reach = slice(first, first + self.response.shape[1])
        C = self.displacement(stretch.dofs)
        self.compliance: Array = 0.5 * (C + C.T)

    def displacement(self, of: IntArray) -> Array:
        """Displacement (nd, k) of k dofs of the system for unit loads on the stretch's dofs."""
        at = of - self.reach.start
        felt = (at >= 0) & (at < self.response.shape[1])
        return np.where(felt, self.response[:, np.where(felt, at, 0)], 0.0)

"""Columns of S^-1 near a travelling wheel, computed once each."""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor
from contactstudy.track.stretch import RailStretch


class NearbyColumns:
    """Columns of S^-1 for the dofs of the stretch, kept while the wheel passes them.

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
        self._factor = factor
        self._columns: dict[int, Array] = {}
        self._key: int | None = None

    def move_to(self, stretch: RailStretch) -> None:
        """Have the columns of a stretch at hand."""
        if stretch.key == self._key:
            return
        self._key, dofs = stretch.key, stretch.dofs
        wanted = sorted(set(dofs.tolist()))
        missing = [d for d in wanted if d not in self._columns]
        unit = np.zeros((self._factor.n, len(missing)))
        unit[missing, np.arange(len(missing))] = 1.0
        solved = self._factor.solve(unit)
        self._columns = {d: self._columns[d] for d in wanted if d in self._columns} | {
            d: np.ascontiguousarray(solved[:, k]) for k, d in enumerate(missing)
        }
        columns = np.stack([self._columns[d] for d in dofs.tolist()])
        # in one time step a load is felt a metre or so away: the rest is below rounding
        size = np.abs(columns).max(axis=0)
        felt = np.flatnonzero(size > 1e-18 * size.max())
        self.reach = slice(int(felt[0]), int(felt[-1]) + 1)
        self.response = np.ascontiguousarray(columns[:, self.reach])
        C = columns[:, dofs]
        self.compliance: Array = 0.5 * (C + C.T)

    def displacement(self, stretch: RailStretch, of: IntArray) -> Array:
        """Displacement (nd, k) of k dofs of the system for unit loads on the stretch's dofs."""
        return np.stack([self._columns[d][of] for d in stretch.dofs.tolist()])

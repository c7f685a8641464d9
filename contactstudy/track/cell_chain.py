"""A rail as a chain of equal condensed cells: its dofs, their matrices, what the pads see."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.cell import RailCell
from contactstudy.track.discrete import pieces_at
from contactstudy.track.model import Ends
from contactstudy.track.supports import PadMotion, PadRow

# coordinates of an interface plane that are its rigid motions, see `interface_basis`
_AXIAL, _VERTICAL, _LATERAL, _ROLL = 0, 1, 3, 5
MOTIONS: tuple[PadMotion, ...] = ("Z", "Y", "roll")
"""Motions of the foot, in the order of `RailCell.foot_map`; the first for a half section."""


@dataclass(frozen=True)
class CellChain:
    """The rail alone. Bare dofs: interface, internal modes, interface, ... along the rail.

    What the ends hold is left out of the matrices.
    """

    cell: RailCell
    n_cells: int
    ends: Ends

    @property
    def thickness(self) -> float:
        """Length of a slice of the mesh [m]."""
        return self.cell.recipe.thickness

    @property
    def step(self) -> int:
        """Bare dofs of one plane and one cell's internal modes."""
        return self.cell.recipe.interface_modes + self.cell.recipe.internal_modes

    @property
    def n_bare(self) -> int:
        """Number of bare dofs."""
        return self.n_cells * self.step + self.cell.recipe.interface_modes

    @cached_property
    def held(self) -> IntArray:
        """Bare dofs that the end conditions hold.

        Nothing else holds the rail along X, so ends that leave it free to slide are held
        there by one axial coordinate.
        """
        m, last = self.cell.recipe.interface_modes, self.n_cells * self.step
        if self.ends == "clamped":
            return np.r_[0:m, last : last + m]
        if self.ends == "pinned":
            across = [_VERTICAL] if self.cell.recipe.symmetric else [_VERTICAL, _LATERAL, _ROLL]
            return np.array([_AXIAL, *across, *(last + c for c in across)])
        return np.array([_AXIAL])

    @cached_property
    def free(self) -> IntArray:
        """Bare dofs that are left, in order."""
        return np.setdiff1d(np.arange(self.n_bare), self.held)

    @cached_property
    def keys(self) -> Array:
        """Position X of each free dof, (n_free,) [m]; internal modes sit in mid-cell."""
        m, step = self.cell.recipe.interface_modes, self.step
        bare = np.arange(self.n_bare)
        keys = self.cell.recipe.length * (bare // step + 0.5 * (bare % step >= m))
        return np.asarray(keys[self.free])

    @cached_property
    def _place(self) -> IntArray:
        """Place among the free dofs of each bare dof, -1 where held."""
        place = np.full(self.n_bare, -1, dtype=np.int64)
        place[self.free] = np.arange(len(self.free))
        return place

    def locate(self, x: Array) -> tuple[IntArray, IntArray, Array]:
        """Cell, slice in it and fraction of the slice of each X (m,) [m]."""
        ns = self.cell.recipe.n_slices
        index, t = pieces_at(x, self.thickness, self.n_cells * ns)
        return index // ns, index % ns, t

    def matrix(self, of_cell: Array) -> sp.csr_array:
        """Sum of equal cell matrices (nd, nd) over the chain, on the free dofs."""
        nd, n = len(of_cell), self.n_bare
        dofs = self.step * np.arange(self.n_cells)[:, None] + np.arange(nd)
        rows, columns = np.repeat(dofs, nd, axis=1).ravel(), np.tile(dofs, (1, nd)).ravel()
        values = np.tile(of_cell.ravel(), self.n_cells)
        total = sp.csr_array((values, (rows, columns)), shape=(n, n))
        return total[self.free][:, self.free]

    def bed(self, motion: int) -> Array:
        """Matrix (nd, nd) of a uniform foundation of unit stiffness under one cell [m]."""
        # integral of f f^T dx, f = mean motion of the foot, linear between planes
        f, h = self.cell.foot_map[:, motion], self.thickness
        own, crossed = f[:-1].T @ f[:-1] + f[1:].T @ f[1:], f[:-1].T @ f[1:]
        return np.asarray(h / 6 * (2 * own + crossed + f[1:].T @ f[:-1]))

    def pad_row(self, first: float, last: float, motion: int) -> PadRow:
        """Average motion of the foot over a footprint from X to X [m], linear between planes."""
        h = self.thickness
        inner = h * np.arange(np.ceil(first / h), np.floor(last / h) + 1)
        knots = np.unique(np.clip(np.r_[first, inner, last], first, last))
        # trapezoids between knots are exact for a piecewise linear function
        weight = np.full(len(knots), 1.0 if len(knots) == 1 else 0.0)
        share = 0.5 * np.diff(knots) / (last - first if last > first else 1.0)
        weight[:-1] += share
        weight[1:] += share
        row = np.zeros(self.n_bare)
        for c, i, s, w in zip(*self.locate(knots), weight, strict=True):
            start = c * self.step
            f = (1 - s) * self.cell.foot_map[i, motion] + s * self.cell.foot_map[i + 1, motion]
            row[start : start + len(f)] += w * f
        # equal pads get equal rows bit for bit, so that products with them can share values
        row = np.round(row, 12)
        used = np.flatnonzero((row != 0.0) & (self._place >= 0))
        return PadRow(self._place[used], row[used])

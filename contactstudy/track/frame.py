"""Beams, rigid bodies, springs and dampers in space, assembled into banded matrices.

All parts are written over all nodes with six dofs each. One matrix T of zeros and ones then says
which of these dofs there are: u_all = T u. It leaves out what is held, joins what moves together,
and orders the dofs along the track, so that M, C, K = T^T (...) T are banded.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import canonical
from contactstudy.track.space_beam import N_DOFS, SpaceBeam, along_z

HELD = -1
"""Dof of what does not move."""


@dataclass(frozen=True, eq=False)
class Chain:
    """A beam through nodes (m,) at X (m,) [m], which increase; `rayleigh` = (a, b), C = a M + b K.

    With `upright` the beam stands: X is then the height of its nodes.
    """

    nodes: IntArray
    x: Array
    beam: SpaceBeam
    rayleigh: tuple[float, float] = (0.0, 0.0)
    upright: bool = False

    @cached_property
    def lengths(self) -> Array:
        """Of the elements (m - 1,) [m], equal ones equal to the last digit."""
        return np.round(np.diff(self.x), 9)

    def motion_at(self, x: Array) -> tuple[IntArray, Array]:
        """Dofs over all nodes (k, 12), and weights (k, 6, 12) of the section's motion at X (k,)."""
        x = np.asarray(x, dtype=float)
        element = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)
        xi = (x - self.x[element]) / (self.x[element + 1] - self.x[element])
        dofs = np.hstack([_dofs(self.nodes[element]), _dofs(self.nodes[element + 1])])
        return dofs, self.beam.motion(self.lengths[element], xi)

    def matrices(self) -> tuple[IntArray, Array, Array]:
        """Dofs (m - 1, 12), mass and stiffness (m - 1, 12, 12) of the elements."""
        dofs = np.hstack([_dofs(self.nodes[:-1]), _dofs(self.nodes[1:])])
        different, which = np.unique(self.lengths, return_inverse=True)
        turned = along_z if self.upright else np.asarray
        mass, stiffness = (
            np.stack([turned(matrix(float(length))) for length in different])[which]
            for matrix in (self.beam.mass, self.beam.stiffness)
        )
        return dofs, mass, stiffness


def _dofs(nodes: IntArray) -> IntArray:
    return N_DOFS * np.asarray(nodes, dtype=np.int64)[:, None] + np.arange(N_DOFS)


@dataclass(frozen=True, eq=False)
class Springs:
    """Springs and dampers (m,) between points; elongation (m,) = rows @ u over all nodes' dofs."""

    rows: sp.csr_array
    stiffness: Array
    damping: Array


@dataclass(frozen=True, eq=False)
class Frame:
    """Parts over `n_nodes` nodes, and where each of the nodes' dofs went.

    Parameters
    ----------
    chains : sequence of Chain
    springs : sequence of Springs
    bodies : ndarray
        (n_nodes, 6) lumped masses [kg] and moments of inertia [kg m^2].
    dof : ndarray of int
        (n_nodes, 6) final dof, `HELD` for none; equal ones move together.
    """

    chains: Sequence[Chain]
    springs: Sequence[Springs]
    bodies: Array
    dof: IntArray

    @property
    def n_dofs(self) -> int:
        """Number of final dofs."""
        return int(self.dof.max(initial=HELD)) + 1

    @cached_property
    def _selection(self) -> sp.csr_array:
        """T, (6 n_nodes, n_dofs)."""
        final = self.dof.ravel()
        there = np.flatnonzero(final != HELD)
        shape = (len(final), self.n_dofs)
        return sp.csr_array((np.ones(len(there)), (there, final[there])), shape=shape)

    def selected(self, rows: sp.csr_array) -> sp.csr_array:
        """Rows over all nodes' dofs as rows over the final dofs."""
        return canonical(rows @ self._selection)

    @cached_property
    def matrices(self) -> tuple[sp.csr_array, sp.csr_array, sp.csr_array]:
        """M, C and K over the final dofs."""
        size = self.dof.size
        M, C, K = (sp.csr_array((size, size)) for _ in range(3))
        M = M + sp.diags_array(self.bodies.ravel()).tocsr()
        for chain in self.chains:
            dofs, mass, stiffness = chain.matrices()
            rows = np.repeat(dofs, 2 * N_DOFS, axis=1).ravel()
            columns = np.tile(dofs, (1, 2 * N_DOFS)).ravel()
            m, k = (
                sp.csr_array((values.ravel(), (rows, columns)), shape=(size, size))
                for values in (mass, stiffness)
            )
            a, b = chain.rayleigh
            M, C, K = M + m, C + a * m + b * k, K + k
        for spring in self.springs:
            G = spring.rows
            C = C + G.T @ sp.diags_array(spring.damping) @ G
            K = K + G.T @ sp.diags_array(spring.stiffness) @ G
        T = self._selection
        return canonical(T.T @ M @ T), canonical(T.T @ C @ T), canonical(T.T @ K @ T)


def numbered(x: Array, rank: IntArray, kept: Array, alike: IntArray) -> IntArray:
    """Final dofs (n_nodes, 6) in the order of X, then of rank.

    Parameters
    ----------
    x, rank : ndarray
        (n_nodes,) where a node stands, and its place among those of one X.
    kept : ndarray of bool
        (n_nodes, 6) dofs that move.
    alike : ndarray of int
        (n_nodes,) the node with which each moves; itself for all that do not follow another.
    """
    own = kept & (alike == np.arange(len(x)))[:, None]
    dof = np.full(own.shape, HELD, dtype=np.int64)
    next_dof = 0
    for node in np.lexsort((rank, np.round(x, 9))):
        count = int(own[node].sum())
        dof[node, own[node]] = next_dof + np.arange(count)
        next_dof += count
    following = alike != np.arange(len(x))
    dof[following] = np.where(kept[following], dof[alike[following]], HELD)
    return dof

"""Modes of a deck alone on its bearings, and the dampers that give each of them a ratio.

With modes of unit mass, phi^T M phi = 1, the damping matrix sum 2 zeta omega (M phi)(M phi)^T gives
each of them the ratio zeta, and none to what is orthogonal to them (A. K. Chopra, Dynamics of
Structures, section 11.4.3). Supports count as rigid; rails and their layer are left out, their mass
is in the deck's mass per length.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse as sp
from scipy.sparse.linalg import eigsh

from contactstudy.arrays import Array, IntArray
from contactstudy.track.frame import HELD, Frame
from contactstudy.track.space_beam import N_DOFS, Axis
from contactstudy.track.structure_nodes import Nodes
from contactstudy.track.structure_springs import bearings


@dataclass(frozen=True, eq=False)
class DeckModes:
    """Modes of a deck, of unit mass.

    Parameters
    ----------
    frequencies : ndarray
        (k,) [Hz].
    shapes, momenta : ndarray
        (k, m) phi and M phi over the deck's dofs.
    ratios : ndarray
        (k,) damping ratios by the deck's Rayleigh damping and its bearings' dampers.
    """

    frequencies: Array
    shapes: Array
    momenta: Array
    ratios: Array

    def dampers(self, ratio: float) -> Array:
        """Rows (k, m) of the dampers that add a ratio to each of the modes."""
        omega = 2.0 * np.pi * self.frequencies
        return np.sqrt(2.0 * ratio * omega)[:, None] * self.momenta


def deck_modes(nodes: Nodes, number: int, planar: bool, up_to: float) -> DeckModes:
    """Modes up to a frequency [Hz] of the deck with a number."""
    final = nodes.dofs(planar)
    dof, own = np.full_like(final, HELD), nodes.decks[number].nodes
    dofs, there = _dofs(final, own), final[own] != HELD
    dof[own] = np.where(there, np.searchsorted(dofs, final[own]), HELD)
    axes: tuple[Axis, ...] = ("Z",) if planar else ("X", "Y", "Z")
    springs = [one.springs for one in bearings(nodes, axes) if one.deck == number]
    frame = Frame([nodes.decks[number]], springs, np.zeros((nodes.n, N_DOFS)), dof)
    M, C, K = frame.matrices
    omega, shapes = _modes(M, K, 2.0 * np.pi * up_to)
    ratios = np.sum(shapes * (shapes @ C), axis=1) / (2.0 * omega)
    return DeckModes(omega / (2.0 * np.pi), shapes, shapes @ M, ratios)


def _modes(M: sp.csr_array, K: sp.csr_array, up_to: float) -> tuple[Array, Array]:
    """Circular frequencies (k,) up to a limit, and modes (k, m) of unit mass."""
    m = M.shape[0]
    count, start = max(8, m // 16), 1.0 + 0.1 * np.sin(np.arange(m))
    while True:
        if count >= m - 1:
            squares, columns = scipy.linalg.eigh(K.toarray(), M.toarray())
        else:  # from a given vector, so that a run repeats itself
            squares, columns = eigsh(K, count, M, sigma=0.0, v0=start)
        omega = np.sqrt(squares)
        if count >= m - 1 or omega.max() > up_to:
            order = np.argsort(omega)[: np.count_nonzero(omega <= up_to)]
            return omega[order], columns.T[order]
        count *= 2


def modal_dampers(nodes: Nodes, planar: bool, ratio: float, up_to: float) -> sp.csr_array:
    """Rows (r, n_dofs) of the dampers of all decks, for their modes up to a frequency [Hz]."""
    final, rows, known = nodes.dofs(planar), list[sp.csr_array](), dict[bytes, Array]()
    for number, chain in enumerate(nodes.decks):
        # decks that are alike have the same modes
        supports = nodes.bridge.decks[number] - chain.x[0]
        like = np.round(np.r_[chain.lengths, np.nan, supports], 6).tobytes()
        if like not in known:
            known[like] = deck_modes(nodes, number, planar, up_to).dampers(ratio)
        own, dofs = known[like], _dofs(final, chain.nodes)
        at = np.repeat(np.arange(len(own)), len(dofs)), np.tile(dofs, len(own))
        rows.append(sp.csr_array((own.ravel(), at), shape=(len(own), final.max() + 1)))
    return sp.csr_array(sp.vstack(rows))


def _dofs(final: IntArray, nodes: IntArray) -> IntArray:
    """The dofs that nodes have, in order."""
    return np.unique(final[nodes][final[nodes] != HELD])

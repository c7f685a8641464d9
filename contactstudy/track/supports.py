"""Join any discretised rail to its discrete supports.

A support sees the rail through one functional only: the average displacement over the pad's
footprint, a row of weights over a few rail dofs. So beam and solid rails share this assembly.
All dofs are then ordered by their position along the track, which keeps the matrices banded.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.track.hermite import BeamElement
from contactstudy.track.model import Direction, DiscreteSupports, Slab, Track


@dataclass(frozen=True)
class PadRow:
    """Average rail displacement over one pad's footprint: weights @ u[dofs]."""

    dofs: np.ndarray
    weights: np.ndarray


@dataclass(frozen=True)
class SupportedRail:
    """Matrices of rail and supports in an ordering along the track.

    Parameters
    ----------
    mass, damping, stiffness : csr_array
        (n, n), symmetric.
    rail_dofs : ndarray
        (n_rail,) int64, where each dof of the bare rail went.
    """

    mass: sp.csr_array
    damping: sp.csr_array
    stiffness: sp.csr_array
    rail_dofs: np.ndarray


def add_supports(
    mass: sp.sparray,
    damping: sp.sparray | None,
    stiffness: sp.sparray,
    rail_keys: np.ndarray,
    track: Track,
    pad_rows: Sequence[PadRow],
    direction: Direction = "Z",
) -> SupportedRail:
    """Assemble pads, half sleepers and what is below them into the rail's matrices.

    Parameters
    ----------
    mass, damping, stiffness : sparse arrays
        Of the rail alone, (n_rail, n_rail); damping None is zero. A Winkler foundation is
        already in them: it acts on the rail's own dofs.
    rail_keys : ndarray
        (n_rail,), position X of each rail dof, by which all dofs are ordered (ties keep the
        given order, support dofs after rail dofs).
    track : Track
    pad_rows : sequence of PadRow
        One for each of `track.support_positions`; empty when there are none.
    direction : {"Z", "Y"}
        Which of the support's values apply.

    Returns
    -------
    SupportedRail
    """
    n_rail = mass.shape[0]
    support = track.support
    if not isinstance(support, DiscreteSupports):
        layer_m = layer_c = layer_k = pads_c = pads_k = sp.csr_array((n_rail, n_rail))
        n, keys = n_rail, np.asarray(rail_keys, dtype=float)
    else:
        vertical = direction == "Z"
        pad_k = support.pad_stiffness if vertical else support.lateral_pad_stiffness
        pad_c = support.pad_damping if vertical else support.lateral_pad_damping
        seats, layer_keys, layer = _layer(support, track, direction)
        n = n_rail + len(layer_keys)
        keys = np.concatenate((rail_keys, layer_keys))
        # pad elongation = average rail displacement - displacement of the seat: d = G u
        G = _pad_matrix(pad_rows, n_rail + seats, n)
        pads = sp.csr_array(G.T @ G)
        pads_k, pads_c = pad_k * pads, pad_c * pads
        layer_m, layer_c, layer_k = (
            sp.block_diag((sp.csr_array((n_rail, n_rail)), part)) for part in layer
        )
    order = np.argsort(keys, kind="stable")
    place = np.empty(n, dtype=np.int64)
    place[order] = np.arange(n)

    def assembled(rail: sp.sparray | None, *parts: sp.sparray) -> sp.csr_array:
        total = sp.csr_array((n, n))
        if rail is not None:
            rail = sp.coo_array(rail)
            total = sp.csr_array((rail.data, rail.coords), shape=(n, n))
        for part in parts:
            total = total + part
        coo = sp.coo_array(total)
        rows, columns = coo.coords
        ordered = sp.csr_array((coo.data, (place[rows], place[columns])), shape=(n, n))
        ordered.eliminate_zeros()
        ordered.sort_indices()
        return ordered

    return SupportedRail(
        mass=assembled(mass, layer_m),
        damping=assembled(damping, layer_c, pads_c),
        stiffness=assembled(stiffness, layer_k, pads_k),
        rail_dofs=place[:n_rail],
    )


def _pad_matrix(pad_rows: Sequence[PadRow], seats: np.ndarray, n: int) -> sp.csr_array:
    """Elongation of every pad as a matrix over all dofs, (n_supports, n)."""
    if len(pad_rows) != len(seats):
        raise ValueError(f"{len(pad_rows)} pad rows for {len(seats)} supports")
    rows = np.concatenate([np.full(len(pad.dofs), j) for j, pad in enumerate(pad_rows)])
    columns = np.concatenate([pad.dofs for pad in pad_rows])
    values = np.concatenate([pad.weights for pad in pad_rows])
    n_seats = len(seats)
    return sp.csr_array(
        (
            np.concatenate((values, np.full(n_seats, -1.0))),
            (np.concatenate((rows, np.arange(n_seats))), np.concatenate((columns, seats))),
        ),
        shape=(n_seats, n),
    )


def _layer(
    support: DiscreteSupports, track: Track, direction: Direction
) -> tuple[np.ndarray, np.ndarray, tuple[sp.csr_array, sp.csr_array, sp.csr_array]]:
    """Seat dofs, dof positions and (M, C, K) of all that is below the pads."""
    layer, positions = support.layer, track.support_positions
    n_seats = len(positions)
    vertical = direction == "Z"
    sleepers = np.full(n_seats, support.sleeper_mass)
    if not isinstance(layer, Slab):
        k = layer.stiffness if vertical else layer.lateral_stiffness
        c = layer.damping if vertical else layer.lateral_damping
        eye = sp.eye_array(n_seats, format="csr")
        return np.arange(n_seats), positions, (sp.diags_array(sleepers).tocsr(), c * eye, k * eye)
    element = BeamElement(
        support.spacing,
        layer.bending_stiffness if vertical else layer.lateral_bending_stiffness,
        layer.mass_per_length,
    )
    k = layer.stiffness if vertical else layer.lateral_stiffness
    c = layer.damping if vertical else layer.lateral_damping
    bed = element.foundation()
    seats = 2 * np.arange(n_seats)
    lumped = np.zeros(2 * n_seats)
    lumped[seats] = sleepers
    return (
        seats,
        np.repeat(positions, 2),
        (
            sp.csr_array(chain_of(element.mass(), track.n_bays) + sp.diags_array(lumped)),
            chain_of(c * bed, track.n_bays),
            chain_of(element.stiffness() + k * bed, track.n_bays),
        ),
    )


def chain_of(element_matrix: np.ndarray, n_elements: int) -> sp.csr_array:
    """Assemble equal two-node elements in a row, 2 dofs a node, (2n+2, 2n+2)."""
    dofs = 2 * np.arange(n_elements)[:, None] + np.arange(4)
    rows = np.repeat(dofs, 4, axis=1).ravel()
    columns = np.tile(dofs, (1, 4)).ravel()
    values = np.tile(element_matrix.ravel(), n_elements)
    size = 2 * n_elements + 2
    return sp.csr_array((values, (rows, columns)), shape=(size, size))

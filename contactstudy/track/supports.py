"""Join any discretised rail to its discrete supports.

A support sees the rail through one functional only: the average displacement over the pad's
footprint, a row of weights over a few rail dofs. So beam and solid rails share this assembly.
All dofs are then ordered by their position along the track, which keeps the matrices banded.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import canonical
from contactstudy.track.hermite import BeamElement
from contactstudy.track.model import Direction, DiscreteSupports, Slab, Track

PadMotion = Literal["Z", "Y", "roll"]
"""What a pad resists: vertical, lateral, and the rise of the foot's edge by roll, all in m."""


@dataclass(frozen=True)
class PadRow:
    """Average motion of the rail's foot over one pad's footprint: weights @ u[dofs]."""

    dofs: IntArray
    weights: Array


@dataclass(frozen=True)
class SupportedRail:
    """Symmetric matrices in an ordering along the track, and where each dof of the rail went."""

    mass: sp.csr_array
    damping: sp.csr_array
    stiffness: sp.csr_array
    rail_dofs: IntArray


def add_supports(
    mass: sp.sparray,
    damping: sp.sparray | None,
    stiffness: sp.sparray,
    rail_keys: Array,
    track: Track,
    pads: Mapping[PadMotion, Sequence[PadRow]],
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
    pads : mapping of {"Z", "Y", "roll"} to sequence of PadRow
        Motions of the foot that the pads resist, one row for each of
        `track.support_positions`; empty when there are none.
    """
    n_rail = mass.shape[0]
    support = track.support
    parts = (
        [_pads(support, track, motion, rows) for motion, rows in pads.items()]
        if isinstance(support, DiscreteSupports)
        else []
    )
    keys = np.concatenate([np.asarray(rail_keys, dtype=float), *(p.keys for p in parts)])
    n, begin = len(keys), n_rail
    order = np.argsort(keys, kind="stable")
    place = np.empty(n, dtype=np.int64)
    place[order] = np.arange(n)
    totals = [_embedded(part, n, 0) for part in (mass, damping, stiffness)]
    for part in parts:
        for i, below in enumerate((part.mass, part.damping, part.stiffness)):
            totals[i] = totals[i] + _embedded(below, n, begin)
        # pad elongation = motion of the rail's foot - displacement of the seat: d = G u
        G = _pad_matrix(part.rows, None if part.seats is None else begin + part.seats, n)
        squares = sp.csr_array(G.T @ G)
        totals[1] = totals[1] + part.pad_damping * squares
        totals[2] = totals[2] + part.pad_stiffness * squares
        begin += len(part.keys)

    def ordered(total: sp.csr_array) -> sp.csr_array:
        coo = sp.coo_array(total)
        rows, columns = coo.coords
        return canonical(sp.csr_array((coo.data, (place[rows], place[columns])), shape=(n, n)))

    M, C, K = (ordered(total) for total in totals)
    return SupportedRail(mass=M, damping=C, stiffness=K, rail_dofs=place[:n_rail])


@dataclass(frozen=True)
class _Pads:
    """Pads in one motion of the foot, and what they stand on."""

    rows: Sequence[PadRow]
    pad_stiffness: float
    pad_damping: float
    seats: IntArray | None
    keys: Array
    mass: sp.csr_array
    damping: sp.csr_array
    stiffness: sp.csr_array


def _pads(
    support: DiscreteSupports, track: Track, motion: PadMotion, rows: Sequence[PadRow]
) -> _Pads:
    k, c = support.pad_stiffness, support.pad_damping
    if motion == "roll":
        # springs k/b a width over the foot's width b, their elongation r 2y/b for the edge's
        # rise r: integral of (k/b) (2y/b)^2 dy = k/3. The sleeper does not roll.
        none = sp.csr_array((0, 0))
        return _Pads(rows, k / 3, c / 3, None, np.empty(0), none, none, none)
    if motion == "Y":
        k, c = support.lateral_pad_stiffness, support.lateral_pad_damping
    seats, keys, layer = _layer(support, track, motion)
    return _Pads(rows, k, c, seats, keys, *layer)


def _embedded(part: sp.sparray | None, n: int, begin: int) -> sp.csr_array:
    """A square matrix as the diagonal block from `begin` on of an (n, n) one."""
    if part is None:
        return sp.csr_array((n, n))
    coo = sp.coo_array(part)
    rows, columns = coo.coords
    return sp.csr_array((coo.data, (rows + begin, columns + begin)), shape=(n, n))


def _pad_matrix(pad_rows: Sequence[PadRow], seats: IntArray | None, n: int) -> sp.csr_array:
    """Elongation of every pad as a matrix over all dofs, (n_supports, n)."""
    count = len(pad_rows)
    rows = np.concatenate([np.full(len(pad.dofs), j) for j, pad in enumerate(pad_rows)])
    columns = np.concatenate([pad.dofs for pad in pad_rows])
    values = np.concatenate([pad.weights for pad in pad_rows])
    if seats is not None:
        if count != len(seats):
            raise ValueError(f"{count} pad rows for {len(seats)} supports")
        rows, columns = np.r_[rows, np.arange(count)], np.r_[columns, seats]
        values = np.r_[values, np.full(count, -1.0)]
    return sp.csr_array((values, (rows, columns)), shape=(count, n))


def _layer(
    support: DiscreteSupports, track: Track, direction: Direction
) -> tuple[IntArray, Array, tuple[sp.csr_array, sp.csr_array, sp.csr_array]]:
    """Seat dofs, dof positions and (M, C, K) of all that is below the pads."""
    layer, positions = support.layer, track.support_positions
    n_seats = len(positions)
    vertical = direction == "Z"
    sleepers = np.full(n_seats, support.sleeper_mass)
    k = layer.stiffness if vertical else layer.lateral_stiffness
    c = layer.damping if vertical else layer.lateral_damping
    if not isinstance(layer, Slab):
        eye = sp.eye_array(n_seats, format="csr")
        return np.arange(n_seats), positions, (sp.diags_array(sleepers).tocsr(), c * eye, k * eye)
    element = BeamElement(
        support.spacing,
        layer.bending_stiffness if vertical else layer.lateral_bending_stiffness,
        layer.mass_per_length,
    )
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


def chain_of(element_matrix: Array, n_elements: int) -> sp.csr_array:
    """Assemble equal two-node elements in a row, 2 dofs a node, (2n+2, 2n+2)."""
    dofs = 2 * np.arange(n_elements)[:, None] + np.arange(4)
    rows = np.repeat(dofs, 4, axis=1).ravel()
    columns = np.tile(dofs, (1, 4)).ravel()
    values = np.tile(element_matrix.ravel(), n_elements)
    size = 2 * n_elements + 2
    return sp.csr_array((values, (rows, columns)), shape=(size, size))

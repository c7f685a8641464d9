"""What joins rails, layer, decks and piers of a track on a bridge: pads, bed, bearings, ground.

Each is a row of weights over the dofs of all nodes, its elongation. Along the track a pad and the
layer have the values of the lateral direction, an assumption: sources rarely give them.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.track.bridge import GROUND, Stretch
from contactstudy.track.frame import Chain, Springs
from contactstudy.track.model import Slab
from contactstudy.track.space_beam import N_DOFS, RX, RY, RZ, UX, UY, UZ, Axis, displacement
from contactstudy.track.structure_nodes import Nodes

FOOT_WIDTH, FOOT_DEPTH = 0.15, 0.081
"""m, a rail's foot: its width, and how far it lies below the centroid; 60E1."""

_AXES: tuple[Axis, ...] = ("X", "Y", "Z")


def at_nodes(nodes: IntArray, row: Array, size: int) -> sp.csr_array:
    """One row (6,) over a section's motion at each of the nodes (m,); -1 is ground."""
    there = np.flatnonzero(nodes >= 0)
    columns = N_DOFS * nodes[there, None] + np.arange(N_DOFS)
    rows = np.broadcast_to(there[:, None], columns.shape)
    values = np.broadcast_to(row, columns.shape)
    return sp.csr_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=(len(nodes), size))


def along(chain: Chain, x: Array, row: Array, size: int) -> sp.csr_array:
    """One row (6,) over a section's motion at each X (m,) of a beam."""
    dofs, motion = chain.motion_at(x)
    weights = np.einsum("d,mdk->mk", row, motion)
    rows = np.broadcast_to(np.arange(len(x))[:, None], dofs.shape)
    return sp.csr_array((weights.ravel(), (rows.ravel(), dofs.ravel())), shape=(len(x), size))


def all_springs(nodes: Nodes, planar: bool) -> list[Springs]:
    """All springs and dampers; planar without those along the track, which lie off the axes."""
    axes: tuple[Axis, ...] = ("Z",) if planar else _AXES
    found = [*_pads(nodes, axes), *_beds(nodes, axes)]
    found += [bearing.springs for bearing in bearings(nodes, axes)]
    return [*found, *_foundations(nodes)]


def _pads(nodes: Nodes, axes: tuple[Axis, ...]) -> Iterator[Springs]:
    """Rail pads: mean motion of the foot over the footprint less the seat's."""
    support, size = nodes.support, N_DOFS * nodes.n
    seats = np.concatenate([part.seats for part in nodes.stretches])
    layer = np.concatenate([nodes.seat_nodes(k) for k in range(len(nodes.stretches))])
    half = 0.5 * nodes.bridge.rail_distance
    values = {"Z": (support.pad_stiffness, support.pad_damping)}
    values["X"] = values["Y"] = (support.lateral_pad_stiffness, support.lateral_pad_damping)
    for rail, side in zip(nodes.rails, (-half, half), strict=True):
        points, mean = _footprints(rail.x, seats, support.pad_length)
        for axis in axes:
            k, c = values[axis]
            rows = mean @ along(rail, points, displacement(axis, (0.0, 0.0, -FOOT_DEPTH)), size)
            rows = rows - at_nodes(layer, displacement(axis, (0.0, side, 0.0)), size)
            yield Springs(rows, np.full(len(seats), k), np.full(len(seats), c))
        # spread evenly over the foot's width b: integral of (k/b) y^2 dy = k b^2/12
        k, c = values["Z"]
        roll, spread = np.eye(N_DOFS)[RX], FOOT_WIDTH**2 / 12.0
        rows = mean @ along(rail, points, roll, size) - at_nodes(layer, roll, size)
        yield Springs(rows, np.full(len(seats), k * spread), np.full(len(seats), c * spread))


def _footprints(nodes: Array, seats: Array, length: float) -> tuple[Array, sp.csr_array]:
    """Positions (p,) whose weighted sums, (n_seats, p) @, are means over footprints on a beam.

    Two Gauss points between nodes are exact for its cubic shape functions.
    """
    if length == 0.0:
        return seats, sp.csr_array(sp.eye_array(len(seats)))
    points, weights, owner = list[Array](), list[Array](), list[Array]()
    gauss = np.array([-1.0, 1.0]) / np.sqrt(3.0)
    for number, seat in enumerate(seats):
        first, last = seat - 0.5 * length, seat + 0.5 * length
        inside = nodes[(nodes > first + 1e-9) & (nodes < last - 1e-9)]
        edges = np.concatenate([[first], inside, [last]])
        middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
        points.append((middle[:, None] + half[:, None] * gauss).ravel())
        weights.append(np.repeat(half / length, 2))
        owner.append(np.full(2 * len(half), number))
    x = np.concatenate(points)
    mean = (np.concatenate(weights), (np.concatenate(owner), np.arange(len(x))))
    return x, sp.csr_array(mean, shape=(len(seats), len(x)))


def _beds(nodes: Nodes, axes: tuple[Axis, ...]) -> Iterator[Springs]:
    """Layer below each rail: ballast under the half sleepers, or the bed under a slab."""
    layer, size = nodes.support.layer, N_DOFS * nodes.n
    half = 0.5 * nodes.bridge.rail_distance
    vertical, lateral = (
        (layer.stiffness, layer.damping),
        (layer.lateral_stiffness, layer.lateral_damping),
    )
    for number, part in enumerate(nodes.stretches):
        chain = nodes.layers[number]
        x, share = _bed_points(chain, part, isinstance(layer, Slab))
        for side, y in zip((-half, half), nodes.bridge.lateral_of_rails, strict=True):
            for axis in axes:
                k, c = vertical if axis == "Z" else lateral
                row = displacement(axis, (0.0, side, 0.0))
                if isinstance(layer, Slab):
                    rows = along(chain, x, row, size)
                else:
                    rows = at_nodes(chain.nodes, row, size)
                if part.deck != GROUND:
                    arm = (0.0, y, nodes.bridge.track_height)
                    rows = rows - along(nodes.decks[part.deck], x, displacement(axis, arm), size)
                elif (ground := nodes.bridge.ground_stiffness) is not None:
                    ground = ground / nodes.support.spacing if nodes.on_slab else ground
                    k = k * ground / (k + ground)
                yield Springs(rows, k * share, c * share)


def _bed_points(chain: Chain, part: Stretch, slab: bool) -> tuple[Array, Array]:
    """Where the layer of a stretch is held, and what each place stands for: [m] of a slab, or 1."""
    if not slab:
        return part.seats, np.ones(len(part.seats))
    points, weights = np.polynomial.legendre.leggauss(4)
    half = 0.5 * np.diff(chain.x)[:, None]
    x = chain.x[:-1, None] + half * (1.0 + points)
    return x.ravel(), (half * weights).ravel()


@dataclass(frozen=True, eq=False)
class Bearings:
    """Bearings of one axis at one side Y [m] of all supports of a deck.

    Their elongation is the motion of the deck less that of the support: forces are positive in
    tension. `x` (m,) of the supports [m].
    """

    deck: int
    x: Array
    springs: Springs


def bearings(nodes: Nodes, axes: tuple[Axis, ...]) -> Iterator[Bearings]:
    """All bearings; along the track only the fixed support of a deck holds, by one spring."""
    bridge, size = nodes.bridge, N_DOFS * nodes.n
    half = 0.5 * bridge.bearing_distance
    for number, supports in enumerate(bridge.decks):
        for axis in axes:
            fixed = supports[:1] if bridge.fixed_support == "first" else supports[-1:]
            x = fixed if axis == "X" else supports
            deck, tops = nodes.deck_node(number, x), nodes.pier_tops(x)
            k, c = bridge.lateral_bearing_stiffness, 0.0
            if axis == "Z":
                k, c = bridge.bearing_stiffness, bridge.bearing_damping
            # along the track in the middle, where it does not hold a deck against turning
            for side in (0.0,) if axis == "X" else (-half, half):
                row = displacement(axis, (0.0, side, -bridge.bearing_depth))
                rows = at_nodes(deck, row, size)
                rows = rows - at_nodes(tops, displacement(axis, (0.0, side, 0.0)), size)
                springs = Springs(rows, np.full(len(x), k), np.full(len(x), c))
                yield Bearings(number, x, springs)


def _foundations(nodes: Nodes) -> Iterator[Springs]:
    pier = nodes.bridge.piers
    if pier is None or not nodes.piers:
        return
    feet = np.array([chain.nodes[0] for chain in nodes.piers])
    horizontal = pier.horizontal_stiffness, pier.horizontal_damping
    rocking = pier.rocking_stiffness, pier.rocking_damping
    values = {UX: horizontal, UY: horizontal, UZ: (pier.vertical_stiffness, pier.vertical_damping)}
    values |= {RX: rocking, RY: rocking, RZ: rocking}
    for dof, (k, c) in values.items():
        rows = at_nodes(feet, np.eye(N_DOFS)[dof], N_DOFS * nodes.n)
        yield Springs(rows, np.full(len(feet), k), np.full(len(feet), c))

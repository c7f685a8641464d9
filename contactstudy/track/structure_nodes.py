"""The nodes of a track on a bridge, the beams through them, and which of their dofs there are."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.track.bridge import Bridge, Stretch, nodes_of_rail, of_support, stretches
from contactstudy.track.frame import Chain, numbered
from contactstudy.track.model import DiscreteSupports, Slab, Track
from contactstudy.track.rail import Rail
from contactstudy.track.space_beam import N_DOFS, RX, RY, RZ, UX, UY, UZ, SpaceBeam

SLAB_WIDTH = 2.5
"""m, of a slab and of a whole sleeper."""
_SLAB_POISSON_RATIO = 0.2


@dataclass(frozen=True, eq=False)
class Nodes:
    """Nodes of a track on a bridge; "rails" are the right and the left one.

    Parameters
    ----------
    x, rank : ndarray
        (n,) X of each node [m], and its place among those of one X.
    layers : tuple of Chain
        Of each stretch: of a slab the beam, of sleepers their nodes.
    feet, tops : ndarray of int
        Nodes of the piers of inner supports; empty where supports are rigid.
    """

    bridge: Bridge
    support: DiscreteSupports
    stretches: tuple[Stretch, ...]
    x: Array
    rank: IntArray
    rails: tuple[Chain, Chain]
    layers: tuple[Chain, ...]
    decks: tuple[Chain, ...]
    piers: tuple[Chain, ...]

    @property
    def n(self) -> int:
        """Number of nodes."""
        return len(self.x)

    @property
    def on_slab(self) -> bool:
        """Whether the rails stand on a slab."""
        return isinstance(self.support.layer, Slab)

    @property
    def beams(self) -> Sequence[Chain]:
        """All beams."""
        slabs = self.layers if self.on_slab else ()
        return (*self.rails, *slabs, *self.decks, *self.piers)

    def seat_nodes(self, number: int) -> IntArray:
        """Nodes of the layer under the rail seats of a stretch."""
        layer = self.layers[number]
        return layer.nodes[1:-1] if self.on_slab else layer.nodes

    def deck_node(self, deck: int, x: Array) -> IntArray:
        """Nodes of a deck at supports X [m]."""
        chain = self.decks[deck]
        return chain.nodes[of_support(x, chain.x)]

    def pier_tops(self, x: Array) -> IntArray:
        """Tops of the piers at supports X [m], -1 where the support is rigid ground."""
        tops = np.full(len(x), -1, dtype=np.int64)
        inner = self.bridge.supports[1:-1]
        if self.piers and len(inner):
            nearest = of_support(x, inner)
            there = np.abs(inner[nearest] - x) < 1e-6
            tops[there] = [self.piers[k].nodes[1] for k in nearest[there]]
        return tops

    def dofs(self, planar: bool) -> IntArray:
        """Final dof of each dof of each node (n, 6)."""
        kept = np.ones((self.n, N_DOFS), dtype=bool)
        alike = np.arange(self.n)
        if planar:
            kept[:, [UX, UY, RX, RZ]] = False
            alike[self.rails[1].nodes] = self.rails[0].nodes
            for pier in self.piers:
                kept[pier.nodes, RY] = False
        if not self.on_slab:
            for layer in self.layers:
                kept[layer.nodes, RY] = False  # nothing holds a sleeper against pitching
        for rail in self.rails:
            kept[rail.nodes[[0, -1]]] = False
        return numbered(self.x, self.rank, kept, alike)

    @cached_property
    def bodies(self) -> Array:
        """Lumped masses and moments of inertia (n, 6): sleepers, caps and footings of piers."""
        bodies = np.zeros((self.n, N_DOFS))
        sleeper = 2.0 * self.support.sleeper_mass
        roll = sleeper * SLAB_WIDTH**2 / 12.0
        for number in range(len(self.layers)):
            bodies[self.seat_nodes(number)] += [sleeper, sleeper, sleeper, roll, 0.0, roll]
        if self.bridge.piers is not None:
            for pier in self.piers:
                bodies[pier.nodes[0], UX : UZ + 1] += self.bridge.piers.footing_mass
                bodies[pier.nodes[1], UX : UZ + 1] += self.bridge.piers.cap_mass
        return bodies


def nodes_of(track: Track, theory: str, per_bay: int) -> Nodes:
    """The nodes of a track on a bridge, `per_bay` elements of each rail between supports."""
    bridge, support = track.structure, track.support
    assert bridge is not None
    assert isinstance(support, DiscreteSupports)
    parts = stretches(bridge, support.spacing)
    x, rank = list[Array](), list[IntArray]()

    def add(at: Array, place: int) -> IntArray:
        first = sum(map(len, x))
        x.append(np.asarray(at, dtype=float))
        rank.append(np.full(len(at), place))
        return first + np.arange(len(at))

    along = nodes_of_rail(parts, per_bay)
    rail = beam_of_rail(track.rail, theory)
    rails = Chain(add(along, 0), along, rail), Chain(add(along, 1), along, rail)
    layers = []
    for part in parts:
        at = part.seats
        if isinstance(support.layer, Slab):
            at = np.concatenate([[part.start], at, [part.end]])
        layers.append(Chain(add(at, 2), at, beam_of_slab(support.layer)))
    decks = []
    for part in (part for part in parts if part.deck >= 0):
        at = np.unique(np.round(np.r_[part.seats, bridge.decks[part.deck]], 9))
        decks.append(Chain(add(at, 3), at, bridge.deck.beam, bridge.rayleigh or (0.0, 0.0)))
    piers = []
    if bridge.piers is not None:
        pier = bridge.piers
        column = SpaceBeam(
            axial_stiffness=pier.youngs_modulus * pier.area,
            bending_stiffness=pier.youngs_modulus * pier.second_moment,
            lateral_bending_stiffness=pier.youngs_modulus * pier.lateral_second_moment,
            torsion_stiffness=pier.youngs_modulus / 2.4 * pier.torsion_constant,
            mass_per_length=pier.density * pier.area,
            polar_inertia=pier.density * (pier.second_moment + pier.lateral_second_moment),
        )
        for at in bridge.supports[1:-1]:
            nodes = np.r_[add(np.array([at]), 4), add(np.array([at]), 5)]
            piers.append(Chain(nodes, np.array([0.0, pier.height]), column, upright=True))
    return Nodes(
        bridge,
        support,
        parts,
        np.concatenate(x),
        np.concatenate(rank),
        rails,
        tuple(layers),
        tuple(decks),
        tuple(piers),
    )


def beam_of_rail(rail: Rail, theory: str) -> SpaceBeam:
    """A rail in space, by Euler's or Timoshenko's theory in both planes."""
    section = rail.section
    polar = section.second_moment_y + section.second_moment_z
    shear = {}
    if theory == "timoshenko":
        shear = {
            "shear_stiffness": rail.shear_stiffness("Z"),
            "lateral_shear_stiffness": rail.shear_stiffness("Y"),
            "rotary_inertia": rail.rotary_inertia("Z"),
            "lateral_rotary_inertia": rail.rotary_inertia("Y"),
        }
    return SpaceBeam(
        axial_stiffness=rail.youngs_modulus * section.area,
        bending_stiffness=rail.bending_stiffness("Z"),
        lateral_bending_stiffness=rail.bending_stiffness("Y"),
        torsion_stiffness=rail.torsion_stiffness,
        mass_per_length=rail.mass_per_length,
        polar_inertia=rail.density * polar,
        **shear,
    )


def beam_of_slab(layer: object) -> SpaceBeam:
    """A whole slab; of sleepers, whose nodes nothing joins, a beam that is never assembled.

    `Slab` holds half a slab's bending stiffness. A thin rectangle b t has I = b t^3/12 and
    J = b t^3/3, so GJ = 4 EI/2(1 + nu); and I_z = t b^3/12, so EA = 12 EI_z/b^2.
    """
    if not isinstance(layer, Slab):
        return SpaceBeam(1.0, 1.0, 1.0, 1.0, 1.0, 1.0)
    bending, lateral = 2.0 * layer.bending_stiffness, 2.0 * layer.lateral_bending_stiffness
    mass = 2.0 * layer.mass_per_length
    return SpaceBeam(
        axial_stiffness=12.0 * lateral / SLAB_WIDTH**2,
        bending_stiffness=bending,
        lateral_bending_stiffness=lateral,
        torsion_stiffness=4.0 * bending / (2.0 * (1.0 + _SLAB_POISSON_RATIO)),
        mass_per_length=mass,
        polar_inertia=mass * SLAB_WIDTH**2 / 12.0,
    )

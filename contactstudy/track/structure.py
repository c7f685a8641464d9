"""The track on a bridge: both rails, their supports, decks, bearings and piers as one system.

Planar, all parts move vertically only and both rails move as one; in space every node has six
dofs. Dofs are ordered along the track, so that the matrices are banded.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.irregularity.shapes import smoothstep
from contactstudy.track.beam import BeamTrack, RailTheory
from contactstudy.track.bridge import Bridge, of_support
from contactstudy.track.deck_modes import modal_dampers
from contactstudy.track.discrete import AssembledTrack, without_held
from contactstudy.track.frame import Chain, Frame
from contactstudy.track.model import Track
from contactstudy.track.rail import Direction
from contactstudy.track.space_beam import N_DOFS, RX, RY, RZ, UY, UZ, Axis, displacement
from contactstudy.track.structure_nodes import Nodes, nodes_of
from contactstudy.track.structure_springs import all_springs, along, at_nodes, bearings
from contactstudy.track.supports import SupportedRail
from contactstudy.validation import Parameters, Same

RIGHT, LEFT = 0, 1
"""The rails, seen along +X."""
HEAD_HEIGHT = 0.091
"""m, running surface above a rail's centroid; 60E1."""

# dofs of a section that a direction at the running surface feels
_FELT = {"Z": (UZ, RY), "Y": (UY, RX, RZ)}


@dataclass(frozen=True)
class StructureTrack(AssembledTrack, Parameters):
    """A discretised track on a bridge.

    Parameters
    ----------
    track : Track
        With a `structure`, on discrete supports.
    planar : bool
        Vertical motion only, both rails as one; else in space.

    Raises
    ------
    InputError
        If there is no bridge, or its deck's lateral values are unknown in space.
    """

    track: Track
    theory: Annotated[RailTheory, Same(BeamTrack, "theory")] = "euler"
    elements_per_bay: Annotated[int, Same(BeamTrack, "elements_per_bay")] = 4
    planar: Annotated[bool, "vertical motion only, both rails as one"] = True

    direction: ClassVar[Direction] = "Z"
    element_compliance: ClassVar[bool] = False

    def __post_init__(self) -> None:
        """Refuse a track without a bridge and a deck whose lateral values are unknown."""
        super().__post_init__()
        problems = list[str]()
        if self.track.structure is None:
            problems = ["StructureTrack.track: stands on the ground; give it a `structure`"]
        elif not self.planar and (missing := self.track.structure.deck.missing):
            problems = [f"deck {name}: is not known; a run in space needs it" for name in missing]
        if problems:
            raise InputError(problems)

    @property
    def bridge(self) -> Bridge:
        """The bridge."""
        assert self.track.structure is not None
        return self.track.structure

    @property
    def n_dofs_forecast(self) -> int:
        """Number of dofs, without assembling anything."""
        return int(self.nodes.dofs(self.planar).max()) + 1

    def rail_rows(self, x: Array) -> tuple[IntArray, Array]:
        """See `DiscreteTrack`: the right rail, vertical, without the entry."""
        return self._rows(x, RIGHT, "Z")

    def contact_rows(self, x: Array, rail: int, direction: Direction) -> tuple[IntArray, Array]:
        """As `rail_rows` (m, k), of a rail's running surface as a wheel at X (m,) feels it.

        Beyond both ends it is rigid ground; over the entry length it becomes the rail.
        """
        x = np.asarray(x, dtype=float)
        dofs, weights = self._rows(x, rail, direction)
        return dofs, weights * self.on_track(x)[:, None]

    def on_track(self, x: Array) -> Array:
        """Share of a wheel at X (m,) that the track carries, 0 on the ground beyond its ends."""
        inside = np.minimum(x, self.track.length - x)
        return smoothstep(inside / self.bridge.entry_length)

    def local_compliance(self, x: Array) -> Array:
        """Zero: as the paper's scheme, without the loaded element's own deflection."""
        return np.zeros(np.shape(x))

    def top_load_compliance(self, x: Array) -> Array:
        """Zero, for a beam's section moves as one."""
        return np.zeros(np.shape(x))

    def _rows(self, x: Array, rail: int, direction: Direction) -> tuple[IntArray, Array]:
        height = HEAD_HEIGHT if direction == "Y" else 0.0
        row = displacement(direction, (0.0, 0.0, height))
        return self.rows_of(self.nodes.rails[rail], x, row, _FELT[direction])

    def rows_of(
        self, chain: Chain, x: Array, row: Array, felt: tuple[int, ...] = tuple(range(N_DOFS))
    ) -> tuple[IntArray, Array]:
        """Dofs and weights (m, k) of a row (6,) over a beam's motion at X (m,).

        `felt` are the dofs of a node that matter.
        """
        dofs, motion = chain.motion_at(x)
        weights = np.einsum("d,mdk->mk", row, motion)
        columns = np.r_[np.array(felt), N_DOFS + np.array(felt)]
        return without_held(self._frame.dof.ravel()[dofs[:, columns]], weights[:, columns])

    def deck_at(self, x: float) -> int | None:
        """Number of the deck at X [m]; None on the approaches."""
        found = [k for k, ends in enumerate(self.bridge.decks) if ends[0] <= x <= ends[-1]]
        return found[0] if found else None

    def bearing_rows(self, axis: Axis) -> tuple[sp.csr_array, sp.csr_array]:
        """Forces on the supports along an axis in tension, (n_supports, n_dofs) @ u and @ v.

        All bearings of a support count together.
        """
        supports = self.bridge.supports
        forces = [sp.csr_array((len(supports), self.n_dofs)) for _ in range(2)]
        for one in bearings(self.nodes, (axis,)):
            at = of_support(one.x, supports)
            for k, values in enumerate((one.springs.stiffness, one.springs.damping)):
                gather = sp.csr_array(
                    (values, (at, np.arange(len(at)))), shape=(len(supports), len(at))
                )
                forces[k] = forces[k] + gather @ self._frame.selected(one.springs.rows)
        return sp.csr_array(forces[0]), sp.csr_array(forces[1])

    def chain_rows(self, chain: Chain, x: Array, row: Array) -> sp.csr_array:
        """A row (6,) over a beam's motion at each X (m,) [m], (m, n_dofs)."""
        return self._frame.selected(along(chain, x, row, self._frame.dof.size))

    def node_rows(self, nodes: IntArray, row: Array) -> sp.csr_array:
        """A row (6,) over the motion of each of the nodes (m,), (m, n_dofs)."""
        return self._frame.selected(at_nodes(nodes, row, self._frame.dof.size))

    @cached_property
    def nodes(self) -> Nodes:
        """Nodes and beams."""
        return nodes_of(self.track, self.theory, self.elements_per_bay)

    @cached_property
    def _frame(self) -> Frame:
        nodes = self.nodes
        springs = all_springs(nodes, self.planar)
        return Frame(nodes.beams, springs, nodes.bodies, nodes.dofs(self.planar))

    @cached_property
    def dampers(self) -> sp.csr_array | None:
        """Rows of the decks' modal damping."""
        if (up_to := self.bridge.damped_up_to) is None:
            return None
        return modal_dampers(self.nodes, self.planar, self.bridge.deck.damping_ratio, up_to)

    @cached_property
    def _assembled(self) -> SupportedRail:
        M, C, K = self._frame.matrices
        rail = self._frame.dof[self.nodes.rails[RIGHT].nodes]
        return SupportedRail(M, C, K, rail[rail >= 0])

"""A bridge and the train on it at many instants, for pictures, an animation and ParaView."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.stepper import Coupling, State
from contactstudy.solvers.observers import Observer, Watch
from contactstudy.solvers.passage import Passage
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.space_beam import Axis, displacement
from contactstudy.track.structure import HEAD_HEIGHT, StructureTrack
from contactstudy.track.structure_springs import FOOT_DEPTH

if TYPE_CHECKING:
    import xarray as xr

RAIL, DECK, PIER = range(3)
"""What a node belongs to."""
MARGIN = 10.0
"""m before and behind the bridge: frames begin and end with a wheel there."""


@dataclass(frozen=True)
class BridgeFrames(Observer):
    """Keeps the motion of rails, decks, piers and vehicle at evenly spaced steps.

    They lie between the first wheel's coming to the bridge and the last one's leaving it. The
    dataset gets::

        frame_displacement (frame, axis, node)  of the nodes, "Z", in space also "X" and "Y" [m]
        frame_vehicle (frame, vehicle_dof)      displacements of the vehicle's bodies
        frame_time, frame_position (frame)      position of the leading wheel [m]
        node_x, node_y, node_z (node)           at rest, from the decks' axis [m]
        node_part, node_chain (node)            `RAIL`, `DECK` or `PIER`; neighbours of one chain
                                                are joined
        car_outline (car, end)                  of cars front end, bogies and rear end, from the
                                                leading wheel, at most its front end positive [m]
    """

    count: int
    outlines: tuple[tuple[float, float, float, float], ...] = ()

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        return _Frames(cast(Passage[StructureTrack], passage), self.count, self.outlines)


@dataclass(frozen=True)
class _Nodes:
    """Nodes (n,) that are kept: numbers, positions at rest (n, 3), parts and chains."""

    number: IntArray
    place: Array
    part: IntArray
    chain: IntArray


class _Frames(Watch):
    def __init__(self, passage: Passage[StructureTrack], count: int, outlines: Any) -> None:
        self._outlines = outlines
        track, supports = passage.track, passage.track.bridge.supports
        self._axes: tuple[Axis, ...] = ("Z",) if track.planar else ("X", "Y", "Z")
        self._nodes, self._passage = _kept(track), passage
        self._rows = sp.csr_array(
            sp.vstack(
                [
                    track.node_rows(self._nodes.number, displacement(axis, (0.0, 0.0, 0.0)))
                    for axis in self._axes
                ]
            )
        )
        x = passage.positions
        near = ((x >= supports[0] - MARGIN) & (x <= supports[-1] + MARGIN)).any(axis=1)
        steps = np.flatnonzero(near)
        some = np.linspace(0, max(len(steps) - 1, 0), min(count, len(steps)))
        self._steps = steps[np.round(some).astype(np.int64)]
        self._at = {int(step): k for k, step in enumerate(self._steps)}
        shape = len(self._steps), len(self._axes), len(self._nodes.number)
        # single precision holds more digits than a picture shows
        self._moved = np.empty(shape, dtype=np.float32)
        self._vehicle = np.empty((len(self._steps), passage.vehicle.n_dofs), dtype=np.float32)

    def see(self, state: State) -> None:
        k = self._at.get(state.step)
        if k is None:
            return
        n = self._passage.track.n_dofs
        self._moved[k] = (self._rows @ state.u[:n]).reshape(self._moved.shape[1:])
        self._vehicle[k] = state.u[n : n + self._vehicle.shape[1]]

    def into(self, data: xr.Dataset) -> xr.Dataset:
        if not len(self._steps):
            return data
        nodes, passage = self._nodes, self._passage
        metre = {"units": "m"}
        found: dict[str, Any] = {
            "frame_displacement": (("frame", "axis", "node"), self._moved, metre),
            "frame_vehicle": (("frame", "vehicle_dof"), self._vehicle, {"units": "m or rad"}),
            "frame_time": ("frame", passage.journey.times[self._steps], {"units": "s"}),
            "frame_position": ("frame", passage.positions[self._steps, 0], metre),
            "node_part": ("node", nodes.part),
            "node_chain": ("node", nodes.chain),
            **{f"node_{n}": ("node", nodes.place[:, k], metre) for k, n in enumerate("xyz")},
        }
        if self._outlines:
            found["car_outline"] = (("car", "end"), np.array(self._outlines), metre)
        coords = {"axis": list(self._axes), "vehicle_dof": list(passage.vehicle.dof_names)}
        return data.assign(found).assign_coords(coords)


def _kept(track: StructureTrack) -> _Nodes:
    """Rails at their seats and ends, all nodes of decks and piers; planar one rail for both."""
    nodes, bridge = track.nodes, track.bridge
    low = bridge.track_height + FOOT_DEPTH
    per_bay = track.elements_per_bay
    numbers, places = list[IntArray](), list[Array]()
    parts, chains = list[IntArray](), list[IntArray]()

    def add(number: IntArray, x: Array, y: float, z: Array, part: int) -> None:
        z = np.broadcast_to(z, x.shape)
        numbers.append(number)
        places.append(np.stack([x, np.full(len(x), y), z], axis=1))
        parts.append(np.full(len(x), part))
        chains.append(np.full(len(x), len(chains)))

    rails = nodes.rails[:1] if track.planar else nodes.rails
    sides = (bridge.track_offset,) if track.planar else bridge.lateral_of_rails
    half = -(-per_bay // 2)  # elements of the half bays at both ends
    for rail, y in zip(rails, sides, strict=True):
        some = np.r_[0, np.arange(half, len(rail.x) - 1, per_bay), len(rail.x) - 1]
        add(rail.nodes[some], rail.x[some], y, np.array(low), RAIL)
    for deck in nodes.decks:
        add(deck.nodes, deck.x, 0.0, np.array(0.0), DECK)
    for pier, x in zip(nodes.piers, bridge.supports[1:-1], strict=False):
        top = -bridge.bearing_depth
        z = top - pier.x[-1] + pier.x
        add(pier.nodes, np.full(len(z), x), 0.0, z, PIER)
    return _Nodes(
        np.concatenate(numbers),
        np.concatenate(places),
        np.concatenate(parts),
        np.concatenate(chains),
    )


def frame_steps(run: xr.Dataset) -> IntArray:
    """Time steps of the frames that a run has kept, (frame,)."""
    return np.searchsorted(run["time"].values, run["frame_time"].values - 1e-9)


def running_surface(track_height: float) -> float:
    """Height of the rails' running surface above the decks' axis [m]."""
    return track_height + FOOT_DEPTH + HEAD_HEIGHT

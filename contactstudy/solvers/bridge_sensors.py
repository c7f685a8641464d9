"""What is recorded of a bridge: rows over its dofs for rails, decks, piers and bearings.

In a planar run all parts move along Z only; in space there are "lateral" (Y) and "longitudinal"
(X) histories beside those along Z, whose names have no such word.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.track.frame import Chain
from contactstudy.track.space_beam import N_DOFS, RX, Axis, displacement
from contactstudy.track.structure import LEFT, RIGHT, StructureTrack
from contactstudy.track.structure_springs import FOOT_DEPTH

_WORDS: dict[Axis, str] = {"Z": "", "Y": "lateral_", "X": "longitudinal_"}
_WAYS: dict[Axis, str] = {"Z": "up", "Y": "to the left of +X", "X": "along +X"}
_MOTIONS = (("displacement", "m"), ("velocity", "m/s"), ("acceleration", "m/s^2"))
_BODIES = {
    "station": "the right rail's axis at the station",
    "station_left": "the left rail's axis at the station",
    "deck": "the deck's axis at the station",
    "pier": "the pier's top",
}
_STRAINS = {
    "station_strain": "strain of the right rail along the track under the middle of its foot",
    "station_left_strain": "strain of the left rail there",
    "deck_strain": "strain of the deck along the track at the gauge's depth",
}
_PUSH = {"Z": "positive in compression", "Y": "to the left of +X", "X": "along +X"}


def motion_name(body: str, axis: Axis, order: int) -> str:
    """Name of a history of a body: "deck_acceleration", "pier_lateral" (a displacement)."""
    motion = _MOTIONS[order][0]
    name = f"{body}_{_WORDS[axis]}{motion}"
    return name if axis == "Z" or order else name.removesuffix(f"_{motion}")


def force_name(axis: Axis) -> str:
    """Name of the forces on supports along an axis."""
    return f"bearing_{_WORDS[axis]}force"


def _variables() -> dict[str, tuple[str, str]]:
    found = {
        motion_name(body, axis, order): (unit, f"{motion} of {text}, {_WAYS[axis]}")
        for body, text in _BODIES.items()
        for axis in _WORDS
        for order, (motion, unit) in enumerate(_MOTIONS)
    }
    found["deck_roll"] = "rad", "roll of the deck at the station"
    found |= {name: ("1", f"{text}, positive in tension") for name, text in _STRAINS.items()}
    for axis in _WORDS:
        text = f"force of all bearings on a support along {axis}, {_PUSH[axis]}"
        found[force_name(axis)] = "N", text
    return found


VARIABLES = _variables()
"""Unit and description of each history that may be recorded."""
ON_SUPPORTS = ("pier_", "bearing_")
"""How the names of those begin that stand at supports; the others stand at stations."""
IN_SPACE = tuple(
    name
    for name in VARIABLES
    if any(word in name for word in ("lateral", "longitudinal", "left", "roll"))
)
"""Those that a planar run does not have."""


@dataclass(frozen=True, eq=False)
class Sensor:
    """A history: ``of_u @ u + of_v @ v + of_a @ a`` at some places of a dimension.

    Parameters
    ----------
    dim : str
        "station" or "support".
    places : ndarray of int
        (k,) numbers of the stations or supports that it exists at.
    rows : dict
        Order of the time derivative -> rows (k, n_dofs).
    """

    name: str
    dim: str
    places: IntArray
    rows: dict[int, sp.csr_array]


def sensors(track: StructureTrack, stations: Sequence[float]) -> Iterator[Sensor]:
    """All that is recorded of a track on a bridge."""
    axes: tuple[Axis, ...] = ("Z",) if track.planar else ("Z", "Y", "X")
    nodes, x = track.nodes, np.asarray(stations, dtype=float)
    everywhere = np.arange(len(x))
    rails = {"station": RIGHT} if track.planar else {"station": RIGHT, "station_left": LEFT}
    for body, rail in rails.items() if len(x) else ():
        chain = nodes.rails[rail]
        for axis in axes:
            rows = track.chain_rows(chain, x, displacement(axis, (0.0, 0.0, 0.0)))
            yield from _motions(body, axis, "station", everywhere, rows)
        yield Sensor(
            f"{body}_strain", "station", everywhere, {0: strain_rows(track, chain, x, FOOT_DEPTH)}
        )
    yield from _decks(track, x, axes)
    if nodes.piers:
        tops = np.array([pier.nodes[1] for pier in nodes.piers])
        for axis in axes:
            rows = track.node_rows(tops, displacement(axis, (0.0, 0.0, 0.0)))
            yield from _motions("pier", axis, "support", 1 + np.arange(len(tops)), rows)
    for axis in axes:
        spring, damper = track.bearing_rows(axis)
        sign = (
            -1.0 if axis == "Z" else 1.0
        )  # rows are of tension, the deck's motion less the pier's
        places = np.arange(spring.shape[0])
        rows = {0: sign * spring, 1: sign * damper}
        yield Sensor(force_name(axis), "support", places, rows)


def _decks(track: StructureTrack, x: Array, axes: Sequence[Axis]) -> Iterator[Sensor]:
    on = [(k, deck) for k, one in enumerate(x) if (deck := track.deck_at(float(one))) is not None]
    if not on:
        return
    places = np.array([k for k, _ in on])
    chains = [track.nodes.decks[deck] for _, deck in on]

    def stacked(row: Array) -> sp.csr_array:
        made = [track.chain_rows(c, x[[k]], row) for c, k in zip(chains, places, strict=True)]
        return sp.csr_array(sp.vstack(made))

    for axis in axes:
        rows = stacked(displacement(axis, (0.0, 0.0, 0.0)))
        yield from _motions("deck", axis, "station", places, rows)
    if not track.planar:
        yield Sensor("deck_roll", "station", places, {0: stacked(np.eye(N_DOFS)[RX])})
    depth = track.bridge.gauge_depth
    strains = [strain_rows(track, c, x[[k]], depth) for c, k in zip(chains, places, strict=True)]
    yield Sensor("deck_strain", "station", places, {0: sp.csr_array(sp.vstack(strains))})


def _motions(
    body: str, axis: Axis, dim: str, places: IntArray, rows: sp.csr_array
) -> Iterator[Sensor]:
    """Displacement, velocity and acceleration."""
    for order in range(len(_MOTIONS)):
        yield Sensor(motion_name(body, axis, order), dim, places, {order: rows})


def strain_rows(track: StructureTrack, chain: Chain, x: Array, depth: float) -> sp.csr_array:
    """Rows (m, n_dofs) of a beam's strain along X at a depth below its axis, at X (m,).

    The displacement of such a point is u_x - depth r_y, and its derivative the strain. u_x is
    linear and r_y a parabola within an element, so that their central difference is exact; on a
    node it is the mean of both elements.
    """
    along, half = displacement("X", (0.0, 0.0, -depth)), 1e-3
    before, behind = (track.chain_rows(chain, at, along) for at in (x - half, x + half))
    return sp.csr_array((behind - before) / (2.0 * half))

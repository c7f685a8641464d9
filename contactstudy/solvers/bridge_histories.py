"""Histories of decks and bearings, beside those of wheels and rails."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.rows import row_values
from contactstudy.dynamics.stepper import State
from contactstudy.solvers.observers import Watch
from contactstudy.solvers.passage import Passage
from contactstudy.track.frame import Chain
from contactstudy.track.space_beam import N_DOFS, RX, RY, Axis, displacement
from contactstudy.track.structure import StructureTrack

if TYPE_CHECKING:
    import xarray as xr

_NOT_THERE = np.nan
_VARIABLES: dict[str, tuple[str, str]] = {
    "deck_displacement": ("m", "displacement of the deck's axis at the station, up"),
    "deck_static": ("m", "the same under the wheels' static loads alone, without dynamics"),
    "deck_acceleration": ("m/s^2", "acceleration of the deck's axis at the station, up"),
    "deck_lateral": ("m", "lateral displacement of the deck's axis at the station"),
    "deck_lateral_acceleration": ("m/s^2", "lateral acceleration of the deck's axis there"),
    "deck_roll": ("rad", "roll of the deck at the station"),
    "deck_strain": ("1", "strain of the deck along the track at the gauge's depth, in tension"),
    "bearing_force": ("N", "force of all bearings of a support, positive in compression"),
}


class BridgeHistories(Watch):
    """Records decks at the journey's stations, and the vertical force on each support.

    The dataset gets `deck_displacement`, `deck_acceleration` and `deck_strain` (station, time), of
    bending in the vertical plane at the depth of the bridge's gauges; in space also
    `deck_lateral`, `deck_lateral_acceleration` and `deck_roll`; NaN where a station lies on an
    approach. `deck_static` is what the static wheel loads alone would make of `deck_displacement`:
    by reciprocity the sum over the wheels of load times N(X) K^-1 of a unit force on the deck.
    `bearing_force` (support, time) is that of both decks on a pier, without dead load.
    """

    def __init__(self, passage: Passage[StructureTrack]) -> None:
        track, self._steps = passage.track, passage.journey.n_steps + 1
        stations = np.asarray(passage.journey.stations, dtype=float)
        decks = [track.deck_at(float(x)) for x in stations]
        self._there = [k for k, deck in enumerate(decks) if deck is not None]
        self._count = len(stations)
        axes: list[tuple[str, Array]] = [("deck_displacement", _row("Z"))]
        if not track.planar:
            axes += [("deck_lateral", _row("Y")), ("deck_roll", np.eye(6)[RX])]
        self._rows = {
            name: [
                track.rows_of(track.nodes.decks[deck], stations[[k]], row)
                for k, deck in enumerate(decks)
                if deck is not None
            ]
            for name, row in axes
        }
        self._rows["deck_strain"] = [
            _strain_row(track, track.nodes.decks[deck], float(x))
            for x, deck in zip(stations, decks, strict=True)
            if deck is not None
        ]
        self._travelling, self._loads = passage.rail_rows.at, passage.static_loads
        self._influence = _influence(track, self._rows["deck_displacement"])
        names = [
            "deck_static",
            *self._rows,
            *(_ACCELERATIONS[n] for n in self._rows if n in _ACCELERATIONS),
        ]
        self._kept = {name: np.empty((self._steps, len(self._there))) for name in names}
        self._supports, self._spring, self._damper = track.bearing_forces
        self._bearing = np.empty((self._steps, len(self._supports)))

    def see(self, state: State) -> None:
        """Record a state."""
        for name, rows in self._rows.items():
            for k, row in enumerate(rows):
                self._kept[name][state.step, k] = row_values(*row, state.u)[0]
                if name in _ACCELERATIONS:
                    of = self._kept[_ACCELERATIONS[name]]
                    of[state.step, k] = row_values(*row, state.a)[0]
        rail = self._travelling(state.step)
        for k, influence in enumerate(self._influence):
            static = -float(self._loads @ row_values(*rail, influence))
            self._kept["deck_static"][state.step, k] = static
        n = self._spring.shape[1]  # the track's dofs come first
        self._bearing[state.step] = -(self._spring @ state.u[:n] + self._damper @ state.v[:n])

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add the histories."""
        import xarray as xr

        found = {}
        for name, values in self._kept.items():
            if not self._there:
                continue
            whole = np.full((self._count, self._steps), _NOT_THERE)
            whole[self._there] = values.T
            found[name] = _variable("station", whole, name)
        found["bearing_force"] = _variable("support", self._bearing.T, "bearing_force")
        at = {"units": "m", "long_name": "position of the abutment or pier"}
        supports = xr.Variable(("support",), self._supports, at)
        return data.assign(found).assign_coords(support=supports)


_ACCELERATIONS = {
    "deck_displacement": "deck_acceleration",
    "deck_lateral": "deck_lateral_acceleration",
}


def _row(axis: Axis) -> Array:
    return displacement(axis, (0.0, 0.0, 0.0))


def _influence(track: StructureTrack, rows: list[tuple[IntArray, Array]]) -> list[Array]:
    """K^-1 of a unit force in each row (n_dofs,) [m/N]."""
    if not rows:
        return []
    factor, found = Factor(track.stiffness), list[Array]()
    for dofs, weights in rows:
        load = np.zeros(track.n_dofs)
        np.add.at(load, dofs[0], weights[0])
        found.append(factor.solve(load))
    return found


def _strain_row(track: StructureTrack, deck: Chain, x: float) -> tuple[IntArray, Array]:
    """Row of the strain at the gauge's depth e: e w'' = -e d(r_y)/dX.

    The turn is a parabola within an element, so that its central difference is exact; on a node it
    is the mean of both elements.
    """
    turn, half = np.eye(N_DOFS)[RY], 1e-3
    (before, less), (behind, more) = (
        track.rows_of(deck, np.array([at]), turn) for at in (x - half, x + half)
    )
    factor = track.bridge.gauge_depth / (2.0 * half)
    return np.hstack([before, behind]), factor * np.hstack([less, -more])


def _variable(dim: str, values: Array, name: str) -> xr.Variable:
    import xarray as xr

    unit, text = _VARIABLES[name]
    return xr.Variable(
        (dim, "time"), np.ascontiguousarray(values), {"units": unit, "long_name": text}
    )

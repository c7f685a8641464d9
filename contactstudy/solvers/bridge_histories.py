"""Histories of rails, decks, piers and bearings, beside those of wheels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.rows import row_values
from contactstudy.dynamics.stepper import State
from contactstudy.solvers.bridge_levels import velocity_levels
from contactstudy.solvers.bridge_sensors import VARIABLES, sensors
from contactstudy.solvers.observers import Watch
from contactstudy.solvers.passage import Passage
from contactstudy.track.structure import StructureTrack

if TYPE_CHECKING:
    import xarray as xr

_STATIC = "deck_static"
_STATIC_TEXT = "deck_displacement under the wheels' static loads alone, without dynamics"


class BridgeHistories(Watch):
    """Records rails and decks at the journey's stations, piers and the forces on supports.

    The dataset gets the variables of `bridge_sensors.VARIABLES` (station or support, time), NaN
    where a station lies on an approach or a support has no pier. `deck_static` is what the static
    wheel loads alone would make of `deck_displacement`: by reciprocity the sum over the wheels of
    load times N(X) K^-1 of a unit force on the deck. Bearing forces are those of both decks on a
    pier, without dead load. Levels are those of `bridge_levels`.
    """

    def __init__(self, passage: Passage[StructureTrack]) -> None:
        track, journey = passage.track, passage.journey
        self._passage, self._n = passage, track.n_dofs
        self._sensors = list(sensors(track, journey.stations))
        steps = journey.n_steps + 1
        orders = sorted({k for one in self._sensors for k in one.rows})
        self._rows = {
            k: sp.csr_array(sp.vstack([one.rows[k] for one in self._sensors if k in one.rows]))
            for k in orders
        }
        self._kept = {k: np.empty((steps, rows.shape[0])) for k, rows in self._rows.items()}
        decks = [one for one in self._sensors if one.name == "deck_displacement"]
        self._influence = _influence(track, decks[0].rows[0]) if decks else np.zeros((0, self._n))
        self._static = np.empty((steps, len(self._influence)))

    def see(self, state: State) -> None:
        """Record a state."""
        n = self._n  # the track's dofs come first
        vectors = state.u[:n], state.v[:n], state.a[:n]
        for k, rows in self._rows.items():
            self._kept[k][state.step] = rows @ vectors[k]
        rail, loads = self._passage.rail_rows.at(state.step), self._passage.static_loads
        for k, influence in enumerate(self._influence):
            self._static[state.step, k] = -float(loads @ row_values(*rail, influence))

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """Add the histories and their levels."""
        import xarray as xr

        track, journey = self._passage.track, self._passage.journey
        supports = track.bridge.supports
        sizes = {"station": len(journey.stations), "support": len(supports)}
        first, found = dict.fromkeys(self._rows, 0), dict[str, xr.Variable]()
        for one in self._sensors:
            whole = np.full((sizes[one.dim], journey.n_steps + 1), np.nan)
            own = []
            for k in one.rows:
                own.append(self._kept[k][:, first[k] : first[k] + len(one.places)])
                first[k] += len(one.places)
            whole[one.places] = sum(own[1:], own[0]).T
            unit, text = VARIABLES[one.name]
            attrs = {"units": unit, "long_name": text}
            found[one.name] = xr.Variable((one.dim, "time"), whole, attrs)
            if one.name == "deck_displacement":
                still = np.full_like(whole, np.nan)
                still[one.places] = self._static.T
                attrs = {"units": unit, "long_name": _STATIC_TEXT}
                found[_STATIC] = xr.Variable((one.dim, "time"), still, attrs)
        at = {"units": "m", "long_name": "position of the abutment or pier"}
        coords = {"support": xr.Variable(("support",), supports, at)}
        # the recorder of the rail has its displacement already
        found = {name: one for name, one in found.items() if name not in data}
        data = data.assign(found).assign_coords(coords)
        return data.merge(velocity_levels(data, self._passage.positions))


def _influence(track: StructureTrack, rows: sp.csr_array) -> Array:
    """K^-1 of a unit force in each row (k, n_dofs) [m/N]."""
    factor = Factor(track.stiffness)
    return np.array([factor.solve(row) for row in rows.toarray()])

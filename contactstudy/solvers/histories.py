"""The recorder of a run: histories of wheels, rail and contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.point_steps import LaneRecord
from contactstudy.dynamics.rows import row_values
from contactstudy.dynamics.stepper import State
from contactstudy.solvers.dataset import history_dataset
from contactstudy.solvers.observers import Watch
from contactstudy.solvers.passage import Passage
from contactstudy.track.discrete import DiscreteTrack

if TYPE_CHECKING:
    import xarray as xr


class Histories(Watch):
    """Records every state of a passage.

    Of the contact it records what its steps record. "rail_residual" there is what the contact
    force adds to the deflection under the wheel beyond the track's dofs, and goes into
    `rail_displacement`.

    The rail's acceleration is that of the point of the rail which the wheel is passing,
    d2w/dt2 at fixed X = N(X) a with the rail's rows N: what an accelerometer there shows in that
    moment. It is not the second derivative of `rail_displacement` in time, for that follows the
    wheel from point to point, d2/dt2 w(vt, t) = w_tt + 2 v w_xt + v^2 w_xx; and what
    `rail_residual` adds has no inertia, so no part in it.
    """

    def __init__(self, passage: Passage[DiscreteTrack]) -> None:
        self._passage, self._wheels, self._rails = passage, passage.wheels, passage.rail_rows
        track, stations = passage.track, passage.journey.stations
        shape = passage.positions.shape
        self.at_stations = track.rail_rows(np.asarray(stations, dtype=float))
        self._stations = np.empty((shape[0], len(stations)))
        self._wheel_u, self._wheel_a = np.empty(shape), np.empty(shape)
        self._rail_u, self._rail_a = np.empty(shape), np.empty(shape)
        self._contact: dict[str, Array] = {}

    def see(self, state: State) -> None:
        """Record a state."""
        assert state.contact is not None
        step, u, a, record = state.step, state.u, state.a, state.contact.record
        if not self._contact:
            n_times = len(self._rail_u)
            self._contact = {k: np.empty((n_times, *np.shape(v))) for k, v in record.items()}
        for name, value in record.items():
            self._contact[name][step] = value
        rail = self._rails.at(step)
        self._wheel_u[step], self._wheel_a[step] = (row_values(*self._wheels, x) for x in (u, a))
        self._rail_u[step], self._rail_a[step] = (row_values(*rail, x) for x in (u, a))
        if self._stations.size:
            self._stations[step] = row_values(*self.at_stations, u)

    def take(self, steps: slice, lane: int, record: LaneRecord) -> None:
        """Record the states after some steps of a lane."""
        done = slice(0, steps.stop - steps.start), lane
        for name, values in self._contact.items():
            values[steps] = getattr(record, name)[done]
        self._wheel_u[steps], self._wheel_a[steps] = record.wheel_u[done], record.wheel_a[done]
        self._rail_u[steps], self._rail_a[steps] = record.rail_u[done], record.rail_a[done]
        self._stations[steps] = record.station_u[done]

    def into(self, data: xr.Dataset) -> xr.Dataset:
        """The labelled histories, with the attributes of a dataset."""
        contact, passage = dict(self._contact), self._passage
        top, beside = ~passage.lateral, passage.lateral
        force = contact.pop("contact_force")
        rail_u = self._rail_u + contact.pop("rail_residual")
        found = {
            "contact_force": force[:, top],
            "wheel_displacement": self._wheel_u[:, top],
            "wheel_acceleration": self._wheel_a[:, top],
            "rail_displacement": rail_u[:, top],
            "rail_acceleration": self._rail_a[:, top],
            "irregularity": passage.roughness[:, top],
            **contact,
        }
        if beside.any():
            # the rail gets the contact's force the other way round, and so is pushed to +Y
            found |= {
                "lateral_force": -force[:, beside],
                "wheel_lateral": self._wheel_u[:, beside],
                "wheel_lateral_acceleration": self._wheel_a[:, beside],
                "rail_lateral": rail_u[:, beside],
                "rail_lateral_acceleration": self._rail_a[:, beside],
                "lateral_irregularity": passage.roughness[:, beside],
            }
        return history_dataset(
            passage.journey,
            passage.positions[:, top],
            found,
            station_displacement=self._stations,
            attrs=data.attrs,
        )

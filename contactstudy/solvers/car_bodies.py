"""What the bodies of the cars of a train feel."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import IntArray
from contactstudy.dynamics.stepper import Coupling, State
from contactstudy.solvers.observers import Observer, Watch
from contactstudy.solvers.passage import Passage
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr

_BODY = re.compile(r"car (?P<dof>[zy])(?: (?P<number>[0-9]+))?")
_NAMES = {"z": ("car_acceleration", "vertical acceleration of the middle of the car body, up"),
          "y": ("car_lateral_acceleration", "lateral acceleration of the middle of the car body"),
          }  # fmt: skip


@dataclass(frozen=True)
class CarBodies(Observer):
    """Adds the accelerations of the bodies of all cars, (car, time), to the dataset of a run.

    Cars count from 1 at the front. A vehicle without car bodies gets nothing.
    """

    def watch(self, passage: Passage[DiscreteTrack], coupling: Coupling) -> Watch:
        """See `Observer`."""
        return _Bodies(passage)


class _Bodies(Watch):
    def __init__(self, passage: Passage[DiscreteTrack]) -> None:
        first, n = passage.track.n_dofs, passage.journey.n_steps + 1
        self._dofs = {dof: first + at for dof, at in bodies(passage.vehicle).items()}
        self._kept = {dof: np.empty((n, len(at))) for dof, at in self._dofs.items()}

    def see(self, state: State) -> None:
        for dof, at in self._dofs.items():
            self._kept[dof][state.step] = state.a[at]

    def into(self, data: xr.Dataset) -> xr.Dataset:
        import xarray as xr

        found = {
            _NAMES[dof][0]: xr.Variable(
                ("car", "time"),
                np.ascontiguousarray(kept.T),
                {"units": "m/s^2", "long_name": _NAMES[dof][1]},
            )
            for dof, kept in self._kept.items()
        }
        if not found:
            return data
        cars = next(iter(found.values())).shape[0]
        number = xr.Variable(("car",), np.arange(1, cars + 1), {"long_name": "car from the front"})
        return data.assign(found).assign_coords(car=number)


def bodies(vehicle: Vehicle) -> dict[str, IntArray]:
    """Dofs of the car bodies of a vehicle, "z" and of a vehicle in three dimensions "y"."""
    found: dict[str, list[int]] = {}
    for k, name in enumerate(vehicle.dof_names):
        if match := _BODY.fullmatch(name):
            found.setdefault(match["dof"], []).append(k)
    return {dof: np.array(at, dtype=np.int64) for dof, at in sorted(found.items(), reverse=True)}

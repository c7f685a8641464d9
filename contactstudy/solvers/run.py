"""The run that both solvers share: static start, time steps, recorded histories."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.rows import row_values
from contactstudy.dynamics.statics import static_start
from contactstudy.dynamics.stepper import Coupling, Integrator, State, march
from contactstudy.solvers.dataset import history_dataset
from contactstudy.solvers.journey import Journey
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.model import Direction
from contactstudy.vehicle import Vehicle

if TYPE_CHECKING:
    import xarray as xr

Progress = Callable[[int, int], None]

STEPS_PER_REPORT = 100
"""How many steps pass between two calls of `progress`."""


@dataclass(frozen=True)
class Assembly:
    """A track with a vehicle on it, not yet in contact.

    Parameters
    ----------
    track : DiscreteTrack
    vehicle : Vehicle
    direction : {"Z", "Y"}
        Static loads act in Z only.
    """

    track: DiscreteTrack
    vehicle: Vehicle
    direction: Direction = "Z"

    @property
    def system(self) -> LinearSystem:
        """Matrices of the track's dofs followed by the vehicle's."""
        track, vehicle = self.track, self.vehicle
        return LinearSystem.stacked(
            LinearSystem(track.mass, track.damping, track.stiffness),
            LinearSystem(
                *(sp.csr_array(m) for m in (vehicle.mass, vehicle.damping, vehicle.stiffness))
            ),
        )

    @property
    def n_dofs(self) -> int:
        """Number of dofs of track and vehicle."""
        return self.track.n_dofs + self.vehicle.n_dofs

    @property
    def wheel_dofs(self) -> np.ndarray:
        """(nw,) dofs of the system that are wheels."""
        return self.track.n_dofs + np.asarray(self.vehicle.wheel_dofs, dtype=np.int64)

    @property
    def static_loads(self) -> np.ndarray:
        """(nw,) static load of each wheel in the direction of the analysis [N]."""
        loads = np.asarray(self.vehicle.static_loads, dtype=float)
        return loads if self.direction == "Z" else np.zeros_like(loads)

    @property
    def external(self) -> np.ndarray:
        """(n_dofs,) constant load: minus the static load on each wheel."""
        load = np.zeros(self.n_dofs)
        np.add.at(load, self.wheel_dofs, -self.static_loads)
        return load


def run(
    assembly: Assembly,
    coupling: Coupling,
    journey: Journey,
    integrator: Integrator,
    irregularity: np.ndarray,
    *,
    setup_began: float,
    attrs: Mapping[str, object] | None = None,
    progress: Progress | None = None,
    on_state: Callable[[State], None] | None = None,
    local_compliance: np.ndarray | None = None,
    start_tolerance: float = 1e-11,
) -> xr.Dataset:
    """Run and record.

    Parameters
    ----------
    assembly : Assembly
    coupling : Coupling
        Its record must hold "contact_force"; everything it holds is recorded.
    journey : Journey
    integrator : Integrator
    irregularity : ndarray
        (n_times, n_wheels) faded irregularity under each wheel, as the coupling uses it [m].
    setup_began : float
        `time.perf_counter()` when the solver began, for the time that setting up took.
    attrs : mapping, optional
        Describes the run; what is known here (dofs, steps, times ...) is added.
    progress : callable, optional
        Called with (steps done, steps) now and then.
    on_state : callable, optional
        Sees every state, the start included.
    local_compliance : ndarray, optional
        (n_times, n_wheels) what the contact force adds to the deflection of the rail under the
        wheel beyond the track's dofs [m/N]; none when the coupling records that itself.
    start_tolerance : float
        Force out of balance at the start, relative to the largest load.

    Returns
    -------
    xarray.Dataset
    """
    system, track, wheels = assembly.system, assembly.track, assembly.wheel_dofs
    n_steps = journey.n_steps
    positions = journey.wheel_positions(assembly.vehicle.wheel_offsets)
    n_times, n_wheels = positions.shape
    rail_dofs, rail_weights = (
        rows.reshape(n_times, n_wheels, -1) for rows in track.rail_rows(positions.ravel())
    )
    station_dofs, station_weights = track.rail_rows(np.asarray(journey.stations, dtype=float))
    stations = np.empty((n_times, len(journey.stations)))
    wheel_u, wheel_a, rail_u = (np.empty(positions.shape) for _ in range(3))

    start = static_start(system, coupling, assembly.external, wheels, tolerance=start_tolerance)
    assert start.contact is not None
    recorded = {
        name: np.empty((n_times, *np.shape(value))) for name, value in start.contact.record.items()
    }

    def record(state: State) -> None:
        assert state.contact is not None
        step, u = state.step, state.u
        for name, value in state.contact.record.items():
            recorded[name][step] = value
        wheel_u[step], wheel_a[step] = u[wheels], state.a[wheels]
        rail_u[step] = row_values(rail_dofs[step], rail_weights[step], u)
        if len(journey.stations):
            stations[step] = row_values(station_dofs, station_weights, u)
        if on_state is not None:
            on_state(state)

    record(start)
    stepping_began = time.perf_counter()
    states = march(
        system,
        coupling,
        start,
        journey.time_step,
        n_steps,
        integrator,
        assembly.external,
        position=lambda step: float(positions[step, 0]),
    )
    for state in states:
        record(state)
        if progress is not None and (state.step % STEPS_PER_REPORT == 0 or state.step == n_steps):
            progress(state.step, n_steps)
    stepping_ended = time.perf_counter()

    if local_compliance is not None:
        rail_u -= local_compliance * recorded["contact_force"]
    return history_dataset(
        journey,
        positions,
        {
            "contact_force": recorded.pop("contact_force"),
            "wheel_displacement": wheel_u,
            "wheel_acceleration": wheel_a,
            "rail_displacement": rail_u,
            "irregularity": irregularity,
            **recorded,
        },
        station_displacement=stations,
        attrs={
            **(attrs or {}),
            "integrator": integrator.name,
            "direction": assembly.direction,
            "static_load": [float(load) for load in assembly.static_loads],
            "speed": journey.speed,
            "fade_in": journey.fade_in,
            "dofs": assembly.n_dofs,
            "steps": n_steps,
            "dt": journey.time_step,
            "seconds_setup": stepping_began - setup_began,
            "seconds_stepping": stepping_ended - stepping_began,
        },
    )

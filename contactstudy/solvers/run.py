"""The run that both solvers share: static start, time steps, and who watches them."""

from __future__ import annotations

import itertools
import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, cast

from contactstudy.dynamics.statics import static_start
from contactstudy.dynamics.stepper import Coupling, Integrator, Steps, march
from contactstudy.solvers.bridge_histories import BridgeHistories
from contactstudy.solvers.histories import Histories
from contactstudy.solvers.observers import Observer, Watch
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.wheel_forces import WheelForces
from contactstudy.track.discrete import DiscreteTrack
from contactstudy.track.structure import StructureTrack

if TYPE_CHECKING:
    import xarray as xr


def run_through(
    passage: Passage[DiscreteTrack],
    coupling: Coupling,
    integrator: Integrator,
    observers: Sequence[Observer] = (),
    attrs: Mapping[str, object] | None = None,
) -> xr.Dataset:
    """Start from static equilibrium and step through a passage.

    The dataset gets the attributes given and what is known here (dofs, steps, times ...).
    """
    import xarray as xr

    began = time.perf_counter()
    journey, system, external = passage.journey, passage.system, passage.external
    watches: list[Watch] = [Histories(passage)]
    if isinstance(passage.track, StructureTrack):
        watches.append(BridgeHistories(cast(Passage[StructureTrack], passage)))
        watches.append(WheelForces(passage))
    watches += [o.watch(passage, coupling) for o in observers]
    start = static_start(system, coupling, external, passage.wheels)
    steps = Steps(journey.time_step, journey.n_steps, lambda k: float(passage.positions[k, 0]))
    states = march(system, coupling, start, steps, integrator, external)
    # the first step factors the matrices and loads compiled code, which is setup
    for state in (start, *itertools.islice(states, 1)):
        for watch in watches:
            watch.see(state)
    stepping_began = time.perf_counter()
    for state in states:
        for watch in watches:
            watch.see(state)
    stepping_ended = time.perf_counter()

    seconds = stepping_began - began, stepping_ended - stepping_began
    data = xr.Dataset(attrs={**(attrs or {}), **described(passage, integrator, *seconds)})
    for watch in watches:
        data = watch.into(data)
    return data


def described(
    passage: Passage[DiscreteTrack], integrator: Integrator, setup: float, stepping: float
) -> dict[str, object]:
    """Attributes of the dataset of any run; times in s."""
    journey = passage.journey
    return {
        "integrator": integrator.name,
        "direction": passage.track.direction,
        "static_load": [float(load) for load in passage.static_loads[~passage.lateral]],
        "speed": journey.speed,
        "travel": journey.travel,
        "start": journey.start,
        "fade_in": journey.fade_in,
        "dofs": passage.n_dofs,
        "steps": journey.n_steps,
        "dt": journey.time_step,
        "seconds_setup": setup,
        "seconds_stepping": stepping,
    }

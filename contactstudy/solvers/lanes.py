"""Point-contact runs of one track and vehicle, stepped side by side in compiled code."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.point_coupling import PointCoupling
from contactstudy.contact.point_steps import (
    LaneGaps,
    LaneLaws,
    LaneRecord,
    LaneState,
    advance,
)
from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.columns import LocalColumns
from contactstudy.dynamics.kinematics import Scheme
from contactstudy.dynamics.lanes import LANES, lane_system
from contactstudy.dynamics.stepper import Integrator, State
from contactstudy.solvers.histories import Histories
from contactstudy.solvers.passage import Passage
from contactstudy.track.discrete import DiscreteTrack

STEPS_AT_ONCE = 500
"""Steps between two returns from compiled code, for progress and for Ctrl-C."""
_ALONE = 2  # runs at most that are stepped one by one: cheaper than with lanes that are empty


@dataclass(frozen=True)
class LaneRun:
    """A run that is ready to be stepped: its coupling, start, and what records it."""

    passage: Passage[DiscreteTrack]
    coupling: PointCoupling
    start: State
    histories: Histories

    @property
    def n_steps(self) -> int:
        """Number of steps."""
        return self.passage.journey.n_steps

    @property
    def wheel_columns(self) -> tuple[int, int]:
        """How many columns of the rows B are displacements of the wheel, and with its modes."""
        return self.passage.wheels[0].shape[1], self.coupling.gaps.wheels[0].shape[1]

    @property
    def form(self) -> tuple[Any, ...]:
        """What runs must have in common that stand in lanes side by side."""
        law, gaps, width = self.coupling.law, self.coupling.gaps, self.passage.rail_rows.width
        shapes = gaps.shape.shape[1:], self.histories.at_stations[0].shape
        return law.kind, len(law.numbers), self.wheel_columns, width, shapes

    def gaps(self, first: int, stop: int) -> LaneGaps:
        """Gaps at steps first .. stop - 1, without lanes."""
        gaps, at = self.coupling.gaps, slice(first, stop)
        rows = gaps.joined(*self.passage.rail_rows.between(first, stop))
        return LaneGaps(*rows, gaps.compliance[at], gaps.irregularity[at], gaps.shape[at])


def in_lanes(runs: Sequence[LaneRun]) -> Iterator[tuple[int, list[int]]]:
    """Numbers of the runs that are stepped side by side, and in how many lanes."""
    forms: dict[Any, list[int]] = {}
    for number in sorted(range(len(runs)), key=lambda i: -runs[i].n_steps):
        forms.setdefault(runs[number].form, []).append(number)
    for own in forms.values():
        for first in range(0, len(own), LANES):
            group = own[first : first + LANES]
            if len(group) > _ALONE:
                yield LANES, group
            else:
                yield from ((1, [one]) for one in group)


class LaneStepper:
    """Steps runs of one system, with one integrator and time step [s].

    A run's numbers do not depend on those beside it.
    """

    def __init__(
        self, system: LinearSystem, external: Array, integrator: Integrator, dt: float
    ) -> None:
        factor, i = integrator.factor(system, dt), integrator
        self._system, self._columns = lane_system(system, factor), LocalColumns(factor)
        self._external, self._scheme = external, Scheme(dt, i.beta, i.gamma, i.alpha_m, i.alpha_f)

    def step(
        self, runs: Sequence[LaneRun], lanes: int, report: Callable[[int], object]
    ) -> list[bool]:
        """Step runs of one form to their ends; which of them broke down.

        `report` is told how many steps of how many runs were done since it was told last.
        """
        laws = _laws(runs, lanes)
        steady = np.repeat((self._system.inverse * self._external)[:, None], lanes, axis=1)
        state = _state(runs, lanes)
        stations = _stations(runs, lanes)
        broken, first = np.zeros(lanes, dtype=bool), 1
        while first <= max(run.n_steps for run in runs):
            count = min(STEPS_AT_ONCE, max(run.n_steps for run in runs) + 1 - first)
            gaps = _gaps(runs, lanes, first - 1, count + 1)
            left = np.zeros(lanes, dtype=np.int64)
            left[: len(runs)] = [max(run.n_steps + 1 - first, 0) for run in runs]
            left[broken] = -1
            record = _record(gaps, stations)
            advance(
                self._system,
                self._scheme,
                self._columns.at(gaps.dofs),
                steady,
                laws,
                gaps,
                runs[0].wheel_columns,
                stations,
                state,
                left,
                record,
            )
            finite = np.isfinite(state.a).all(axis=0) & np.isfinite(state.u).all(axis=0)
            broken = (left < 0) | ((left > 0) & ~finite)
            done = 0
            for lane, run in enumerate(runs):
                here = min(max(int(left[lane]), 0), count)
                if here:
                    run.histories.take(slice(first, first + here), lane, record)
                    done += here
            report(done)
            first += count
        return list(broken[: len(runs)])


def _laws(runs: Sequence[LaneRun], lanes: int) -> LaneLaws:
    laws = [run.coupling.law for run in runs]
    numbers = np.zeros((lanes, len(laws[0].numbers)))
    numbers[: len(runs)] = [law.numbers for law in laws]
    first = runs[0].coupling
    loads = np.ascontiguousarray(first.static_loads)
    return LaneLaws(laws[0].kind, numbers, loads, first.bilateral)


def _state(runs: Sequence[LaneRun], lanes: int) -> LaneState:
    starts = [run.start for run in runs]
    n, n_wheels = len(starts[0].u), len(runs[0].coupling.static_loads)
    u, v, a = np.zeros((n, lanes)), np.zeros((n, lanes)), np.zeros((n, lanes))
    state = LaneState(u, v, a, np.zeros((lanes, n_wheels)))
    for lane, start in enumerate(starts):
        assert start.contact is not None
        state.u[:, lane], state.v[:, lane], state.a[:, lane] = start.u, start.v, start.a
        state.force[lane] = start.contact.record["contact_force"]
    return state


def _stations(runs: Sequence[LaneRun], lanes: int) -> tuple[IntArray, Array]:
    shape = runs[0].histories.at_stations[0].shape
    of_dofs, of_weights = np.zeros((lanes, *shape), dtype=np.int64), np.zeros((lanes, *shape))
    for lane, run in enumerate(runs):
        of_dofs[lane], of_weights[lane] = run.histories.at_stations
    return of_dofs, of_weights


def _gaps(runs: Sequence[LaneRun], lanes: int, first: int, count: int) -> LaneGaps:
    """Gaps from a step on; nothing where a lane has no run, or its run has ended."""
    own = [run.gaps(first, first + count) for run in runs]
    made = {}
    for name in LaneGaps._fields:
        parts = [getattr(one, name) for one in own]
        made[name] = np.zeros((count, lanes, *parts[0].shape[1:]), dtype=parts[0].dtype)
        for lane, part in enumerate(parts):
            made[name][: len(part), lane] = part
    return LaneGaps(**made)


def _record(gaps: LaneGaps, stations: tuple[IntArray, Array]) -> LaneRecord:
    n, lanes, n_wheels = gaps.dofs.shape[:3]
    steps, shape = n - 1, (n - 1, lanes, n_wheels)
    made = {name: np.empty(shape) for name in LaneRecord._fields}
    return LaneRecord(**made | {"station_u": np.empty((steps, lanes, stations[0].shape[1]))})

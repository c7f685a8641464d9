"""Steps of runs with contact at points, compiled: the equations of `dynamics.stepper.march`.

The runs stand in lanes (`dynamics.lanes`): they share track, vehicle, integrator and time step, and
differ in where their wheels are, what these feel, and the numbers of their laws.
"""

from typing import NamedTuple

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.compiled import compiled
from contactstudy.contact.law_forces import wheel_forces
from contactstudy.dynamics.columns import Columns, add_columns, compliance
from contactstudy.dynamics.kinematics import Scheme, correct, predict
from contactstudy.dynamics.lanes import LaneSystem, subtract_in_lanes
from contactstudy.dynamics.rows import row_values


class LaneState(NamedTuple):
    """Motion of all lanes (n, lanes), and contact forces of the last step (lanes, nw)."""

    u: Array
    v: Array
    a: Array
    force: Array


class LaneLaws(NamedTuple):
    """Laws of one kind with their numbers (lanes, q), and the static loads (nw,) [N]."""

    kind: int
    numbers: Array
    static_loads: Array
    bilateral: bool


class LaneGaps(NamedTuple):
    """`PointGaps` of all lanes, the step before and those to be done, (1 + steps, lanes, ...)."""

    dofs: IntArray
    weights: Array
    compliance: Array
    irregularity: Array
    shape: Array


class LaneRecord(NamedTuple):
    """What is kept of some steps: forces and motion (steps, lanes, nw) of wheels and rail."""

    contact_force: Array
    rail_residual: Array
    wheel_u: Array
    wheel_a: Array
    rail_u: Array
    rail_a: Array
    station_u: Array


@compiled
def advance(
    system: LaneSystem,
    scheme: Scheme,
    columns: Columns,
    steady: Array,
    laws: LaneLaws,
    gaps: LaneGaps,
    wheel_columns: tuple[int, int],
    stations: tuple[IntArray, Array],
    state: LaneState,
    left: IntArray,
    record: LaneRecord,
) -> None:
    """Do some steps in all lanes, from the state in `state` to the one after them.

    Parameters
    ----------
    steady : ndarray (n, lanes)
        Constant load, divided by D.
    wheel_columns : tuple of int
        How many columns of the rows B are displacements of the wheel, and with those of its modes;
        the others are the rail's with a minus.
    stations : dofs and weights (lanes, ns, k)
        Rows of the rail at the stations.
    left : ndarray of int (lanes,)
        Steps that each lane still does, with no contact behind them; -1 where one broke down.
    """
    am, af = scheme.alpha_m, scheme.alpha_f
    of_a, n_wheels = scheme.beta * scheme.dt**2, gaps.dofs.shape[2]
    n, lanes = state.u.shape
    mean_u, mean_v, mean_a, y = (
        np.empty((n, lanes)),
        np.empty((n, lanes)),
        np.empty((n, lanes)),
        np.empty((n, lanes)),
    )
    work, free_gap, force = np.zeros(n), np.zeros(n_wheels), np.zeros(n_wheels)
    beside = np.zeros(n_wheels)  # none
    # all lanes one after the other
    motion = state.u.reshape(-1), state.v.reshape(-1), state.a.reshape(-1)
    means = mean_u.reshape(-1), mean_v.reshape(-1), mean_a.reshape(-1)
    for k in range(1, gaps.dofs.shape[0]):
        predict(scheme, motion, motion[:2], means)
        # S a* = f_ext + af B^T lambda(n) - am M a - C (...) - K (...), rows divided by D
        y[:] = steady
        if af != 0.0:
            for lane in range(lanes):
                dofs, weights = gaps.dofs[k - 1, lane], gaps.weights[k - 1, lane]
                for i in range(n_wheels):
                    for j in range(dofs.shape[1]):
                        at, pushed = dofs[i, j], af * weights[i, j] * state.force[lane, i]
                        y[at, lane] += system.inverse[at] * pushed
        if am != 0.0:
            subtract_in_lanes(system.mass, mean_a, y, False)
        subtract_in_lanes(system.damping, mean_v, y, False)
        subtract_in_lanes(system.stiffness, mean_u, y, False)
        subtract_in_lanes(system.lower, y, y, False)
        subtract_in_lanes(system.upper, y, y, True)
        for lane in range(lanes):
            if left[lane] < k:
                continue
            dofs, weights = gaps.dofs[k, lane], gaps.weights[k, lane]
            # g* = B (u~ + beta dt^2 a*) - r,  W = (1-af) beta dt^2 B S^-1 B^T + c
            W = (1.0 - af) * of_a * compliance(columns, dofs, weights, work)
            for i in range(n_wheels):
                W[i, i] += gaps.compliance[k, lane, i]
                free_gap[i] = -gaps.irregularity[k, lane, i]
                for j in range(dofs.shape[1]):
                    at = dofs[i, j]
                    free_gap[i] += weights[i, j] * (state.u[at, lane] + of_a * y[at, lane])
            shape, numbers = gaps.shape[k, lane], laws.numbers[lane]
            rest = wheel_forces(
                laws.kind,
                numbers,
                shape,
                W,
                free_gap,
                laws.static_loads,
                laws.bilateral,
                beside,
                force,
            )
            if rest != 0.0 or not np.all(np.isfinite(force)):
                left[lane] = -1
                continue
            # a = a* + (1-af) S^-1 B^T lambda
            add_columns(columns, dofs, weights, (1.0 - af) * force, y[:, lane])
            state.force[lane] = force
            record.contact_force[k - 1, lane] = force
            record.rail_residual[k - 1, lane] = -gaps.compliance[k, lane] * force
        correct(scheme, motion[:2], y.reshape(-1), motion)
        for lane in range(lanes):
            if left[lane] >= k:
                dofs, weights = gaps.dofs[k, lane], gaps.weights[k, lane]
                _keep(dofs, weights, wheel_columns, state, k - 1, lane, record)
                dofs, weights = stations
                if dofs.shape[1]:
                    record.station_u[k - 1, lane] = row_values(
                        dofs[lane], weights[lane], state.u[:, lane]
                    )


@compiled
def _keep(
    dofs: IntArray,
    weights: Array,
    wheel_columns: tuple[int, int],
    state: LaneState,
    k: int,
    lane: int,
    record: LaneRecord,
) -> None:
    """Record the motion of the wheels of a lane and of the rail under them."""
    own, with_modes = wheel_columns
    for i in range(dofs.shape[0]):
        wheel_u, wheel_a, rail_u, rail_a = 0.0, 0.0, 0.0, 0.0
        for j in range(own):
            wheel_u += weights[i, j] * state.u[dofs[i, j], lane]
            wheel_a += weights[i, j] * state.a[dofs[i, j], lane]
        for j in range(with_modes, dofs.shape[1]):
            rail_u -= weights[i, j] * state.u[dofs[i, j], lane]
            rail_a -= weights[i, j] * state.a[dofs[i, j], lane]
        record.wheel_u[k, lane, i], record.wheel_a[k, lane, i] = wheel_u, wheel_a
        record.rail_u[k, lane, i], record.rail_a[k, lane, i] = rail_u, rail_a

"""Compiled steps of point runs against `march`, against longer numbers, and run beside run."""

import dataclasses
import itertools

import numpy as np
import pytest

from contactstudy.contact.laws import (
    HertzSpring,
    LinearSpring,
    MovingForce,
    PressSpring,
    RigidContact,
)
from contactstudy.contact.patch_laws import FollowingPatch, WinklerBedding
from contactstudy.dynamics.statics import static_start
from contactstudy.dynamics.stepper import (
    Steps,
    average_acceleration,
    generalised_alpha,
    march,
    newmark,
)
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.lanes import STEPS_AT_ONCE
from contactstudy.solvers.observers import EachState, ReportProgress
from contactstudy.solvers.point import point_contact, point_contacts
from contactstudy.solvers.point_case import PointCase
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.vehicle import bare_wheel, train, wheel_column

TRACK = BeamTrack(Track(length=12.0), "timoshenko", element_compliance=True)
JOURNEY = Journey(2.0, 5.0, 250 / 3.6, 5e-5, fade_in=0.5, stations=(3.0, 4.4))
APPROACH = 2e-5 * np.arange(1, 9)
PRESS = PressSpring(APPROACH, 9.25e10 * APPROACH**1.5)
HERTZ = HertzSpring(9.25e10)
LAWS = [
    LinearSpring(1.2e9),
    LinearSpring(1e11),
    HERTZ,
    PRESS,
    WinklerBedding(6e-3, 7.5e-5, 6e4),
    FollowingPatch.on_ellipse(HERTZ, 6e-3, 7.5e-5),
    MovingForce(),
    RigidContact(),
]
PAIR = train([bare_wheel(900.0, 6e4)] * 2, [0.0, -0.31])


def profile(seed=1):
    return sample_profile(paper_spectrum(), seed=seed)


def case(law, seed=1, **changes):
    values = {"track": TRACK, "vehicle": wheel_column(), "irregularity": profile(seed)}
    return PointCase(**values | {"journey": JOURNEY, "law": law} | changes)


def by_states(one):
    """The same run through `march`, which an observer of states asks for."""
    (found,) = point_contacts([dataclasses.replace(one, observers=[EachState(lambda state: None)])])
    return found


def assert_close(ours, theirs, share):
    assert set(ours.data_vars) == set(theirs.data_vars)
    for name in ours.data_vars:
        of = 10 * share if name == "rail_acceleration" else share
        # m or m/s^2: a wheel under a moving force stands still but for rounding
        least = 1.0 if name.endswith("acceleration") else 1e-4
        atol = of * max(np.abs(theirs[name].values).max(), least)
        np.testing.assert_allclose(ours[name], theirs[name], rtol=0, atol=atol, err_msg=name)


@pytest.mark.parametrize("vehicle", [wheel_column(), PAIR], ids=["one wheel", "two in an element"])
@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize(
    "integrator",
    [average_acceleration(), generalised_alpha(0.8), newmark(0.36, 0.7)],
    ids=lambda one: one.name,
)
def test_same_numbers_as_march(law, integrator, vehicle):
    if isinstance(law, RigidContact) and integrator.constraint_radius > 1 - 1e-6:
        pytest.skip("a rigid contact needs numerical damping")
    one = case(law, integrator=integrator, vehicle=vehicle)
    (found,) = point_contacts([one])
    assert_close(found, by_states(one), 1e-12)


def test_lateral_contact_holds_in_tension():
    lateral = BeamTrack(Track(length=12.0), direction="Y")
    one = case(LinearSpring(1e9), track=lateral)
    (found,) = point_contacts([one])
    assert float(found.contact_force.min()) < 0.0
    assert_close(found, by_states(one), 1e-12)


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="no longer numbers here")
@pytest.mark.parametrize("integrator", [average_acceleration(), generalised_alpha(0.5)])
def test_rounding_against_the_equations_in_longer_numbers(integrator):
    """A stiff spring, and hundreds of steps that remember all errors of the last one."""
    one = case(LinearSpring(1e11), track=BeamTrack(Track(length=6.0), "timoshenko"))
    one = dataclasses.replace(one, journey=Journey(2.0, 4.0, 250 / 3.6, 5e-5, fade_in=0.5))
    ready = dataclasses.replace(one, integrator=integrator).ready()
    passage, coupling = ready.passage, ready.coupling
    start = static_start(passage.system, coupling, passage.external, passage.wheels)
    exact = in_longer_numbers(passage, coupling, integrator, start)
    steps = Steps(passage.journey.time_step, passage.journey.n_steps)
    states = march(passage.system, coupling, start, steps, integrator, passage.external)
    marched = [state.contact.record["contact_force"][0] for state in states]
    (found,) = point_contacts([dataclasses.replace(one, integrator=integrator)])
    for force in (np.array(marched), found.contact_force.values[1:]):
        assert np.abs(force - exact).max() < 1e-12 * exact.max()


def in_longer_numbers(passage, coupling, integrator, start):
    """Contact forces of one wheel on a linear spring, with a dense inverse."""
    long, gaps, system = np.longdouble, coupling.gaps, passage.system
    M, C, K = (m.toarray().astype(long) for m in (system.mass, system.damping, system.stiffness))
    dt, k_r, load = (
        long(x)
        for x in (passage.journey.time_step, coupling.law.stiffness, passage.static_loads[0])
    )
    beta, gamma, am, af = (
        long(x) for x in (integrator.beta, integrator.gamma, integrator.alpha_m, integrator.alpha_f)
    )
    inverse = gauss_jordan((1 - am) * M + (1 - af) * (gamma * dt * C + beta * dt * dt * K))
    u, v, a, f = (x.astype(long) for x in (start.u, start.v, start.a, start.load))
    forces = []
    for k in range(1, passage.journey.n_steps + 1):
        u0, v0 = u + dt * v + dt * dt * (long(0.5) - beta) * a, v + dt * (1 - gamma) * a
        rhs = (1 - af) * passage.external + af * f - am * (M @ a)
        a = inverse @ (rhs - C @ ((1 - af) * v0 + af * v) - K @ ((1 - af) * u0 + af * u))
        row = np.zeros(len(u), dtype=long)
        dofs, weights = gaps.rows(k)
        np.add.at(row, dofs[0], weights[0].astype(long))
        moved = (1 - af) * (inverse @ row)
        W = beta * dt * dt * (row @ moved) + gaps.compliance[k, 0]
        gap = row @ (u0 + beta * dt * dt * a) - gaps.irregularity[k, 0]
        force = max((load - k_r * gap) / (1 + k_r * W), long(0))
        a = a + moved * force
        u, v, f = u0 + beta * dt * dt * a, v0 + gamma * dt * a, passage.external + row * force
        forces.append(float(force))
    return np.array(forces)


def gauss_jordan(matrix):
    """Inverse in the numbers of a matrix, which needs no pivots."""
    n = len(matrix)
    both = np.hstack([matrix, np.eye(n, dtype=matrix.dtype)])
    for i in range(n):
        both[i] /= both[i, i]
        others = np.arange(n) != i
        both[others] -= np.outer(both[others, i], both[i])
    return both[:, n:]


def varied():
    """Runs of one system: seeds, k_r, laws, speeds, lengths, one on the smooth rail."""
    cases = [case(LinearSpring(k), seed) for seed, k in enumerate((1e9, 2e9, 1e10, 1e9), 1)]
    cases += [
        case(LinearSpring(1e9), journey=dataclasses.replace(JOURNEY, speed=v, end=end))
        for v, end in ((30.0, 3.1), (50.0, 5.5), (80.0, 4.7))
    ]
    cases += [case(HERTZ, seed) for seed in (1, 2, 3)] + [case(LinearSpring(1e9), 7)]
    return [*cases, case(LinearSpring(3e9), irregularity=SmoothRail()), case(PRESS)]


def assert_same_bits(one, other):
    for name in one.data_vars:
        np.testing.assert_array_equal(one[name].values, other[name].values, err_msg=name)


@pytest.mark.parametrize("integrator", [average_acceleration(), generalised_alpha(0.8)])
def test_bits_depend_neither_on_the_batch_nor_on_its_order(integrator):
    cases = [dataclasses.replace(one, integrator=integrator) for one in varied()]
    alone = [point_contacts([one])[0] for one in cases]
    assert max(run.sizes["time"] for run in alone) > STEPS_AT_ONCE > alone[4].sizes["time"] / 2
    order = np.random.default_rng(0).permutation(len(cases))
    for chosen in (range(len(cases)), order, order[:3], order[3:12]):
        for number, run in zip(chosen, point_contacts([cases[k] for k in chosen]), strict=True):
            assert_same_bits(run, alone[number])


def test_different_systems_in_one_batch():
    cases = [
        case(LinearSpring(1e9)),
        case(LinearSpring(1e9), track=BeamTrack(TRACK.track)),
        case(LinearSpring(1e9), vehicle=bare_wheel(900.0, 6e4)),
        case(LinearSpring(1e9), journey=dataclasses.replace(JOURNEY, time_step=1e-4)),
        case(LinearSpring(1e9), journey=dataclasses.replace(JOURNEY, stations=())),
        case(LinearSpring(1e9), vehicle=PAIR),
    ]
    for one, run in zip(cases, point_contacts(cases), strict=True):
        assert_same_bits(run, point_contacts([one])[0])


def test_a_run_that_breaks_down_does_not_touch_the_others():
    """Its error is that of `march`, with step and position."""
    wild = case(LinearSpring(1e9), irregularity=Broken())
    lost = case(LinearSpring(1e9), journey=dataclasses.replace(JOURNEY, end=50.0))
    cases = [case(LinearSpring(1e9), seed) for seed in (1, 2, 3)]
    found = point_contacts([cases[0], wild, cases[1], lost, cases[2]])
    assert isinstance(found[1], NumericalError)
    assert "(wheel at X = 3." in str(found[1])
    assert isinstance(found[3], InputError)
    for run, one in zip((found[0], found[2], found[4]), cases, strict=True):
        assert_same_bits(run, point_contacts([one])[0])


class Broken(SmoothRail):
    """Not a number behind 3 m."""

    def __call__(self, x):
        return np.where(np.asarray(x) > 3.0, np.nan, 0.0)


def test_progress_is_told_while_it_runs():
    told = []
    point_contact(
        TRACK,
        wheel_column(),
        profile(),
        JOURNEY,
        law=HERTZ,
        observers=[ReportProgress(lambda done, of: told.append((done, of)))],
    )
    steps = JOURNEY.n_steps
    assert told == [(STEPS_AT_ONCE, steps), (steps, steps)]
    told.clear()
    point_contacts(varied(), lambda done, of: told.append((done, of)))
    total = sum(one.journey.n_steps for one in varied())
    assert told[-1] == (total, total)
    assert all(before[0] < after[0] for before, after in itertools.pairwise(told))

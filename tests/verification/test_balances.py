"""Energy, impulse and weight balances of whole runs, and no tension ever."""

import dataclasses

import numpy as np
import pytest

from contactstudy.contact.laws import HertzSpring, LinearSpring, RigidContact
from contactstudy.dynamics.energy import energy_balance
from contactstudy.dynamics.stepper import average_acceleration
from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.point_case import point_coupling
from contactstudy.solvers.run import run_through
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.vehicle import wheel_column

JOURNEY = Journey(6.0, 12.0, time_step=1e-4, fade_in=1.0)


def states_of(law, theory, journey=JOURNEY, integrator=None):
    track, profile = BeamTrack(Track(length=18.0), theory, 4, True), paper_spectrum()
    passage = Passage(track, wheel_column(), sample_profile(profile, seed=3), journey)
    states = []
    result = run_through(
        passage,
        point_coupling(passage, law),
        integrator or average_acceleration(),
        (EachState(states.append),),
    )
    return passage, states, result


@pytest.mark.parametrize("theory", ["euler", "timoshenko"])
@pytest.mark.parametrize("law", [LinearSpring(1e11), HertzSpring(9.25e10)])
def test_work_equals_kinetic_strain_and_dissipated_energy(law, theory):
    passage, states, _ = states_of(law, theory)
    balance = energy_balance(passage.system, states)
    scale = sum(abs(e) for e in (balance.kinetic, balance.strain, balance.dissipated))
    print(f"{law} {theory}: {balance}, residual {balance.residual:.1e} J")
    assert balance.dissipated > 0.0
    assert abs(balance.residual) < 1e-9 * scale


def test_impulse_of_the_contact_force_equals_change_of_momentum():
    passage, states, result = states_of(LinearSpring(1e9), "euler")
    vehicle = passage.vehicle
    velocity = states[-1].v[passage.track.n_dofs :]
    momentum = float(np.ones(3) @ vehicle.mass @ velocity)
    excess = result.contact_force.values - vehicle.static_loads[0]
    impulse = float(np.sum(0.5 * (excess[1:] + excess[:-1])) * JOURNEY.time_step)
    print(f"momentum {momentum:.6f} N s, impulse {impulse:.6f} N s")
    assert impulse == pytest.approx(momentum, rel=1e-9)


def test_mean_contact_force_is_the_static_load():
    profile = sample_profile(paper_spectrum(), seed=1)
    result = point_contact(
        Track(), wheel_column(), profile, Journey(time_step=1e-4), law=LinearSpring(1.2e9)
    )
    static = result.attrs["static_load"][0]
    mean = float(result.contact_force.mean())
    print(f"static load {static:.0f} N, mean contact force {mean:.0f} N")
    assert mean == pytest.approx(static, rel=0.01)


def test_supports_carry_the_static_load():
    track = Track(length=18.0, ends="free")
    journey = Journey(9.1, 9.2, time_step=1e-4, fade_in=0.0)
    passage = Passage(BeamTrack(track), wheel_column(), SmoothRail(), journey)
    coupling = point_coupling(passage, HertzSpring(9.25e10))
    states = []
    run_through(passage, coupling, average_acceleration(), (EachState(states.append),))
    start = states[0]
    # residual of the static equations, on every dof
    residual = passage.system.stiffness @ start.u - start.load
    load = passage.static_loads[0]
    assert np.abs(residual).max() < 1e-10 * load
    assert not start.v.any() and not start.a.any()
    ballast, beam = track.support.layer.stiffness, passage.track
    sleepers = np.flatnonzero(beam.mass.diagonal() == track.support.sleeper_mass)
    assert len(sleepers) == track.n_bays + 1
    carried = -ballast * start.u[sleepers].sum()
    print(f"static load {load:.6f} N, carried by the ballast {carried:.6f} N")
    assert carried == pytest.approx(load, rel=1e-9)


@pytest.mark.parametrize("law", [LinearSpring(1e11), HertzSpring(9.25e10), RigidContact()])
@pytest.mark.parametrize("theory", ["euler", "timoshenko"])
def test_no_tension_when_wheels_jump(law, theory):
    profile = sample_profile(paper_spectrum(), seed=1)
    rough = dataclasses.replace(profile, amplitudes=6.0 * profile.amplitudes)
    result = point_contact(
        BeamTrack(Track(), theory=theory, element_compliance=True),
        wheel_column(),
        rough,
        Journey(time_step=1e-4),
        law=law,
    )
    force = result.contact_force.values
    gap = (result.wheel_displacement - result.rail_displacement - result.irregularity).values
    apart = force == 0.0
    print(f"{law} {theory}: apart in {apart.mean():.1%} of the steps, {force.max():.0f} N at most")
    assert np.isfinite(force).all()
    assert force.min() == 0.0
    assert 0.005 < apart.mean() < 0.5
    # apart means apart: wheel above the rail (for k_r: by more than the static load gives)
    slack = result.attrs["static_load"][0] / law.stiffness if isinstance(law, LinearSpring) else 0.0
    assert gap[apart].min() > slack - 1e-12

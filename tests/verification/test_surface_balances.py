"""Surface contact: energy and weight balances, no tension ever, one rail at every mesh and step."""

import dataclasses
from functools import cache

import numpy as np
import pytest

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.energy import energy_balance
from contactstudy.dynamics.stepper import average_acceleration
from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.instants import Instants
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.run import run_through
from contactstudy.solvers.surface import surface_contact, surface_coupling
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column


@cache
def cell(size):
    return condense(CellRecipe(size=size))


def track(size=0.004, ends="clamped"):
    described = Track(rail=solid_rail(cell(size).recipe), length=12.0, ends=ends)
    return SolidTrack(described, cell(size))


@cache
def wheel():
    return elastic_wheel(WheelRecipe(size=0.004))


def rough(factor=1.0):
    profile = sample_profile(paper_spectrum(), seed=1)
    return dataclasses.replace(profile, amplitudes=factor * profile.amplitudes)


def test_work_equals_kinetic_strain_and_dissipated_energy():
    on = track(ends="free")
    journey = Journey(3.0, 7.0, time_step=1e-4, fade_in=1.0)
    passage = Passage(on, wheel_column(), rough(), journey)
    coupling = surface_coupling(passage, SurfaceContact(wheel()))
    states = []
    run_through(passage, coupling, average_acceleration(), (EachState(states.append),))
    balance = energy_balance(passage.system, states)
    scale = sum(abs(e) for e in (balance.kinetic, balance.strain, balance.dissipated))
    print(f"{balance}, residual {balance.residual:.1e} J")
    assert balance.dissipated > 0.0
    assert abs(balance.residual) < 1e-9 * scale
    # the static start is an equilibrium on every dof, with the weight on the ballast
    start, described = states[0], on.track
    residual = passage.system.stiffness @ start.u - start.load
    assert np.abs(residual).max() < 1e-9 * passage.static_loads[0]
    sleepers = np.flatnonzero(on.mass.diagonal() == described.support.sleeper_mass)
    assert len(sleepers) == described.n_bays + 1
    carried = -described.support.layer.stiffness * start.u[sleepers].sum()
    print(f"static load {passage.static_loads[0]:.3f} N, carried by the ballast {carried:.3f} N")
    assert carried == pytest.approx(passage.static_loads[0], rel=1e-6)


def test_mean_contact_force_is_the_static_load():
    data = surface_contact(
        track(),
        SurfaceContact(wheel()),
        wheel_column(),
        SmoothRail(),
        Journey(3.0, 9.0, time_step=1e-4),
    )
    static = data.attrs["static_load"][0]
    # five whole bays; mean force = weight + mean inertia force of the column
    late = (data.position.values > 5.4) & (data.position.values <= 8.4)
    mean = float(data.contact_force.values[late].mean())
    print(f"static load {static:.0f} N, mean contact force {mean:.0f} N")
    assert mean == pytest.approx(static, rel=2e-3)


def test_no_tension_when_the_wheel_jumps():
    data = surface_contact(
        track(),
        SurfaceContact(wheel()),
        wheel_column(),
        rough(6.0),
        Journey(3.0, 9.0, time_step=1e-4, fade_in=1.0),
        observers=(Instants((4.0, 5.0, 6.0, 7.0)),),
    )
    force, area = data.contact_force.values, data.contact_area.values
    lost = force == 0.0
    print(f"off the rail in {100 * lost.mean():.0f} % of the steps; force {force.max():.0f} N")
    assert lost.any() and not lost.all()
    assert force.min() >= 0.0 and data.pressure.values.min() >= 0.0
    assert np.all(area[lost] == 0.0) and np.all(area[~lost] > 0.0)


def test_the_rail_is_the_same_at_every_mesh_and_step():
    runs = [
        surface_contact(
            track(size),
            SurfaceContact(wheel()),
            wheel_column(),
            rough(),
            Journey(3.0, 4.0, time_step=dt, fade_in=0.5),
        )
        for size, dt in ((0.004, 1e-4), (0.004, 5e-5), (0.006, 1e-4))
    ]
    coarse, fine, other = (d.irregularity.values for d in runs)
    np.testing.assert_allclose(fine[::2][: len(coarse)], coarse[: len(fine[::2])], atol=1e-15)
    np.testing.assert_array_equal(coarse, other)

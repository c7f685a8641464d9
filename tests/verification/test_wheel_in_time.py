"""The wheel's elastic modes in the time domain: slow limit, impulse, energy, stiff limit."""

import dataclasses
from functools import cache

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.energy import energy_balance
from contactstudy.dynamics.stepper import State, Steps, average_acceleration, march
from contactstudy.exceptions import InputError
from contactstudy.irregularity import HarmonicProfile, SmoothRail
from contactstudy.solids.cell import RailCell, condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, elastic_wheel, rigid_wheel
from contactstudy.solids.wheel_modes import ModesRecipe, WheelModes, wheel_modes
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.run import run_through
from contactstudy.solvers.surface import surface_contact, surface_coupling
from contactstudy.track.model import Track
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import bare_wheel, wheel_column, with_wheel_modes

COARSE = CellRecipe(size=0.004, interface_modes=10, internal_modes=4)
WHEEL = WheelRecipe(size=0.004)


@cache
def cell() -> RailCell:
    return condense(COARSE)


@cache
def wheel() -> WheelFlexibility:
    return elastic_wheel(WHEEL)


@cache
def modes() -> WheelModes:
    return wheel_modes(ModesRecipe(WHEEL))


@cache
def track(ends: str = "clamped") -> SolidTrack:
    described = Track(rail=solid_rail(COARSE), length=4.8, ends=ends)  # type: ignore[arg-type]
    return SolidTrack(described, cell())


def rough(amplitude: float, wavelength: float) -> HarmonicProfile:
    return HarmonicProfile(
        np.array([amplitude]), np.array([2 * np.pi / wavelength]), np.array([0.3])
    )


def test_slow_excitation_gives_the_quasi_static_wheel() -> None:
    # 25 Hz: far below the first mode of the wheel in its plane (542 Hz)
    journey = Journey(1.2, 3.2, speed=20.0, time_step=5e-4, fade_in=0.5)
    profile = rough(2e-4, 0.8)
    runs = [
        surface_contact(track(), SurfaceContact(wheel(), modes=m), wheel_column(), profile, journey)
        for m in (None, modes())
    ]
    still, modal = (d.contact_force.values for d in runs)
    # complex amplitudes over two wavelengths: what passing the mesh adds elsewhere does not matter
    x = runs[0].position.values
    late = (x > 1.6) & (x <= 3.2)
    wave = np.exp(-2j * np.pi * x[late] / 0.8)
    f, g = (complex(np.mean(wave * force[late])) for force in (modal, still))
    print(f"amplitude {2 * abs(g):.0f} N; modal over quasi-static {abs(f / g):.6f}")
    assert runs[0].attrs["wheel"] == "quasi-static" and runs[1].attrs["wheel"] == "modal"
    # at 25 Hz the modes can change (25/542)^2 = 0.2 % of the wheel's own compliance at most
    assert abs(f / g - 1) < 2e-3
    assert np.abs(modal - still).max() < 2e-3 * still[0]
    # the static start does not know of inertia at all
    assert modal[0] == pytest.approx(still[0], rel=1e-9)
    assert float(runs[1].wheel_displacement[0]) == pytest.approx(
        float(runs[0].wheel_displacement[0]), rel=1e-9
    )


def test_modes_without_inertia_are_the_quasi_static_wheel() -> None:
    # a wheel body 1e4 times lighter: w -> 100 w, phi -> 100 phi, L -> L/100; phi^2/w^2 stays
    light = dataclasses.replace(
        modes(),
        frequencies=100 * modes().frequencies,
        shapes=100 * modes().shapes,
        participation=modes().participation / 100,
    )
    profile, journey = rough(5e-5, 0.1), Journey(1.2, 1.8, time_step=5e-5, fade_in=0.2)
    still, modal, inert = (
        surface_contact(
            track(),
            SurfaceContact(wheel(), modes=m, wheel_damping=0.5),
            wheel_column(),
            profile,
            journey,
        ).contact_force.values
        for m in (None, modes(), light)
    )
    effect, left = (np.abs(force - still).max() / np.ptp(still) for force in (modal, inert))
    print(f"largest change of the force over its swing: {effect:.2e}, of a light wheel {left:.2e}")
    assert effect > 1e-3
    assert left < 0.03 * effect


def test_modes_of_a_stiff_wheel_are_a_rigid_wheel() -> None:
    profile, journey = rough(5e-5, 0.1), Journey(1.2, 1.8, time_step=5e-5, fade_in=0.2)
    rigid = rigid_wheel(WHEEL)
    stiff = dataclasses.replace(
        modes(), frequencies=1e4 * modes().frequencies, recipe=modes().recipe
    )
    plain = surface_contact(track(), SurfaceContact(rigid), wheel_column(), profile, journey)
    modal = surface_contact(
        track(), SurfaceContact(rigid, modes=stiff), wheel_column(), profile, journey
    )
    difference = np.abs(modal.contact_force - plain.contact_force).max()
    assert float(difference) < 1e-5 * np.ptp(plain.contact_force.values)


def test_work_equals_kinetic_strain_and_dissipated_energy() -> None:
    contact = SurfaceContact(wheel(), modes=modes(), wheel_damping=0.01)
    journey = Journey(1.2, 2.2, time_step=5e-5, fade_in=0.2)
    passage = Passage(track("free"), contact.on(wheel_column()), rough(5e-5, 0.08), journey)
    coupling = surface_coupling(passage, contact)
    states: list = []
    run_through(passage, coupling, average_acceleration(), (EachState(states.append),))
    balance = energy_balance(passage.system, states)
    scale = sum(abs(e) for e in (balance.kinetic, balance.strain, balance.dissipated))
    print(f"{balance}, residual {balance.residual:.1e} J")
    assert balance.dissipated > 0.0
    assert abs(balance.residual) < 1e-9 * scale
    # contact forces do the same work on both sides, so the wheel's centre of mass follows
    start = states[0]
    residual = passage.system.stiffness @ start.u - start.load
    assert np.abs(residual).max() < 1e-9 * passage.static_loads[0]


def test_free_wheel_after_an_impulse() -> None:
    # hub and modes on no track, set off by a unit impulse at the tread: exact from the
    # eigenvectors of (K, M), and m_w w' + L . q' stays the impulse
    vehicle = with_wheel_modes(
        bare_wheel(890.0, 1.0), modes().frequencies, modes().participation, 0.0
    )
    M, K = vehicle.mass, vehicle.stiffness
    system = LinearSystem(*(sp.csr_array(A) for A in (M, vehicle.damping, K)))
    middle = len(wheel().x) // 2 * len(wheel().y)
    push = np.r_[1.0, modes().shapes[:, middle]]
    squares, vectors = scipy.linalg.eigh(K, M)
    omega, share = np.sqrt(np.maximum(squares, 0.0)), (push @ vectors) ** 2
    v0, rest = np.linalg.solve(M, push), np.zeros(len(push))
    errors = []
    for dt in (2e-6, 1e-6):
        n = round(2e-3 / dt)
        start = State(0, 0.0, rest, v0, rest, rest)
        states = list(march(system, None, start, Steps(dt, n), average_acceleration(), rest))
        t = np.array([s.time for s in states])[:, None]
        exact = np.where(omega < 1.0, t, np.sin(omega * t) / np.maximum(omega, 1.0)) @ share
        errors.append(np.abs(np.array([push @ s.u for s in states]) - exact).max())
        assert M[0] @ states[-1].v == pytest.approx(1.0, rel=1e-9)
    print(f"errors {errors} m of {np.abs(exact).max():.3e} m")
    assert errors[1] < 2e-3 * np.abs(exact).max()
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)


def test_a_wheel_too_light_for_its_modes_is_refused() -> None:
    moved = float(modes().participation @ modes().participation)
    with pytest.raises(InputError, match="wheel_mass"):
        surface_contact(
            track(),
            SurfaceContact(wheel(), modes=modes()),
            bare_wheel(0.9 * moved, 60e3),
            SmoothRail(),
            Journey(1.2, 1.6, time_step=1e-4, fade_in=0.0),
        )
    with pytest.raises(InputError, match="wheel_damping"):
        with_wheel_modes(wheel_column(), modes().frequencies, modes().participation, -0.1)

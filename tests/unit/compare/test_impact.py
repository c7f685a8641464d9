"""What is said of impacts, and a track as one mass, against closed forms and brute force."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from contactstudy.compare.impact import LumpedTrack, impact
from contactstudy.compare.lumped_track import bed, for_p1, for_p2
from contactstudy.track.model import Track, WinklerFoundation
from contactstudy.track.rail import GivenRail


def test_loss_of_contact_and_impulse_of_a_cut_off_sine():
    """Above the static 10 kN a half sine of 30 kN over 1 ms has the impulse 2 A T/pi."""
    t = np.linspace(0.0, 4e-3, 40_001)
    force = 10e3 + np.where(t < 1e-3, 30e3 * np.sin(np.pi * t / 1e-3), 0.0)
    force[(t > 2e-3) & (t < 2.5e-3)] = 0.0
    found = impact(t, 20.0 * t, force, 10e3)
    assert found.impulse == pytest.approx(2 * 30e3 * 1e-3 / np.pi, rel=1e-6)
    assert found.lost_time == pytest.approx(0.5e-3, rel=1e-3)
    assert found.lost_length == pytest.approx(20.0 * 0.5e-3, rel=1e-3)


def test_the_lumped_model_is_the_differential_equation():
    model = LumpedTrack(600.0, 1.2e9, 200.0, 90e6, 50e3)
    t = np.linspace(0.0, 5e-3, 501)
    level = np.interp(t, [0.0, 1e-3, 2e-3, 5e-3], [0.0, -2e-4, 1e-4, 1e-4])

    def rate(time, z):
        force = 1.2e9 * (z[1] + np.interp(time, t, level) - z[0])
        return [z[2], z[3], force / 600.0, (-force - 50e3 * z[3] - 90e6 * z[1]) / 200.0]

    z = solve_ivp(rate, (0.0, t[-1]), np.zeros(4), t_eval=t, rtol=1e-9, atol=1e-14, max_step=1e-5).y
    contact, track = model.response(t, level)
    largest = np.abs(contact).max()
    np.testing.assert_allclose(contact, 1.2e9 * (z[1] + level - z[0]), atol=1e-6 * largest)
    np.testing.assert_allclose(track, -90e6 * z[1], atol=1e-6 * largest)


def test_a_beam_on_a_bed_as_one_mass():
    """The static deflection's integrals, and the stiffness 2 sqrt(2) (EI)^(1/4) k^(3/4)."""
    track = Track(GivenRail(EI=6e6, mass=60.0), WinklerFoundation(50e6, 40e3), length=12.0)
    found, b = for_p2(track, 600.0, 1e9), (50e6 / (4 * 6e6)) ** 0.25
    square, _ = quad(lambda x: (np.exp(-x) * (np.cos(x) + np.sin(x))) ** 2, 0.0, 40.0)
    assert found.track_mass == pytest.approx(2 * square / b * 60.0, rel=1e-8)
    assert found.track_damping == pytest.approx(2 * square / b * 40e3, rel=1e-8)
    assert found.track_stiffness == pytest.approx(2 * np.sqrt(2) * 6e6**0.25 * 50e6**0.75)


def test_the_rails_mass_in_p1_has_the_beams_receptance():
    track = Track(GivenRail(EI=6e6, mass=60.0), WinklerFoundation(50e6), length=12.0)
    found = for_p1(track, 600.0, 1e9)
    w = np.sqrt(1e9 * (1 / 600.0 + 1 / found.track_mass))
    # u = F/(4 EI q^3) (-1 - i) of an infinite free beam
    q = (60.0 * w**2 / 6e6) ** 0.25
    assert 1 / (found.track_mass * w**2) == pytest.approx(np.hypot(1, 1) / (4 * 6e6 * q**3))


def test_pad_and_ballast_act_in_series():
    mass, stiffness, damping = bed(Track())
    support, layer = Track().support, Track().support.layer
    assert stiffness * 0.6 == pytest.approx(1 / (1 / 65e6 + 1 / 137.75e6))
    assert mass == pytest.approx(Track().rail.mass_per_length + 125.5 / 0.6)
    # the dampers' work for a unit displacement of the rail
    share = layer.stiffness / (65e6 + layer.stiffness)
    work = support.pad_damping * share**2 + layer.damping * (1 - share) ** 2
    assert damping * 0.6 == pytest.approx(work)

"""Infinite Euler rail on a Winkler foundation: static, moving load, point mobility."""

import math

import numpy as np
import pytest

from contactstudy.contact.laws import LinearSpring, MovingForce
from contactstudy.irregularity import SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import GivenRail, Track, WinklerFoundation
from contactstudy.track.receptance import receptance
from contactstudy.vehicle import bare_wheel

EI, MASS, BED, LOAD = 6.4155e6, 60.367, 30e6, 60951.0


def test_static_deflection_under_the_load():
    # w0 = P beta / 2k, beta = (k / 4EI)^(1/4)
    beta = (BED / (4 * EI)) ** 0.25
    track = Track(GivenRail(EI=EI, mass=MASS), WinklerFoundation(BED), length=48.0)
    run = point_contact(
        BeamTrack(track, element_compliance=True),
        bare_wheel(900.0, LOAD),
        SmoothRail(),
        Journey(24.05, 24.06, 10.0, 4e-4, fade_in=0.0),
        law=LinearSpring(1e9),
    )
    computed = -run.rail_displacement.values[0]
    print(f"beta: 1.039819 1/m, {beta:.6f}; w0: 1.05630 mm, computed {1e3 * computed:.6f}")
    assert beta == pytest.approx(1.039819, abs=1e-6)
    assert computed == pytest.approx(LOAD * beta / (2 * BED), rel=1e-5)
    assert 1e3 * computed == pytest.approx(1.05630, abs=1e-5)


def test_moving_load_at_100_m_per_s():
    # Undamped: w0 / sqrt(1 - (v/v_cr)^2). 3 % damping lets the start die out within 50 m and
    # changes the deflection under the load by less than 1e-4.
    w0, critical = 1.05630, (4 * BED * EI / MASS**2) ** 0.25
    damping = 2 * 0.03 * math.sqrt(BED * MASS)
    track = Track(GivenRail(EI=EI, mass=MASS), WinklerFoundation(BED, damping), length=84.0)
    run = point_contact(
        BeamTrack(track, element_compliance=True),
        bare_wheel(900.0, LOAD),
        SmoothRail(),
        Journey(9.0, 75.0, 100.0, 1e-4),
        law=MovingForce(),
    )
    computed = -1e3 * run.rail_displacement.values[-500:].mean()
    exact = w0 / math.sqrt(1 - (100.0 / critical) ** 2)
    print(f"v_cr: 677.96 m/s, {critical:.2f}; w: 1.06798 mm, {exact:.5f}, computed {computed:.5f}")
    assert critical == pytest.approx(677.96, abs=0.01)
    assert computed == pytest.approx(1.06798, rel=1e-4)


def test_rail_acceleration_under_a_moving_load():
    # In the steady state w(x, t) = w(x - v t), so that a point of the rail has v^2 w''; under the
    # load w'' = P / (4 EI beta sqrt(1 - (v/v_cr)^2)), up, for the rail is bent like a valley.
    # Cubic elements cut the cusp of the bending moment off within the loaded element, so that the
    # mean over elements is of first order in their length.
    beta, critical = (BED / (4 * EI)) ** 0.25, (4 * BED * EI / MASS**2) ** 0.25
    speed, damping = 100.0, 2 * 0.03 * math.sqrt(BED * MASS)
    track = Track(GivenRail(EI=EI, mass=MASS), WinklerFoundation(BED, damping), length=72.0)
    exact = speed**2 * LOAD / (4 * EI * beta * math.sqrt(1 - (speed / critical) ** 2))
    computed = []
    for elements in (2, 4, 8):
        run = point_contact(
            BeamTrack(track, elements_per_bay=elements),
            bare_wheel(900.0, LOAD),
            SmoothRail(),
            Journey(9.0, 63.0, speed, 5e-5),
            law=MovingForce(),
        )
        last = run.position.values > 57.0 - 1e-9  # ten bays of 0.6 m
        computed.append(run.rail_acceleration.values[last].mean())
        print(f"{elements} a bay: exact {exact:.4f} m/s^2, computed {computed[-1]:.4f}")
    order = math.log2((computed[1] - computed[0]) / (computed[2] - computed[1]))
    limit = 2 * computed[2] - computed[1]
    print(f"order {order:.3f}, limit {limit:.4f} m/s^2")
    assert order == pytest.approx(1.0, abs=0.1)
    assert limit == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize(
    ("frequency", "published"),
    [(20.0, 3.887043e-7), (300.3069, 1.301281e-5), (1000.0801, 4.529462e-6)],
)
def test_point_mobility_of_the_infinite_rail(frequency, published):
    # i w / (2 sqrt2 EI^(1/4) kappa^(3/4)), kappa = k + i w c - m w^2
    bending, mass, bed, damping = 210e9 * 3038.3e-8, 60.2, 300e6, 3e4
    track = Track(GivenRail(EI=bending, mass=mass), WinklerFoundation(bed, damping), length=120.0)
    beam = BeamTrack(track, elements_per_bay=6, element_compliance=True)
    omega = 2 * np.pi * frequency
    computed = abs(1j * omega * receptance(beam, 60.02, np.array([frequency]))[0])
    kappa = bed + 1j * omega * damping - mass * omega**2
    exact = abs(1j * omega / (2 * math.sqrt(2) * bending**0.25 * kappa**0.75))
    print(f"{frequency} Hz: published {published:.6e}, exact {exact:.6e}, computed {computed:.6e}")
    assert exact == pytest.approx(published, rel=1e-6)
    assert computed == pytest.approx(published, rel=1e-4)

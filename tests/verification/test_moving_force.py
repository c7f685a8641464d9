"""Moving force on a simply supported Euler beam: Fryba (1972), Olsson, J. Sound Vib. 145 (1991)."""

import math

import numpy as np
import pytest

from contactstudy.contact.laws import MovingForce
from contactstudy.irregularity import SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import GivenRail, Track
from contactstudy.vehicle import bare_wheel

EI, MASS, LENGTH, FORCE = 2.1e7, 78.5, 25.0, 1e3
CRITICAL = math.pi / LENGTH * math.sqrt(EI / MASS)


def midspan(speed, steps=4000):
    """Time and downward midspan displacement while the force is on the beam."""
    track = Track(GivenRail(EI=EI, mass=MASS), support=None, length=LENGTH, ends="pinned")
    journey = Journey(0.0, LENGTH, speed, LENGTH / speed / steps, stations=(0.5 * LENGTH,))
    run = point_contact(
        BeamTrack(track, elements_per_bay=1),
        bare_wheel(1.0, FORCE),
        SmoothRail(),
        journey,
        law=MovingForce(),
    )
    return run.time.values, -run.station_displacement.values[0]


@pytest.mark.parametrize(
    ("alpha", "published"),
    [
        (0.05, 1.0483),
        (0.1, 1.0965),
        (0.25, 1.2576),
        (0.5, 1.7055),
        (0.617, 1.7317),
        (0.75, 1.7016),
        (1.0, 1.5481),
    ],
)
def test_amplification_of_midspan_deflection(alpha, published):
    _, w = midspan(alpha * CRITICAL)
    computed = w.max() / (FORCE * LENGTH**3 / (48.0 * EI))
    print(f"alpha {alpha}: published {published}, computed {computed:.5f}")
    assert computed == pytest.approx(published, abs=1e-4)


def test_25_m_beam_at_10_m_per_s():
    time, w = midspan(10.0, steps=8000)
    peak = int(np.argmax(w))
    print(f"maximum: 18.1595 mm at 1.3268 s; computed {1e3 * w[peak]:.4f} mm at {time[peak]:.4f} s")
    assert 1e3 * w[peak] == pytest.approx(18.1595, abs=2e-4)
    assert time[peak] == pytest.approx(1.3268, abs=2e-3)

"""Sprung mass crossing a simply supported beam: Yang & Yau, J. Struct. Eng. 123 (1997) 1512.

The sprung mass has no wheel: it is a wheel dof whose contact spring is the suspension.
"""

import numpy as np
import pytest

from contactstudy.contact.laws import LinearSpring, MovingForce
from contactstudy.irregularity import SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import GivenRail, Track
from contactstudy.vehicle import bare_wheel

EI, MASS, LENGTH = 2.87e9 * 2.90, 2303.0, 25.0
BODY, SPRING, SPEED = 5750.0, 1595e3, 100.0 / 3.6
LOAD = BODY * 9.81


def crossing(law):
    track = Track(GivenRail(EI=EI, mass=MASS), support=None, length=LENGTH, ends="pinned")
    journey = Journey(0.0, LENGTH, SPEED, LENGTH / SPEED / 9000, stations=(0.5 * LENGTH,))
    return point_contact(
        BeamTrack(track, elements_per_bay=1), bare_wheel(BODY, LOAD), SmoothRail(), journey, law=law
    )


def test_sprung_mass_at_100_km_per_h():
    run = crossing(LinearSpring(SPRING))
    w = -1e3 * run.station_displacement.values[0]
    peak = int(np.argmax(w))
    rows = [
        ("midspan maximum, mm", 2.40732, w[peak], 1e-4),
        ("its time, s", 0.3710, run.time.values[peak], 1e-3),
        ("static midspan, mm", 2.20615, 1e3 * LOAD * LENGTH**3 / (48 * EI), 1e-5),
        (
            "largest body acceleration, m/s^2",
            0.14797,
            np.abs(run.wheel_acceleration.values).max(),
            2e-5,
        ),
        ("smallest contact force, N", 55590.0, run.contact_force.values.min(), 1.0),
        ("largest contact force, N", 57258.0, run.contact_force.values.max(), 1.0),
        (
            "moving force midspan maximum, mm",
            2.39683,
            -1e3 * crossing(MovingForce()).station_displacement.values.min(),
            1e-4,
        ),
    ]
    for name, published, computed, tolerance in rows:
        print(f"{name}: published {published}, computed {computed:.6g}")
        assert computed == pytest.approx(published, abs=tolerance), name

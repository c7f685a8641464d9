"""What a run records of the rail: its acceleration against the deflection at fixed points."""

import numpy as np
import pytest

from contactstudy.contact.laws import HertzSpring, LinearSpring
from contactstudy.irregularity import HarmonicProfile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.vehicle import bare_wheel, train

SPEED, DT = 80.0, 2e-5
ROUGH = HarmonicProfile(np.array([2e-4]), np.array([6.0]), np.array([0.2]))


@pytest.mark.parametrize("law", [HertzSpring(9.25e10), LinearSpring(1e8)])
def test_rail_acceleration_is_that_of_the_point_which_the_wheel_passes(law):
    # the deflection of fixed points determines their acceleration, for Newmark's kinematics are
    #   a(n+1) = 4 (u(n+1) - u - dt v) / dt^2 - a,  v(n+1) = v + dt (a + a(n+1)) / 2
    direction = "Y" if isinstance(law, LinearSpring) else "Z"
    steps = np.array([150, 380, 500])
    stations = 3.0 + SPEED * DT * steps
    run = point_contact(
        BeamTrack(Track(length=9.0), "timoshenko", 8, True, direction),
        train([bare_wheel(900.0, 6e4)] * 2, [0.0, -0.6]),
        ROUGH,
        Journey(3.0, 4.0, SPEED, DT, fade_in=0.4, stations=tuple(stations)),
        law=law,
    )
    assert run.rail_acceleration.dims == ("wheel", "time")
    assert run.rail_acceleration.attrs["units"] == "m/s^2"
    # the second wheel comes 0.6 m = 375 steps later to where the first has been
    for wheel, step, station in ((0, 150, 0), (0, 380, 1), (0, 500, 2), (1, 525, 0)):
        u, v, a = run.station_displacement.values[station], 0.0, 0.0
        for n in range(step):
            a_next = 4.0 * (u[n + 1] - u[n] - DT * v) / DT**2 - a
            v, a = v + 0.5 * DT * (a + a_next), a_next
        seen = float(run.rail_acceleration[wheel, step])
        print(f"wheel {wheel} at {stations[station]:.3f} m: {seen:.6g}, from deflection {a:.6g}")
        assert abs(a) > 0.05
        assert seen == pytest.approx(a, rel=1e-5)

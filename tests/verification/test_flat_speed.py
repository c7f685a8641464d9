"""Peak force of a fresh flat over speed: linear while it passes slowly, falling once it is fast.

The centre of a rigid wheel of radius R on a flat of length l falls along an arc about the one edge
and rises along that about the other: r = -(l/2 - |X|)^2/2R, with a kink of l/R in the middle. On a
spring k between two masses, m = m_u m_t/(m_u + m_t), w^2 = k/m, T = 2 pi/w, its compression has

    x'' + w^2 x = -v^2/R on the arcs, and a jump of x' by v l/R at the kink.

With theta = w l/2v = pi l/(v T) and a = v^2/(R w^2) it is behind the kink, at w t = s,

    x = a (-1 + cos(theta + s) + 2 theta sin s) up to s = theta, then free.

Slow (v T < l): x_max -> 2 a theta = v l/(R w), the form of P1, linear in speed. Fast (v T > l): an
impulse, x_max -> w A/v with the area A = l^3/24R of the dip, falling with speed.
"""

import numpy as np
import pytest

from contactstudy.compare.impact import LumpedTrack
from contactstudy.compare.lumped_track import for_p1
from contactstudy.contact.filters import Trajectory
from contactstudy.contact.laws import HertzSpring
from contactstudy.irregularity import Flat, SmoothRail, with_defects
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track
from contactstudy.vehicle import wheel_column

R, M_U, M_T, K = 0.43, 890.0, 40.0, 1.25e9
OMEGA = np.sqrt(K * (1 / M_U + 1 / M_T))
PERIOD = 2 * np.pi / OMEGA


def closed_form(length: float, speed: float) -> float:
    """Largest force [N] of the spring, from the formulas above."""
    a, theta = speed**2 / (R * OMEGA**2), OMEGA * length / (2 * speed)
    s = np.linspace(0.0, theta, 20001)
    on_arc = a * (-1 + np.cos(theta + s) + 2 * theta * np.sin(s))
    rate = a * (-np.sin(2 * theta) + 2 * theta * np.cos(theta))
    return K * max(on_arc.max(), np.hypot(on_arc[-1], rate))


def lumped(length: float, speed: float) -> float:
    """The same by the program: trajectory of a wheel with a flat, and the lumped model of P1."""
    x = np.linspace(-0.6 * length, 0.5 * length + speed * PERIOD, 60001)
    level = Trajectory(R)(with_defects(SmoothRail(), None, Flat(0.0, length), R), x)
    track = LumpedTrack(M_U, K, M_T, 0.0, 0.0)
    return float(track.response(x / speed, level)[0].max())


@pytest.mark.parametrize("length", [0.01, 0.03, 0.06])
@pytest.mark.parametrize("fast", [0.1, 0.3, 0.5, 0.75, 1.5, 3.0, 10.0])
def test_lumped_model_is_the_closed_form(length, fast):
    speed = fast * length / PERIOD
    exact, found = closed_form(length, speed), lumped(length, speed)
    print(f"v T/l = {fast}: exact {exact / 1e3:.4g} kN, lumped {found / 1e3:.4g} kN")
    assert found == pytest.approx(exact, rel=5e-3)


def test_a_slow_flat_grows_linearly_and_a_fast_one_falls():
    length = 0.03
    slow = [length / PERIOD * fast for fast in (0.023, 0.057, 0.11, 0.19)]
    track = LumpedTrack(M_U, K, M_T, 0.0, 0.0)
    over_p1 = [closed_form(length, v) / track.p1(v * length / R) for v in slow]
    print("over P1", over_p1)
    # but for what the arcs unload, x = a (-1 + cos) against 2 a theta: at most v T/(pi l)
    np.testing.assert_allclose(over_p1, 1.0, atol=0.19 / np.pi + 0.01)
    fast = length / PERIOD * np.array([5.0, 10.0])
    impulse = OMEGA * K * length**3 / (24 * R * fast)
    np.testing.assert_allclose([closed_form(length, v) for v in fast], impulse, rtol=0.05)


def test_hertz_on_the_default_track_has_both_ranges():
    """A flat of 30 mm: linear up to v T = l/2, largest about v T = 1.5 l, falling beyond."""
    length, at = 0.03, 5.55
    track, vehicle = BeamTrack(Track(length=10.8), "timoshenko", 8, True), wheel_column()
    profile = with_defects(SmoothRail(), None, Flat(at, length), R)
    lump = for_p1(track.track, M_U, K)
    period = 2 * np.pi / np.sqrt(K * (1 / M_U + 1 / lump.track_mass))
    peaks = {}
    for kmh in (20, 30, 50, 150, 300):
        v = kmh / 3.6
        journey = Journey(at - 0.03, at + 0.03 + 3e-3 * v, v, 1e-5, fade_in=0.0)
        run = point_contact(
            track, vehicle, profile, journey, law=HertzSpring(9.2e10),
            contact_filter=Trajectory(R),
        )  # fmt: skip
        force = run.contact_force.values
        peaks[kmh] = (force.max() - force[0]) / 1e3
        print(f"{kmh} km/h, v T/l = {v * period / length:.2f}: {peaks[kmh]:.1f} kN over static")
    per_speed = [peaks[kmh] / kmh for kmh in (20, 30, 50)]
    assert 50 / 3.6 * period / length < 0.55
    np.testing.assert_allclose(per_speed, np.mean(per_speed), rtol=0.08)
    # ten times as fast is not ten times as much, and less than at half the speed
    assert peaks[150] < 2 * peaks[50] and peaks[300] < 0.8 * peaks[150]

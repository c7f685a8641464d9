"""Every integrator held to the order it declares, and the point solver to second order in time."""

import itertools
import math

import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.contact.laws import HertzSpring, LinearSpring, RigidContact
from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.stepper import (
    State,
    Steps,
    average_acceleration,
    generalised_alpha,
    march,
    newmark,
)
from contactstudy.irregularity import HarmonicProfile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track, WinklerFoundation
from contactstudy.vehicle import wheel_column

INTEGRATORS = [
    average_acceleration(),
    newmark(1 / 6 + 1 / 8, 0.5),
    newmark(0.36, 0.7),
    generalised_alpha(1.0),
    generalised_alpha(0.8),
    generalised_alpha(0.5),
    generalised_alpha(0.0),
]


def error_of_oscillator(integrator, dt):
    """Two damped modes under a harmonic load, against the exact solution."""
    zeta, omega, drive = np.array([0.05, 0.02]), np.array([3.0, 11.0]), 5.0
    system = LinearSystem(
        *(sp.csr_array(np.diag(d)) for d in (np.ones(2), 2 * zeta * omega, omega**2))
    )
    # steady state x = Re(H exp(i w t)), plus a free vibration that starts it from rest
    H = 1.0 / (omega**2 - drive**2 + 2j * zeta * omega * drive)
    damped = omega * np.sqrt(1 - zeta**2)
    p = -H.real
    q = (zeta * omega * p - (1j * drive * H).real) / damped
    t = 2.0
    exact = (H * np.exp(1j * drive * t)).real + np.exp(-zeta * omega * t) * (
        p * np.cos(damped * t) + q * np.sin(damped * t)
    )
    rest, load = np.zeros(2), np.ones(2)
    start = State(0, 0.0, rest, rest, load, load)
    n = round(t / dt)
    *_, last = march(
        system,
        None,
        start,
        Steps(dt, n),
        integrator,
        lambda k: np.full(2, math.cos(drive * k * dt)),
    )
    return np.abs(last.u - exact).max()


@pytest.mark.parametrize("integrator", INTEGRATORS, ids=lambda i: i.name)
def test_declared_order(integrator):
    errors = [error_of_oscillator(integrator, dt) for dt in (0.004, 0.002, 0.001)]
    orders = [math.log2(a / b) for a, b in itertools.pairwise(errors)]
    print(
        f"{integrator.name}: declared {integrator.order}, observed {orders[0]:.3f} {orders[1]:.3f}"
    )
    assert orders[1] == pytest.approx(integrator.order, abs=0.1)


LAWS = {
    "linear": (LinearSpring(1.2e9), None),
    "hertz": (HertzSpring(9.25e10), None),
    "hertz, generalised alpha": (HertzSpring(9.25e10), generalised_alpha(0.8)),
    "rigid": (RigidContact(), None),
}
SIGNALS = ("contact_force", "wheel_displacement", "rail_displacement")


@pytest.mark.parametrize("case", LAWS)
def test_point_solver_is_second_order_in_time(case):
    # On a damped foundation the highest modes of the mesh die out. Undamped ones that the time
    # step does not resolve ring on at the level of 1e-4 and hide the order.
    law, integrator = LAWS[case]
    profile = HarmonicProfile(np.array([2e-4, 2e-5]), np.array([2.0, 6.0]), np.array([0.0, 1.0]))
    track = Track(support=WinklerFoundation(73e6, 6e5), length=9.0)
    runs = []
    for refinement, dt in enumerate((4e-5, 2e-5, 1e-5, 5e-6)):
        journey = Journey(3.0, 5.4, 80.0, dt, fade_in=1.2)  # the end lies on a step of every dt
        run = point_contact(
            BeamTrack(track, elements_per_bay=1),
            wheel_column(),
            profile,
            journey,
            law=law,
            integrator=integrator,
        )
        runs.append(run.isel(time=slice(None, None, 2**refinement)))
    # A rigid contact feels the jumps of curvature at the element borders, and its start from
    # rest, as short transients of the force. The median over time is the error between them.
    size = np.median if case == "rigid" else np.mean
    for name in SIGNALS:
        changes = [
            math.sqrt(size((a[name].values - b[name].values) ** 2)) / np.std(runs[-1][name].values)
            for a, b in itertools.pairwise(runs)
        ]
        orders = [math.log2(a / b) for a, b in itertools.pairwise(changes)]
        print(f"{case}: {name}: change at the last refinement {changes[-1]:.1e}, observed", orders)
        assert min(orders) > 1.85, name

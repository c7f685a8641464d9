"""The production path against eqs (4)-(6) assembled element by element in every step.

The twin below shares no code with the package: textbook Hermite matrices, dense algebra, the
contact element added to the system matrix each step, Newmark's average acceleration.
"""

import math

import numpy as np
import pytest

from contactstudy.contact.laws import HertzSpring, LinearSpring
from contactstudy.irregularity import HarmonicProfile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Ballast, DiscreteSupports, GivenRail, Track
from contactstudy.vehicle import wheel_column

EI, MASS, BAYS, SPACING, PER_BAY = 6.4e6, 60.0, 6, 0.6, 3
PAD, PAD_C, SLEEPER, BALLAST, BALLAST_C = 65e6, 75e3, 125.5, 137.75e6, 58.8e3
SPEED, DT = 300 / 3.6, 1e-4
ROUGH = HarmonicProfile(np.array([2e-5, 1e-5]), np.array([9.0, 31.0]), np.array([0.3, 1.1]))
JOURNEY = Journey(0.75, 2.75, SPEED, DT, fade_in=0.0, stations=(1.7,))


def dense_track():
    """M, C, K of clamped rail (w, theta per node), sleepers, then wheel, bogie, car."""
    n_elements = BAYS * PER_BAY
    L = SPACING / PER_BAY
    n_rail = 2 * (n_elements + 1)
    n = n_rail + BAYS + 1 + 3
    M, C, K = np.zeros((3, n, n))
    k = np.array(
        [
            [12, 6 * L, -12, 6 * L],
            [6 * L, 4 * L**2, -6 * L, 2 * L**2],
            [-12, -6 * L, 12, -6 * L],
            [6 * L, 2 * L**2, -6 * L, 4 * L**2],
        ]
    )
    m = np.array(
        [
            [156, 22 * L, 54, -13 * L],
            [22 * L, 4 * L**2, 13 * L, -3 * L**2],
            [54, 13 * L, 156, -22 * L],
            [-13 * L, -3 * L**2, -22 * L, 4 * L**2],
        ]
    )
    for e in range(n_elements):
        d = np.arange(2 * e, 2 * e + 4)
        K[np.ix_(d, d)] += EI / L**3 * k
        M[np.ix_(d, d)] += MASS * L / 420 * m
    for j in range(BAYS + 1):
        rail, sleeper = 2 * j * PER_BAY, n_rail + j
        for A, value in ((K, PAD), (C, PAD_C)):
            A[rail, rail] += value
            A[sleeper, sleeper] += value
            A[rail, sleeper] -= value
            A[sleeper, rail] -= value
        K[sleeper, sleeper] += BALLAST
        C[sleeper, sleeper] += BALLAST_C
        M[sleeper, sleeper] += SLEEPER
    wheel, bogie, car = n - 3, n - 2, n - 1
    for dof, value in ((wheel, 890.0), (bogie, 760.0), (car, 5219.0)):
        M[dof, dof] += value
    for one, two, k1, c1 in ((wheel, bogie, 0.59e6, 19.6e3), (bogie, car, 0.1325e6, 22.55e3)):
        for A, value in ((K, k1), (C, c1)):
            A[one, one] += value
            A[two, two] += value
            A[one, two] -= value
            A[two, one] -= value
    free = np.setdiff1d(np.arange(n), [0, 1, n_rail - 2, n_rail - 1])
    return M, C, K, free, L, wheel


def shape_row(x, L, n):
    """Hermite functions N1..N4 on their dofs."""
    e = int(x // L)
    s = x / L - e
    row = np.zeros(n)
    row[2 * e : 2 * e + 4] = (
        1 - 3 * s**2 + 2 * s**3,
        L * (s - 2 * s**2 + s**3),
        3 * s**2 - 2 * s**3,
        L * (s**3 - s**2),
    )
    return row


def brute_force(law):
    """Contact force, wheel displacement, wheel acceleration, rail displacement under the wheel."""
    M, C, K, free, L, wheel = dense_track()
    n = len(M)
    F = (890.0 + 760.0 + 5219.0) * 9.81
    x = JOURNEY.start + SPEED * DT * np.arange(JOURNEY.n_steps + 1)
    r_paper = -ROUGH(x)  # the paper's positive r is a dip
    a0, a1 = 4 / DT**2, 2 / DT
    u, v, a = np.zeros((3, n))
    out = []
    on_wheel = np.eye(n)[wheel]
    for step, position in enumerate(x):
        N = shape_row(position, L, n)
        if step == 0:
            S, rhs = K, np.zeros(n)
        else:
            S = K + a0 * M + a1 * C
            rhs = M @ (a0 * u + 4 / DT * v + a) + C @ (a1 * u + v)
        if isinstance(law, LinearSpring):
            k_r = law.stiffness
            T = np.vstack((on_wheel, N))  # eq. (4), first row the wheel
            contact = T.T @ np.array([[k_r, -k_r], [-k_r, k_r]]) @ T
            f = -F * N  # eq. (5): the load sits on the rail, downwards
            # eq. (6) with r_paper; the wheel's sign is minus, the rail's plus
            f = f + (N - on_wheel) * k_r * r_paper[step]
            new = np.zeros(n)
            A = (S + contact)[np.ix_(free, free)]
            new[free] = np.linalg.solve(A, (rhs + f)[free])
            spring = k_r * (new[wheel] - N @ new + r_paper[step])  # tension
            force = F - spring
        else:
            new, force = newton(
                law.stiffness, S, rhs - F * on_wheel, on_wheel - N, u, free, r_paper[step], F
            )
        if step > 0:
            a_new = a0 * (new - u) - 4 / DT * v - a
            v = v + 0.5 * DT * (a + a_new)
            a = a_new
        u = new
        out.append((force, u[wheel], a[wheel], N @ u))
    return np.array(out).T


def newton(k_hertz, S, rhs, gap_row, guess, free, r_paper, F):
    """Full Newton iteration of S u = rhs + gap_row * k_H (-g)^(3/2) on all dofs."""
    u = guess.copy()
    if not u.any():
        u -= gap_row * (F / k_hertz) ** (2 / 3)  # pressed a little, so the start is regular
    for _ in range(60):
        d = max(-(gap_row @ u + r_paper), 0.0)
        residual = S @ u - rhs - gap_row * k_hertz * d**1.5
        A = S + 1.5 * k_hertz * math.sqrt(d) * np.outer(gap_row, gap_row)
        move = np.zeros(len(u))
        move[free] = np.linalg.solve(A[np.ix_(free, free)], -residual[free])
        u += move
        if np.abs(move).max() < 1e-17:
            break
    return u, k_hertz * max(-(gap_row @ u + r_paper), 0.0) ** 1.5


def production(law):
    support = DiscreteSupports(SPACING, PAD, PAD_C, 0.0, SLEEPER, Ballast(BALLAST, BALLAST_C))
    track = Track(GivenRail(EI=EI, mass=MASS), support, length=BAYS * SPACING)
    run = point_contact(
        BeamTrack(track, elements_per_bay=PER_BAY), wheel_column(), ROUGH, JOURNEY, law=law
    )
    names = ("contact_force", "wheel_displacement", "wheel_acceleration", "rail_displacement")
    return [run[name].values for name in names]


@pytest.mark.parametrize("law", [LinearSpring(1.2e9), LinearSpring(1e11), HertzSpring(9.25e10)])
def test_production_path_equals_assembly_in_every_step(law):
    names = ("contact force", "wheel displacement", "wheel acceleration", "rail displacement")
    for name, ours, twin in zip(names, production(law), brute_force(law), strict=True):
        difference = np.abs(ours - twin).max() / np.abs(twin).max()
        print(f"{law}: {name}: largest relative difference {difference:.1e}")
        assert difference < 1e-10, name

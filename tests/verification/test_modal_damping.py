"""Modal damping of decks: decay of their modes, a moving force, and the matrix written out."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from contactstudy.contact.laws import LinearSpring, MovingForce
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.stepper import State, Steps, average_acceleration, march
from contactstudy.irregularity import SmoothRail
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.point_case import point_coupling
from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import GivenDeck
from contactstudy.track.deck_modes import deck_modes
from contactstudy.track.model import Ballast, DiscreteSupports, GivenRail, Track
from contactstudy.track.receptance import receptance
from contactstudy.track.space_beam import displacement
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import Train, bare_wheel

EI, MASS, RATIO = 8.3e9, 2303.0, 0.03
LAYER = Ballast(stiffness=1e10, damping=0.0, lateral_stiffness=1e10, lateral_damping=0.0)


def beams(spans, per_deck=(1,), **bridge):
    """Beams below rails without mass, hard on them; nothing damps but the modes."""
    deck = GivenDeck(1e10, 1.0, EI / 1e10, mass_per_length=MASS, damping_ratio=RATIO)
    support = DiscreteSupports(
        pad_stiffness=1e10, pad_damping=0.0, pad_length=0.0, sleeper_mass=0.0, layer=LAYER,
        spacing=0.5,
    )  # fmt: skip
    given = {
        "approach_before": 12.0, "approach_behind": 12.0, "bearing_stiffness": 1e13,
        "deck_damping": "modal",
    } | bridge  # fmt: skip
    made = Bridge(spans=spans, spans_per_deck=per_deck, deck=deck, **given)
    track = Track(rail=GivenRail(EI=1e1, mass=1e-3), support=support, structure=made)
    return StructureTrack(track)


@pytest.mark.parametrize("per_deck", [1, 2])
@pytest.mark.parametrize("number", [0, 1, 2, 5])
def test_a_mode_decays_with_the_ratio_asked_for(per_deck, number):
    """Of single spans, and of one deck over two; the mode beyond the limit does not decay."""
    f1 = math.pi / (2 * 25.0**2) * math.sqrt(EI / MASS)
    structure = beams((25.0, 25.0), (per_deck,), modal_damping_up_to=10.0 * f1)
    modes = deck_modes(structure.nodes, 0, True, 60.0 * f1)
    damped = int(np.count_nonzero(modes.frequencies <= 10.0 * f1))
    # i^2 f1, and between them of two spans (x/pi)^2 f1 with tan x = tanh x, x = 3.93, 7.07, 10.2
    assert damped == {1: 3, 2: 5}[per_deck]
    k = min(number, damped)
    final = structure.nodes.dofs(True)[structure.nodes.decks[0].nodes]
    dofs = np.unique(final[final >= 0])
    system = LinearSystem.stacked(structure)
    u = np.zeros(structure.n_dofs)
    u[dofs] = modes.shapes[k]
    # rails and layer follow without force, so that nothing but the deck swings
    rest = np.setdiff1d(np.arange(len(u)), dofs)
    K = system.stiffness.tocsc()
    u[rest] = spla.spsolve(K[rest][:, rest], -(K[rest][:, dofs] @ u[dofs]))
    zero = np.zeros_like(u)
    a = Factor(system.mass + 1e-12 * sp.eye_array(len(u))).solve(-(system.stiffness @ u))
    a[rest] = 0.0
    dt = 1.0 / modes.frequencies[k] / 40
    steps = march(
        system, None, State(0, 0.0, u, zero, a, zero), Steps(dt, 200), average_acceleration(), zero
    )
    q = np.array([1.0, *(float(modes.momenta[k] @ state.u[dofs]) for state in steps)])
    # q(n+1) = 2 Re(z) q(n) - |z|^2 q(n-1), and z = (1 + s dt/2)/(1 - s dt/2) for exp(s t)
    (twice, square), *_ = np.linalg.lstsq(np.c_[q[1:-1], -q[:-2]], q[2:])
    z = 0.5 * twice + 1j * math.sqrt(square - 0.25 * twice**2)
    s = 2.0 / dt * (z - 1.0) / (z + 1.0)
    print(f"mode {k + 1}, {modes.frequencies[k]:.3f} Hz: ratio {-s.real / abs(s):.6f}")
    expected = RATIO if k < damped else 0.0
    assert -s.real / abs(s) == pytest.approx(expected, rel=2e-3, abs=1e-5)
    assert abs(s) / (2 * math.pi) == pytest.approx(modes.frequencies[k], rel=2e-3)


def exact_midspan(time, L, speed, force, damped, count=60):
    """Modal sum for a force that comes onto a simply supported beam at time 0, and leaves it."""
    total, on = np.zeros_like(time), L / speed

    def free(t, q, v, w, zeta):
        wd = w * math.sqrt(1 - zeta**2)
        b = (v + zeta * w * q) / wd
        return np.exp(-zeta * w * t) * (q * np.cos(wd * t) + b * np.sin(wd * t))

    for n in range(1, count, 2):  # even modes are still at midspan
        w = (n * math.pi / L) ** 2 * math.sqrt(EI / MASS)
        zeta, drive = (RATIO if n <= damped else 0.0), n * math.pi * speed / L
        H = 2 * force / (MASS * L) / (w**2 - drive**2 + 2j * zeta * w * drive)

        def forced(t, H=H, drive=drive, w=w, zeta=zeta):
            q = (H * np.exp(1j * drive * t)).imag
            return q + free(t, -H.imag, -(H * 1j * drive).imag, w, zeta)

        during = forced(np.clip(time, 0.0, on))
        h = 1e-6
        q, v = forced(np.array(on)), (forced(np.array(on + h)) - forced(np.array(on - h))) / (2 * h)
        later = free(np.maximum(time - on, 0.0), q, v, w, zeta)
        total += math.sin(n * math.pi / 2) * np.where(time < on, during, later)
    return np.where(time > 0.0, total, 0.0)


def test_a_force_moves_over_a_beam_whose_first_modes_are_damped():
    L, force = 25.0, 1e5
    speed = 0.5 * math.pi / L * math.sqrt(EI / MASS)
    structure = beams((L,), approach_behind=40.0)
    deck = structure.nodes.decks[0]
    (dofs,), (weights,) = structure.rows_of(
        deck, np.array([12.0 + L / 2]), displacement("Z", (0, 0, 0))
    )
    seen = []
    data = point_contact(
        structure,
        bare_wheel(1.0, force),
        SmoothRail(),
        Journey(start=0.0, end=76.0, speed=speed, time_step=0.1 / speed, fade_in=0.0),
        law=MovingForce(),
        observers=[EachState(lambda state: seen.append(-float(weights @ state.u[dofs])))],
    )
    expected = exact_midspan(data.time.values - 12.0 / speed, L, speed, force, damped=3)
    undamped = exact_midspan(data.time.values - 12.0 / speed, L, speed, force, damped=0)
    error = np.linalg.norm(seen - expected) / np.linalg.norm(expected)
    without = np.linalg.norm(seen - undamped) / np.linalg.norm(expected)
    print(f"difference {error:.2e}; from the undamped solution {without:.2e}")
    assert error < 1e-2
    assert without > 0.1


@pytest.mark.parametrize("planar", [True, False])
def test_forces_are_those_of_the_matrix_written_out(planar):
    """Half a step with dampers beside the band, and the dense matrix without any trick."""
    car = ("s300",) if planar else ("high_speed_trailer",)
    train = Train(cars=car, model="planar" if planar else "three_dimensional").vehicle(2)
    bridge = Bridge((8.0, 6.0), approach_before=12.0, approach_behind=12.0, deck_damping="modal")
    structure = StructureTrack(Track(structure=bridge), planar=planar)
    journey = Journey(start=27.0, end=29.0, time_step=5e-4, fade_in=0.5)
    passage = Passage(structure, train, SmoothRail(), journey)
    coupling = point_coupling(passage, LinearSpring(1e9))
    system, dt, integrator = passage.system, 5e-4, average_acceleration()
    assert system.dampers is not None
    system = replace(system, dampers=100.0 * system.dampers)  # so that they are felt in one step
    factor, of_a = integrator.factor(system, dt), 0.25 * dt**2
    G = system.dampers.toarray()
    S = integrator.matrix(system, dt).toarray() + 0.5 * dt * G.T @ G
    rng = np.random.default_rng(1)
    exact, u = rng.normal(size=factor.n), 1e-4 * rng.normal(size=factor.n)
    rhs = S @ exact
    np.testing.assert_allclose(factor.solve(rhs), exact, rtol=0.0, atol=1e-9 * abs(exact).max())
    both = factor.solve(np.c_[rhs, S @ u])
    np.testing.assert_allclose(both[:, 0], exact, rtol=0.0, atol=1e-9 * abs(exact).max())
    attached = coupling.attached(factor, of_a)
    y = factor.forward(rhs)
    step = attached.half_way(2, u, of_a, y)
    dofs, weights = coupling.gaps.rows(2)
    B = np.zeros((len(dofs), factor.n))
    for row, d, w in zip(B, dofs, weights, strict=True):
        np.add.at(row, d, w)
    W = of_a * B @ np.linalg.solve(S, B.T)
    np.testing.assert_allclose(attached.compliance(2), W, rtol=0.0, atol=1e-8 * np.diag(W).min())
    gap = B @ (u + of_a * exact) - coupling.gaps.irregularity[2]
    force = coupling.forces(2, W, gap)
    scale = abs(force).max()
    np.testing.assert_allclose(step.record["contact_force"], force, rtol=0.0, atol=1e-7 * scale)
    a = np.linalg.solve(S, rhs + B.T @ force)
    np.testing.assert_allclose(factor.backward(y), a, rtol=0.0, atol=1e-7 * abs(a).max())
    # and it matters: without the dampers the accelerations are others
    assert (
        abs(Factor(integrator.matrix(system, dt)).solve(rhs) - exact).max()
        > 1e-3 * abs(exact).max()
    )


def test_receptance_has_the_dampers_too():
    structure = beams((25.0,))
    f1 = math.pi / (2 * 25.0**2) * math.sqrt(EI / MASS)
    found = abs(receptance(structure, 24.75, np.array([f1]))[0])
    # first mode at midspan, 2/(m L) / (2 zeta w^2), and the static share of the others
    assert found == pytest.approx(
        2 / (MASS * 25.0) / (2 * RATIO * (2 * math.pi * f1) ** 2), rel=2e-2
    )

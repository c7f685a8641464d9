"""The active set against brute force and its conditions on random problems."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls

from contactstudy.contact.complementarity import contact_forces, press
from contactstudy.exceptions import InputError, NumericalError


def problem(seed: int, n: int, rank: int) -> tuple[np.ndarray, np.ndarray]:
    """A random flexibility, badly conditioned when the rank is low, and random gaps."""
    rng = np.random.default_rng(seed)
    G = rng.standard_normal((n, rank))
    M = G @ G.T + np.diag(10.0 ** rng.uniform(-6, 0, n))
    return M, rng.standard_normal(n)


def brute_force(M: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Try every set of points in contact."""
    n = len(gap)
    for choice in product((False, True), repeat=n):
        a = np.array(choice)
        forces = np.zeros(n)
        forces[a] = np.linalg.solve(M[np.ix_(a, a)], -gap[a])
        if np.all(forces >= 0) and np.all((gap + M @ forces)[~a] >= 0):
            return forces
    raise AssertionError("no solution")


@given(st.integers(0, 10**6), st.integers(1, 7), st.integers(1, 7))
@settings(max_examples=60)
def test_equals_brute_force(seed: int, n: int, rank: int) -> None:
    M, gap = problem(seed, n, rank)
    solution = contact_forces(M, gap)
    expected = brute_force(M, gap)
    np.testing.assert_allclose(
        solution.forces, expected, rtol=1e-6, atol=1e-8 * (1 + expected.max())
    )


@given(st.integers(0, 10**6), st.integers(1, 60), st.integers(1, 60), st.booleans())
@settings(max_examples=60)
def test_conditions_hold_and_no_tension(seed: int, n: int, rank: int, warm: bool) -> None:
    M, gap = problem(seed, n, rank)
    guess = np.random.default_rng(seed + 1).random(n) < 0.5 if warm else None
    solution = contact_forces(M, gap, guess)
    slack = gap + M @ solution.forces
    scale = np.abs(M @ np.abs(solution.forces)).max() + np.abs(gap).max()
    assert np.all(solution.forces >= 0)
    assert np.all(slack >= -1e-9 * scale)
    assert np.abs(solution.forces * slack).max() <= 1e-8 * scale * (1 + solution.forces.max())


def test_equals_nonnegative_least_squares() -> None:
    # min 1/2 lam M lam + g lam over lam >= 0 is NNLS with M = L L^T: |L^T lam + L^-1 g|
    M, gap = problem(3, 40, 20)
    L = np.linalg.cholesky(M)
    expected, _ = nnls(L.T, -np.linalg.solve(L, gap))
    np.testing.assert_allclose(
        contact_forces(M, gap).forces, expected, rtol=1e-6, atol=1e-7 * expected.max()
    )


@given(st.integers(0, 10**6), st.integers(1, 30))
@settings(max_examples=30)
def test_descent_comes_to_the_same_end(seed: int, n: int) -> None:
    # the safeguard against cycling, switched on from the first exchange
    M, gap = problem(seed, n, n)
    safe = contact_forces(M, gap, ~(gap < 0), patience=-1)
    np.testing.assert_allclose(safe.forces, contact_forces(M, gap).forces, atol=1e-12)


def test_open_contact_carries_nothing() -> None:
    solution = contact_forces(np.eye(3), np.array([1.0, 2.0, 3.0]), np.ones(3, dtype=bool))
    assert not solution.active.any()
    assert np.all(solution.forces == 0)


def test_press_meets_the_resultant() -> None:
    rng = np.random.default_rng(0)
    M, _ = problem(1, 30, 30)
    M = M + 5  # everything gives way together
    gap, normal = rng.random(30), rng.uniform(0.9, 1.0, 30)
    solution = press(M, gap, normal, 3.0)
    assert normal @ solution.forces == pytest.approx(3.0, rel=1e-11)
    direct = contact_forces(M, gap - solution.approach * normal)
    np.testing.assert_allclose(solution.forces, direct.forces, atol=1e-10)
    step = 1e-6
    more = press(M, gap, normal, 3.0 + step)
    assert (more.approach - solution.approach) / step == pytest.approx(
        1 / solution.stiffness, rel=1e-5
    )


def test_errors_say_what_is_wrong() -> None:
    with pytest.raises(InputError, match="must be positive"):
        press(np.eye(2), np.zeros(2), np.ones(2), -1.0)
    with pytest.raises(NumericalError, match="not positive definite"):
        contact_forces(-np.eye(2), -np.ones(2))
    M, gap = problem(5, 30, 30)
    with pytest.raises(NumericalError, match="30 points"):
        contact_forces(M, gap, max_iterations=1)

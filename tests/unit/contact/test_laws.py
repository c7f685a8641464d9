import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contactstudy.contact.laws import (
    HertzSpring,
    LinearSpring,
    MovingForce,
    RigidContact,
    point_forces,
)
from contactstudy.exceptions import InputError

K_H, K_R = 9e10, 1e9
gaps = st.lists(st.floats(-3e-4, 3e-4), min_size=1, max_size=4)


def compliance(n, seed=0):
    a = np.random.default_rng(seed).standard_normal((n, n))
    return 1e-9 * (a @ a.T + 0.1 * np.eye(n))


@given(gaps, st.integers(0, 5))
def test_hertz_force_satisfies_the_law(gap, seed):
    gap, W = np.array(gap), compliance(len(gap), seed)
    force = point_forces(HertzSpring(K_H), W, gap, np.zeros(len(gap)))
    g = gap + W @ force
    np.testing.assert_allclose(force, K_H * np.maximum(-g, 0.0) ** 1.5, rtol=1e-6, atol=1e-4)
    assert np.all(force >= 0.0)


@given(gaps, st.integers(0, 5), st.sampled_from([LinearSpring(K_R), RigidContact()]))
def test_linear_laws_solve_their_complementarity_problem(gap, seed, law):
    gap, W = np.array(gap), compliance(len(gap), seed)
    n = len(gap)
    loads = np.full(n, 6e4)
    force = point_forces(law, W, gap, loads)
    A, b = W, -gap
    if isinstance(law, LinearSpring):
        A, b = W + np.eye(n) / K_R, loads / K_R - gap
    # the one active set that fits, by trying all
    for pattern in itertools.product([False, True], repeat=n):
        active, candidate = np.array(pattern), np.zeros(n)
        if active.any():
            candidate[active] = np.linalg.solve(A[np.ix_(active, active)], b[active])
        slack = A @ candidate - b
        if np.all(candidate >= 0.0) and np.all(slack[~active] >= -1e-15):
            np.testing.assert_allclose(force, candidate, rtol=1e-8, atol=1e-6)
            return
    raise AssertionError("no active set fits")


def test_one_and_several_wheels_agree():
    gap = np.array([-1e-4, -2e-4])
    W = np.diag([1e-9, 2e-9])
    for law in (HertzSpring(K_H), LinearSpring(K_R), RigidContact()):
        both = point_forces(law, W, gap, np.full(2, 6e4))
        for i in range(2):
            one = point_forces(law, W[i : i + 1, i : i + 1], gap[i : i + 1], np.array([6e4]))
            assert both[i] == pytest.approx(one[0], rel=1e-12)


def test_lateral_contact_holds_in_tension():
    force = point_forces(LinearSpring(K_R), np.array([[1e-9]]), np.array([1e-4]), np.zeros(1), True)
    assert force[0] == pytest.approx(-1e-4 / 2e-9)
    assert point_forces(LinearSpring(K_R), np.array([[1e-9]]), np.array([1e-4]), np.zeros(1)) == 0


def test_moving_force_is_the_static_load():
    loads = np.array([1.0, 2.0])
    np.testing.assert_array_equal(
        point_forces(MovingForce(), compliance(2), np.array([-1.0, 1.0]), loads), loads
    )


@pytest.mark.parametrize("law", [LinearSpring, HertzSpring])
@pytest.mark.parametrize("stiffness", [0.0, -1e9, float("nan")])
def test_impossible_stiffness(law, stiffness):
    allowed = "must be finite" if np.isnan(stiffness) else "must be above 0"
    with pytest.raises(InputError, match=f"{law.__name__}.stiffness = .*: {allowed}"):
        law(stiffness)


@pytest.mark.parametrize(
    "law", [LinearSpring(K_R), HertzSpring(K_H), RigidContact()], ids=lambda law: type(law).__name__
)
@pytest.mark.parametrize("apart", [False, True])
def test_beside_the_rail_a_spring_holds_both_ways_whatever_the_law_on_top(law, apart):
    """All contacts fulfil their own law at the gaps that all forces leave."""
    k_y, n = 8e8, 6
    beside = np.array([0.0, k_y, 0.0, k_y, 0.0, k_y])
    top, W, loads = beside == 0.0, compliance(n, 3), np.where(beside == 0.0, 6e4, 7e3)
    gap = np.array([-2e-4, 4e-4, -1e-4, -4e-4, 9e-4 if apart else -2e-4, 2e-5])
    force = point_forces(law, W, gap, loads, beside=beside)
    g = gap + W @ force
    np.testing.assert_allclose(force[~top], -k_y * g[~top], rtol=1e-8)
    assert np.ptp(np.sign(force[~top])) > 0.0  # pull and push
    g, force = g[top], force[top]
    assert (force[2] == 0.0) == apart
    if isinstance(law, HertzSpring):
        np.testing.assert_allclose(force, K_H * np.maximum(-g, 0.0) ** 1.5, rtol=1e-8, atol=1e-4)
    elif isinstance(law, LinearSpring):
        np.testing.assert_allclose(force, np.maximum(6e4 - K_R * g, 0.0), rtol=1e-8, atol=1e-4)
    else:
        np.testing.assert_allclose(g[force > 0.0], 0.0, atol=1e-15)
        assert np.all(g >= -1e-15)

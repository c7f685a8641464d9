"""The augmented Lagrangian against brute force, its conditions, and the limit of the penalty."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.contact.augmented import AugmentedLagrangian, Penalty, PointProblem
from contactstudy.contact.press import press_curve
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import ContactPoints, contact_points
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.solids.wheel import WheelRecipe, rigid_wheel
from contactstudy.verification.cases.point_loads import boussinesq

TOLERANCE = 1e-9


def problem(seed: int, n: int, rank: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Flexibility (singular if rank < n, but any force opens every gap), gaps, compliances."""
    rng = np.random.default_rng(seed)
    G = rng.uniform(0.1, 1.0, (n, rank))
    return G @ G.T, rng.standard_normal(n), 10.0 ** rng.uniform(-2, 0, n)


def brute_force(W: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Try every set of points in contact, without a penalty."""
    for choice in product((False, True), repeat=len(gap)):
        a = np.array(choice)
        forces = np.zeros(len(gap))
        forces[a] = np.linalg.solve(W[np.ix_(a, a)], -gap[a])
        if np.all(forces >= 0) and np.all((gap + W @ forces)[~a] >= 0):
            return forces
    raise AssertionError("no solution")


def augmented(seed: int, n: int, rank: int):  # type: ignore[no-untyped-def]
    W, gap, c = problem(seed, n, rank)
    law = AugmentedLagrangian(TOLERANCE)
    solution, overlap = law.forces(PointProblem(W + np.diag(c), gap, c, np.zeros(n)))
    return W, gap, c, solution, overlap


@given(st.integers(0, 10**6))
@settings(max_examples=50)
def test_two_points_equal_brute_force(seed: int) -> None:
    rng = np.random.default_rng(seed)
    W = np.array([[1.0, 0.0], [0.0, 1.0]]) + 0.9 * rng.random() * np.array([[0, 1.0], [1.0, 0]])
    gap, c = rng.standard_normal(2), np.full(2, 0.1)
    law = AugmentedLagrangian(TOLERANCE)
    solution, _ = law.forces(PointProblem(W + np.diag(c), gap, c, np.zeros(2)))
    np.testing.assert_allclose(solution.forces, brute_force(W, gap), atol=1e-7)


@given(st.integers(0, 10**6), st.integers(1, 6))
@settings(max_examples=40)
def test_gaps_equal_brute_force(seed: int, n: int) -> None:
    W, gap, _, solution, _ = augmented(seed, n, n + 2)
    expected = W @ brute_force(W, gap)
    np.testing.assert_allclose(W @ solution.forces, expected, atol=10 * n * TOLERANCE)


@given(st.integers(0, 10**6), st.integers(1, 30), st.integers(1, 30))
@settings(max_examples=60)
def test_complementarity(seed: int, n: int, rank: int) -> None:
    W, gap, _, solution, overlap = augmented(seed, n, rank)
    g, slack = gap + W @ solution.forces, TOLERANCE + 1e-13 * np.abs(W @ solution.forces).max()
    assert np.all(solution.forces >= 0)
    assert np.all(g >= -2 * slack)
    assert np.all(np.abs(g[solution.forces > 0]) <= 2 * slack)
    np.testing.assert_allclose(overlap, np.maximum(-g, 0.0), atol=2 * slack)


def pressed_nodes(penalty: float, tolerance: float | None):  # type: ignore[no-untyped-def]
    """Static press at 80 kN, pressure at the nodes of a 2 mm grid on two half-spaces."""
    points = node_points()
    law = Penalty(penalty) if tolerance is None else AugmentedLagrangian(tolerance, penalty)
    return press_curve(points, half_spaces(points), np.array([80e3]), law)


def node_points() -> ContactPoints:
    x = 2e-3 * np.arange(-5, 6)
    bodies = Geometry(rail_curve("60E1"), wheel_curve("cylinder"), 0.43)
    return contact_points(bodies, x, x, quadrature="nodes")


def half_spaces(points: ContactPoints) -> np.ndarray:
    """Boussinesq's flexibility of two half-spaces, blunt at the load."""
    x, y = points.x_of_points, points.y_of_points
    d = np.maximum(np.hypot(x[:, None] - x, y[:, None] - y), 0.6e-3)
    return 2 * boussinesq(d, 0 * d, 0 * d, 210e9, 0.3)[..., 2]


def test_limit_of_a_growing_penalty() -> None:
    penalties = np.array([1e15, 1e16, 1e17, 1e18])
    limit = pressed_nodes(1e16, 1e-13)
    curves = [pressed_nodes(e, None) for e in penalties]
    errors = np.array([c.approach[0] - limit.approach[0] for c in curves])
    order = -np.diff(np.log(errors)) / np.diff(np.log(penalties))
    print("approach added by the penalty, m:", errors, "observed order in 1/eps:", order)
    np.testing.assert_allclose(order, 1.0, atol=0.02)
    forces = np.array(
        [np.abs(c.solutions[0].forces - limit.solutions[0].forces).max() for c in curves]
    )
    order = -np.diff(np.log(forces)) / np.diff(np.log(penalties))
    print("largest difference of a nodal force, N:", forces, "order:", order)
    np.testing.assert_allclose(order[1:], 1.0, atol=0.02)


def test_press_leaves_what_it_says() -> None:
    points = node_points()
    plain, tight = pressed_nodes(1e16, None), pressed_nodes(1e16, 1e-10)
    assert plain.penetration[0] == pytest.approx(
        (plain.solutions[0].forces / (1e16 * points.area)).max()
    )
    assert plain.penetration[0] > 1e-8 and tight.penetration[0] <= 1e-10
    forces = tight.solutions[0].forces
    assert points.normal_z @ forces == pytest.approx(80e3, rel=1e-11)
    g = points.gap - tight.approach[0] * points.normal_z + half_spaces(points) @ forces
    assert g.min() > -1.1e-10 and np.abs(g[forces > 0]).max() < 1.1e-10
    # the result does not depend on the penalty any more
    other = pressed_nodes(1e15, 1e-10)
    assert other.approach[0] == pytest.approx(tight.approach[0], abs=2e-10)


def test_a_good_start_needs_one_solution() -> None:
    W, gap, c, solution, _ = augmented(1, 10, 14)
    once = AugmentedLagrangian(2 * TOLERANCE, max_updates=1)
    again, _ = once.forces(PointProblem(W + np.diag(c), gap, c, solution.forces))
    np.testing.assert_allclose(again.forces, solution.forces, atol=1e-6)
    with pytest.raises(NumericalError, match="from touching"):
        once.forces(PointProblem(W + np.diag(c), gap, c, np.zeros(10)))


def test_a_multiplier_that_is_too_large_is_not_taken() -> None:
    # a start above the solution leaves a gap under force, not an overlap
    W, gap, c, solution, _ = augmented(1, 10, 14)
    too_large = PointProblem(W + np.diag(c), gap, c, solution.forces + 1.0)
    again, _ = AugmentedLagrangian(TOLERANCE).forces(too_large)
    np.testing.assert_allclose(W @ again.forces, W @ solution.forces, atol=20 * TOLERANCE)


def test_choice() -> None:
    wheel = rigid_wheel(WheelRecipe(size=0.004))
    assert SurfaceContact(wheel).enforcement == Penalty()
    assert SurfaceContact(wheel, tolerance=1e-8).enforcement == AugmentedLagrangian(1e-8)
    with pytest.raises(InputError, match="above 0"):
        AugmentedLagrangian(0.0)
    with pytest.raises(InputError) as caught:
        SurfaceContact(wheel, penalty=-1.0, tolerance=0.0, quadrature="simpson")
    assert len(caught.value.problems) == 3

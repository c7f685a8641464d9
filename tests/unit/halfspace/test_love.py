"""Half-spaces under uniform pressure on rectangles, and their frictionless contact."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from contactstudy.compare.refinement import fitted_order
from contactstudy.contact.complementarity import contact_forces
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.halfspace.love import (
    GridTooSmallError,
    LoveGrid,
    contact_pressure,
    love_influence,
)
from contactstudy.verification.cases.patch_filter import influence_matrix

MODULUS = contact_modulus(210e9, 0.3)


@pytest.mark.parametrize(("x", "y"), [(3.0, 0.5), (-1.2, 4.0), (1.0, 0.75), (0.2, -3.0)])
def test_influence_is_the_integral_of_boussinesqs_point_load(x, y):
    a, b = 1.0, 0.75
    # u = 1/(pi E*) integral of 1/r; points on and outside the border
    integral, _ = dblquad(
        lambda q, p: 1 / np.hypot(x - p, y - q), -a, a, -b, b, epsabs=1e-9, epsrel=1e-9
    )
    value = love_influence(np.array(x), np.array(y), 2 * a, 2 * b, 2.0)
    assert value == pytest.approx(integral / (np.pi * 2.0), rel=1e-6)


def test_influence_at_the_centre_of_a_square_and_far_away():
    # Johnson (1985), after eq. (3.25): centre of a square of side 2a, u = 8 a ln(1+sqrt 2)/(pi E*)
    centre = love_influence(np.zeros(1), np.zeros(1), 2.0, 2.0, 1.0)[0]
    assert centre == pytest.approx(8 * np.log(1 + np.sqrt(2)) / np.pi, rel=1e-14)
    r = 300.0
    far = love_influence(np.array([r]), np.zeros(1), 2.0, 2.0, 1.0)[0]
    # point load, and the square's second moment: relative a^2/(6 r^2)
    assert far == pytest.approx(4.0 / (np.pi * r), rel=(1.0 / r) ** 2)


def test_both_bodies_add_up_whatever_their_materials():
    both = contact_modulus(210e9, 0.28, 70e9, 0.34)
    x, y = np.array([0.0, 1e-3]), np.array([0.0, 2e-3])
    parts = sum(
        love_influence(x, y, 1e-3, 1e-3, E / (1 - nu**2)) for E, nu in ((210e9, 0.28), (70e9, 0.34))
    )
    assert love_influence(x, y, 1e-3, 1e-3, both) == pytest.approx(parts, rel=1e-14)


def grid_and_places(shape, width=0.4e-3, breadth=0.3e-3):
    i, j = (np.arange(n) - 0.5 * (n - 1) for n in shape)
    x, y = np.meshgrid(i * width, j * breadth, indexing="ij")
    return LoveGrid(shape, width, breadth, MODULUS), x, y


def test_product_by_fft_is_that_with_the_full_matrix():
    grid, x, y = grid_and_places((13, 18))
    K = influence_matrix(x.ravel(), y.ravel(), grid.width, grid.breadth, MODULUS)
    np.testing.assert_allclose(K, K.T, rtol=1e-13)
    assert np.linalg.eigvalsh(K).min() > 0
    p = np.random.default_rng(0).standard_normal(grid.shape)
    np.testing.assert_allclose(grid.approach(p).ravel(), K @ p.ravel(), rtol=0, atol=1e-24)


def test_pressure_is_that_of_the_active_set_method_with_the_full_matrix():
    grid, x, y = grid_and_places((22, 20))
    # two bumps of different heights
    gap = (
        np.minimum(((x - 2e-3) ** 2 + y**2) / 0.2, ((x + 2.2e-3) ** 2 + 2 * y**2) / 0.3 + 5e-6)
        - 12e-6
    )
    p = contact_pressure(grid, gap, tolerance=1e-11)
    K = influence_matrix(x.ravel(), y.ravel(), grid.width, grid.breadth, MODULUS)
    forces = contact_forces(K / grid.cell_area, gap.ravel())
    expected = forces.forces / grid.cell_area
    assert np.array_equal(p.ravel() > 0, forces.active)
    np.testing.assert_allclose(p.ravel(), expected, rtol=0, atol=1e-7 * expected.max())


def test_hertz_comes_out_and_converges():
    h = hertz_contact(60e3, MODULUS, 0.43, 0.30)
    errors = []
    sizes = (24, 48, 96)
    for n in sizes:
        width, breadth = 2.3 * h.semi_axis_x / n, 2.3 * h.semi_axis_y / n
        grid, x, y = grid_and_places((n, n), width, breadth)
        p = contact_pressure(grid, x**2 / 0.86 + y**2 / 0.60 - h.approach)
        exact = h.pressure(x, y)
        force = abs(p.sum() * grid.cell_area / h.load - 1)
        # near the rim p0 sqrt(1 - r^2) cannot be followed; the mean difference is of order 3/2
        errors.append(np.abs(p - exact).mean() / h.peak_pressure)
        assert force < 3e-4
        inner = exact > 0.5 * h.peak_pressure
        assert np.abs(p - exact)[inner].max() < 6e-3 * h.peak_pressure * (24 / n)
    assert fitted_order([1 / n for n in sizes], errors) > 1.3


def test_a_second_start_ends_on_the_same_pressure():
    grid, x, y = grid_and_places((24, 24))
    gap = (x**2 + y**2) / 0.5 - 9e-6
    first = contact_pressure(grid, gap)
    again = contact_pressure(grid, gap, start=np.full(grid.shape, 1e9))
    np.testing.assert_allclose(again, first, rtol=0, atol=1e-5 * first.max())
    assert not contact_pressure(grid, gap + 1e-3).any()


def test_what_cannot_be_solved_is_refused():
    grid, x, y = grid_and_places((12, 12))
    with pytest.raises(GridTooSmallError, match="border"):
        contact_pressure(grid, (x**2 + y**2) / 0.5 - 1e-3)
    with pytest.raises(NumericalError, match="after 2 iterations"):
        contact_pressure(grid, (x**2 + y**2) / 0.5 - 4e-6, max_iterations=2)
    with pytest.raises(InputError, match="cells"):
        contact_pressure(grid, np.zeros((3, 3)))
    with pytest.raises(InputError) as found:
        LoveGrid((4, 4), 0.0, -1.0, np.nan)
    assert len(found.value.problems) == 3

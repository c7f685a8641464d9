import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import make_interp_spline

from contactstudy.exceptions import InputError
from contactstudy.geometry.interpolation import SplineLine, grid_rows, linear_rows
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.quadrature import point_line
from contactstudy.profiles.named import rail_curve, wheel_curve

LINES = np.array([0.0, 1.0, 2.5, 3.0, 4.5, 6.0])


@given(st.lists(st.floats(0.0, 6.0), min_size=1, max_size=20))
def test_interpolation_reproduces_polynomials(points: list[float]) -> None:
    s = np.array(points)
    rows = linear_rows(LINES, s)
    np.testing.assert_allclose((rows.weight * LINES[rows.index]).sum(axis=1), s, atol=1e-12)
    np.testing.assert_allclose(rows.weight.sum(axis=1), 1.0)
    spline = SplineLine(LINES)(s)
    for power in range(4):
        np.testing.assert_allclose(spline @ LINES**power, s**power, atol=1e-11 * 6.0**power)


def test_spline_is_an_independent_one() -> None:
    rng = np.random.default_rng(0)
    f, s = rng.standard_normal(len(LINES)), rng.uniform(0, 6, 30)
    expected = make_interp_spline(LINES, f, k=3)(s)
    np.testing.assert_allclose(SplineLine(LINES)(s) @ f, expected, atol=1e-12)


def test_mirrored_spline_is_that_of_the_whole_line() -> None:
    rng = np.random.default_rng(1)
    f, s = rng.standard_normal(len(LINES)), rng.uniform(0, 6, 30)
    whole = np.concatenate([-LINES[:0:-1], LINES])
    expected = make_interp_spline(whole, np.concatenate([f[:0:-1], f]), k=3)(s)
    np.testing.assert_allclose(SplineLine(LINES, mirrored=True)(s) @ f, expected, atol=1e-12)


def test_product_rows() -> None:
    x, y = np.array([0.3, 1.7]), np.array([0.1, 2.0, 5.5])
    rows = grid_rows(linear_rows(LINES, x), linear_rows(LINES, y), len(LINES))
    f = np.multiply.outer(LINES, 2 * LINES + 1).ravel()
    expected = np.multiply.outer(x, 2 * y + 1).ravel()
    np.testing.assert_allclose((rows.weight * f[rows.index]).sum(axis=1), expected)
    np.testing.assert_allclose(rows.matrix(f.size) @ f, expected)


def test_interpolation_refuses_what_it_cannot_do() -> None:
    with pytest.raises(InputError, match="outside the"):
        linear_rows(LINES, np.array([6.1]))
    with pytest.raises(InputError, match="outside the"):
        SplineLine(LINES)(np.array([-0.1]))
    with pytest.raises(InputError, match="too few"):
        SplineLine(LINES[:3])


def half_points(**changes: object):  # type: ignore[no-untyped-def]
    radius, lateral = changes.pop("radius", 0.43), changes.pop("lateral", 0.0)
    bodies = Geometry(rail_curve("60E1"), wheel_curve("cylinder"), radius, Pose(0.0, lateral))
    arguments: dict = {
        "wheel_x": np.arange(-6, 7) * 2e-3,
        "wheel_s": np.arange(0, 5) * 2e-3,
        "symmetric": True,
    }
    return contact_points(bodies, **(arguments | changes))


def on_wheel(points, quadrature="gauss"):  # type: ignore[no-untyped-def]
    """y of every point on the wheel; that of its foot on the rail is up to 3 um smaller."""
    return np.tile(point_line(points.wheel_y, quadrature).at, len(points.x))


def test_gap_is_that_of_the_smooth_profiles() -> None:
    points = half_points()
    x, y = points.x_of_points, on_wheel(points)
    # from the centre of the crown's circle to the wheel's point
    up = 0.30 + (0.43 - np.sqrt(0.43**2 - x**2))
    np.testing.assert_allclose(points.normal_z, up / np.hypot(y, up), rtol=1e-12)
    np.testing.assert_allclose(points.gap, np.hypot(y, up) - 0.30, atol=1e-15)
    # feet of the lines: below the lowest point of the wheel's circle
    angle = np.arctan(y[: len(points.y)] / 0.30)
    np.testing.assert_allclose(points.arc, 0.30 * angle, atol=1e-15)
    np.testing.assert_allclose(points.y, 0.30 * np.sin(angle), atol=1e-15)


def test_areas_fill_the_surface_and_count_both_halves() -> None:
    half, x = half_points(), 24e-3
    whole = half_points(wheel_s=np.arange(-4, 5) * 2e-3, symmetric=False)
    # dy of the wheel, projected along the rail's normal: integral of R/sqrt(R^2 + y^2)
    width = 2 * 0.30 * np.arcsinh(8e-3 / 0.30)
    assert half.area.sum() == pytest.approx(x * width, rel=1e-6)
    assert whole.area.sum() == pytest.approx(half.area.sum(), rel=1e-12)


def test_nodal_pressure_keeps_a_uniform_pressure() -> None:
    points = half_points()
    np.testing.assert_allclose(points.nodal_pressure(7.0 * points.area), 7.0)


def test_wheel_rows_interpolate_bilinearly() -> None:
    points = half_points()
    X, Y = np.meshgrid(points.wheel_x, points.wheel_y, indexing="ij")
    field = (1 + 2 * X + 3 * Y + 4 * X * Y).ravel()
    x, y = points.x_of_points, on_wheel(points)
    value = (points.wheel_rows.weight * field[points.wheel_rows.index]).sum(axis=1)
    np.testing.assert_allclose(value, 1 + 2 * x + 3 * y + 4 * x * y)


def test_drop_of_a_cone() -> None:
    cone = PlacedWheel(wheel_curve("cone"), 0.43, Pose())
    x, y = np.array([0.0, 0.0, 0.1, 0.1]), np.array([0.0, 0.02, 0.0, 0.02])
    points, _ = cone.points_and_normals(x, y * np.hypot(1.0, 0.05))
    np.testing.assert_allclose(points[:, 1], y, atol=1e-17)
    np.testing.assert_allclose(points[:2, 2], [0.0, 1e-3], atol=1e-17)
    np.testing.assert_allclose(points[2:, 2], 0.43 - np.sqrt(np.array([0.43, 0.429]) ** 2 - 0.01))


def test_bad_geometry_is_refused() -> None:
    with pytest.raises(InputError, match="radius"):
        half_points(radius=-1.0)
    with pytest.raises(InputError, match="lateral shift"):
        half_points(lateral=1e-3)
    with pytest.raises(InputError, match="beyond the profile"):
        half_points(wheel_s=np.array([0.0, 0.07]))


def test_nodes_as_contact_points() -> None:
    gauss, nodes = half_points(), half_points(quadrature="nodes")
    np.testing.assert_array_equal(nodes.x, nodes.wheel_x)
    np.testing.assert_allclose(nodes.y, 0.30 * np.sin(np.arctan(nodes.wheel_y / 0.30)), atol=1e-15)
    # unit rows
    n = len(nodes.gap)
    np.testing.assert_array_equal(nodes.wheel_rows.matrix(n), np.eye(n))
    # trapezoidal areas: second order, and the running surface is nearly flat
    assert nodes.area.sum() == pytest.approx(gauss.area.sum(), rel=1e-4)
    corner = nodes.area[0]
    assert corner == pytest.approx(2 * 1e-3 * 1e-3)
    assert nodes.area[len(nodes.y)] / corner == pytest.approx(2, rel=1e-12)
    np.testing.assert_allclose(nodes.nodal_pressure(7.0 * nodes.area), 7.0)


@pytest.mark.parametrize("quadrature", ["gauss", "nodes"])
def test_points_know_their_facets(quadrature: str) -> None:
    points = half_points(quadrature=quadrature)
    my = len(points.wheel_y)
    for facet in range((len(points.wheel_x) - 1) * (my - 1)):
        i, j = divmod(facet, my - 1)
        x, y = points.x_of_points, on_wheel(points, quadrature)
        inside = (
            (x >= points.wheel_x[i] - 1e-12)
            & (x <= points.wheel_x[i + 1] + 1e-12)
            & (y >= points.wheel_y[j] - 1e-12)
            & (y <= points.wheel_y[j + 1] + 1e-12)
        )
        np.testing.assert_array_equal(points.listed(np.array([facet])), inside)


@pytest.mark.parametrize("symmetric", [True, False])
def test_semi_axes_are_those_of_hertz_pressure(symmetric):
    a, b = 6.1e-3, 4.8e-3
    y = np.linspace(0.0 if symmetric else -8e-3, 8e-3, 41)
    points = half_points(wheel_x=np.linspace(-8e-3, 8e-3, 81), wheel_s=y, symmetric=symmetric)
    p = np.maximum(1 - (points.x_of_points / a) ** 2 - (points.y_of_points / b) ** 2, 0.0)
    axes = points.semi_axes(np.sqrt(p) * points.area)
    assert axes["semi_axis_along"] == pytest.approx(a, rel=2e-3)
    assert axes["semi_axis_across"] == pytest.approx(b, rel=2e-3)
    assert points.semi_axes(0.0 * p)["semi_axis_along"] == 0.0

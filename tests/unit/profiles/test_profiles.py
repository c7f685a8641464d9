import itertools

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles import (
    polygon_properties,
    rail_profile,
    section_properties,
    wheel_curve,
    wheel_profile,
)
from contactstudy.profiles.rail import NAMES
from contactstudy.resources import resource


def test_shipped_profile_is_found_and_unknown_resource_is_refused():
    assert resource("meshes", "profiles", "60E1.toml").is_file()
    with pytest.raises(InputError, match="allowed: meshes, report, studies"):
        resource("nonsense")
    with pytest.raises(InputError, match="no such file"):
        resource("meshes", "profiles", "99E9.toml")


def test_unknown_profile_names_list_what_is_allowed():
    with pytest.raises(InputError, match="60E1"):
        rail_profile("60E9")
    with pytest.raises(InputError, match="cylinder, cone"):
        wheel_profile("square")


@pytest.mark.parametrize("name", NAMES)
def test_outline_is_tangent_continuous_from_crown_to_foot(name):
    pieces = rail_profile(name).pieces
    assert pieces[0].start == (0.0, 0.0)
    for a, b in itertools.pairwise(pieces):
        assert a.end == b.start
        p, q = a.points(1e-12)[-2:], b.points(1e-12)[:2]
        ta, tb = np.diff(p, axis=0)[0], np.diff(q, axis=0)[0]
        turn = (ta[0] * tb[1] - ta[1] * tb[0]) / np.linalg.norm(ta) / np.linalg.norm(tb)
        assert abs(turn) < 1e-4, (a.part, b.part)  # chords of 1 pm sagitta, not yet tangents


def test_running_surface_lies_on_the_arcs():
    rail = rail_profile()
    y = np.linspace(-0.0102, 0.0102, 101)
    np.testing.assert_allclose(rail.curve.height(y), np.sqrt(0.09 - y**2) - 0.3, atol=1e-16)
    # level at the crown to full relative precision: y^2/2R at 1 um
    assert rail.curve.height(1e-6) == pytest.approx(-1e-12 / 0.6, rel=1e-9)
    # printed joints (mm): R80 about (7.5005, 80.128), R13 about (23.016, 14.949), face at 36.000
    y80, y13 = 0.02, 0.03
    assert rail.curve.height(y80) == pytest.approx(
        -0.080128 + np.sqrt(0.08**2 - (y80 - 0.0075005) ** 2), abs=2e-7
    )
    assert rail.curve.height(y13) == pytest.approx(
        -0.014949 + np.sqrt(0.013**2 - (y13 - 0.023016) ** 2), abs=2e-7
    )
    assert rail.curve.height(0.036) == pytest.approx(-0.0143, abs=5e-6)
    with pytest.raises(InputError, match="beyond its ends"):
        rail.curve.height(0.04)


def test_running_slope_and_curvature_are_derivatives_of_the_surface():
    rail = rail_profile().curve
    y = np.array([-0.034, -0.02, -0.004, 0.003, 0.018, 0.031])
    h = 1e-7

    def slope_at(y):
        ny, nz = rail.normal(rail.arc_of_y(y)).T
        return -ny / nz

    slope = (rail.height(y + h) - rail.height(y - h)) / (2 * h)
    second = (slope_at(y + h) - slope_at(y - h)) / (2 * h)
    np.testing.assert_allclose(slope_at(y), slope, rtol=1e-6)
    # of z(y): z'' = -k (1 + z'^2)^(3/2), k positive for a convex body
    bend = -rail.curvature(rail.arc_of_y(y)) * (1 + slope**2) ** 1.5
    np.testing.assert_allclose(bend, second, rtol=1e-5)
    assert rail.curvature(0.0) == pytest.approx(1 / rail_profile().crown_radius)


def test_half_width_follows_the_outline():
    rail = rail_profile()
    points = rail.half_outline()
    keep = points[:, 1] > -rail.height + 1e-5
    # at the crown y varies as the root of z, so an ulp of z is 1e-9 m of y
    np.testing.assert_allclose(rail.half_width(points[keep, 1]), points[keep, 0], atol=1e-8)
    z = rail.heights
    assert rail.half_width([0.5 * (z["web_top"] + z["web_bottom"])]) == pytest.approx(0.00825)
    assert rail.half_width(-0.167) == pytest.approx(0.075)
    assert (rail.foot_width, rail.web_thickness) == pytest.approx((0.150, 0.0165))
    assert z["head_bottom_axis"] == pytest.approx(-0.051)
    assert rail.height + z["foot_top_axis"] == pytest.approx(0.0315)
    assert list(z.values()) == sorted(z.values(), reverse=True)
    with pytest.raises(InputError, match="between"):
        rail.half_width(0.001)


@pytest.mark.parametrize("name", NAMES)
def test_drawn_rails_have_the_printed_integrals(name):
    rail = rail_profile(name)
    area, centre, vertical, lateral = polygon_properties(rail.outline)
    printed = dict(rail.reference)
    assert 1e4 * area == pytest.approx(printed["area"], rel=1e-4)
    assert 7850 * area == pytest.approx(printed["mass"], rel=2e-4)
    assert 1e8 * vertical == pytest.approx(printed["second_moment_y"], rel=5e-4)
    assert 1e8 * lateral == pytest.approx(printed["second_moment_z"], rel=5e-4)
    assert centre[0] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("name", "height", "foot", "head", "web", "head_depth", "foot_depth"),
    [
        ("60E1", 172.0, 150.0, 72.0, 16.5, 51.0, 31.5),
        ("54E1", 159.0, 140.0, 70.0, 16.0, 49.4, 30.2),
        ("49E1", 149.0, 125.0, 67.0, 14.0, 51.5, 27.5),
    ],
)
def test_drawn_rails_have_the_main_dimensions_of_catalogues(
    name, height, foot, head, web, head_depth, foot_depth
):
    rail, z = rail_profile(name), rail_profile(name).heights
    assert 1e3 * rail.height == pytest.approx(height)
    assert 1e3 * rail.foot_width == pytest.approx(foot)
    assert 1e3 * rail.web_thickness == pytest.approx(web)
    assert -1e3 * z["head_bottom_axis"] == pytest.approx(head_depth)
    assert 1e3 * (rail.height + z["foot_top_axis"]) == pytest.approx(foot_depth)
    # the nominal width of a head is measured 14 mm below its top
    assert 2e3 * rail.half_width(-0.014) == pytest.approx(head, abs=0.15)
    assert list(z.values()) == sorted(z.values(), reverse=True)


def test_polygon_integrals_of_a_shifted_rectangle():
    corners = np.array([[1.0, 2.0], [4.0, 2.0], [4.0, 4.0], [1.0, 4.0]])
    area, centre, second_y, second_z = polygon_properties(corners)
    assert area == pytest.approx(6.0)
    assert centre == pytest.approx((2.5, 3.0))
    assert (second_y, second_z) == pytest.approx((3 * 2**3 / 12, 2 * 3**3 / 12))


def test_section_mesh_faults_are_named():
    x = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    with pytest.raises(InputError, match="element 0 is degenerate"):
        section_properties(x, [[0, 3, 2, 1]], 0.3)
    with pytest.raises(InputError, match="y >= 0"):
        section_properties(x - 0.5, [[0, 1, 2, 3]], 0.3, symmetric=True)
    skew = np.array([[0.0, 0.0], [1.0, 0.5], [1.0, 1.5], [0.0, 1.0]])
    with pytest.raises(InputError, match="principal"):
        section_properties(skew, [[0, 1, 2, 3]], 0.3)


@pytest.mark.parametrize(("name", "conicity"), [("cylinder", 0.0), ("cone", 0.05)])
def test_straight_treads(name, conicity):
    wheel = wheel_curve(name)
    y = np.linspace(-0.03, 0.03, 7)
    np.testing.assert_allclose(wheel.height(y), conicity * y, atol=1e-17)
    ny, nz = wheel.normal(wheel.arc_of_y(y)).T
    np.testing.assert_allclose(-ny / nz, conicity, rtol=1e-14)
    np.testing.assert_array_equal(wheel.curvature(wheel.arc_of_y(y)), 0.0)


def test_arc_length_of_the_running_surface_is_that_of_fine_chords() -> None:
    rail = rail_profile().curve
    y = np.linspace(0.0, 0.036, 20_001)
    chords = np.hypot(np.diff(y), np.diff(rail.height(y)))
    arc = rail.arc_of_y(y)
    assert np.allclose(arc[1:], np.cumsum(chords), rtol=0, atol=1e-9)
    assert np.allclose(rail.arc_of_y(-y), -arc, rtol=0, atol=1e-15)
    with pytest.raises(InputError, match="beyond its ends"):
        rail.arc_of_y(0.040)

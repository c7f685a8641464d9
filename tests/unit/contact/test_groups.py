"""Patches of one wheel told apart."""

import numpy as np
import pytest

from contactstudy.contact.groups import contact_area, patch_numbers, patch_record
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.profiles.named import rail_curve, wheel_curve


def grid(quadrature):
    """Two millimetres for two Gauss points an interval, one for nodes: as many points."""
    step = 2e-3 if quadrature == "gauss" else 1e-3
    half_x, half_y = round(12e-3 / step), round(16e-3 / step)
    return contact_points(
        Geometry(rail_curve(), wheel_curve("cylinder"), 0.46),
        np.arange(-half_x, half_x + 1) * step,
        np.arange(-half_y, half_y + 1) * step,
        quadrature=quadrature,
    )


def dome(points, x, y, a, b):
    """Hertz's pressure about (x, y), zero outside of the semi-axes."""
    u = ((points.x_of_points - x) / a) ** 2 + ((points.y_of_points - y) / b) ** 2
    return np.sqrt(np.maximum(1 - u, 0.0))


@pytest.mark.parametrize("quadrature", ["gauss", "nodes"])
def test_two_domes_are_two_patches(quadrature):
    points = grid(quadrature)
    wide, small = dome(points, 0, -7e-3, 6e-3, 5e-3), 0.3 * dome(points, 1e-3, 9e-3, 4e-3, 3e-3)
    beside = np.where(wide + small > 0, 0.0, 1e-5)
    number = patch_numbers(points, beside, wide + small)
    np.testing.assert_array_equal(np.where(number == 1, wide + small, 0.0), wide)
    np.testing.assert_array_equal(np.where(number == 2, wide + small, 0.0), small)
    assert number.max() == 2
    record = patch_record(points, beside, wide + small)
    assert record["patch_count"] == 2
    assert record["largest_patch_share"] == pytest.approx(wide.sum() / (wide + small).sum())
    # of the wide one alone, by sums over points a millimetre apart
    assert record["semi_axis_along"] == pytest.approx(6e-3, rel=0.02)
    assert record["semi_axis_across"] == pytest.approx(5e-3, rel=0.02)


def test_single_open_points_do_not_divide_a_patch():
    """As a stiff penalty leaves them: every second point of a line across open."""
    points = grid("gauss")
    forces = dome(points, 0, 0, 8e-3, 10e-3).reshape(len(points.x), -1)
    forces[:, 1::2] = 0.0
    gap = np.where(dome(points, 0, 0, 8e-3, 10e-3) > 0, 1e-8, 1e-5)
    np.testing.assert_array_equal(patch_numbers(points, gap, forces.ravel()), forces.ravel() > 0)
    # nor do whole facets that are open by next to nothing
    forces[:, 14:18] = 0.0
    np.testing.assert_array_equal(patch_numbers(points, gap, forces.ravel()), forces.ravel() > 0)


def test_nothing_in_touch_is_no_patch():
    points = grid("gauss")
    assert not patch_numbers(points, points.gap, np.zeros(len(points.gap))).any()
    assert set(patch_record(points, points.gap, np.zeros(len(points.gap))).values()) == {0.0}


@pytest.mark.parametrize("small", [0.5e-3, 1.2e-3, 3e-3])
@pytest.mark.parametrize(("apart", "error"), [(11e-3, 0.07), (12.5e-3, 0.02), (14e-3, 0.02)])
def test_area_of_two_unequal_patches(small, apart, error):
    """Spheres pressed a facet or more from each other: pi (a1^2 + a2^2), gaps of Johnson (1985),
    sec. 4.2: ``g = a^2/(pi R) ((r^2/a^2 - 2) acos(a/r) + sqrt(r^2/a^2 - 1))`` outside of r = a.

    The smallest patch has the radius of a quarter of a facet. Near a large patch a small one has
    no room for its lines, so it may be missed: 5 % of the area.
    """
    points, large = grid("gauss"), 5e-3
    gaps = []
    for a, y, R in ((large, -6e-3, 0.5), (small, -6e-3 + apart, 0.5 * small / large)):
        r = np.maximum(np.hypot(points.x_of_points - 2e-4, points.y_of_points - y) / a, 1.0)
        lift = (r**2 - 2) * np.arccos(1 / r) + np.sqrt(r**2 - 1)
        gaps.append(a**2 / (np.pi * R) * lift)
    gap = np.minimum(*gaps)
    found = contact_area(points, gap, (gap == 0.0).astype(float))
    exact = np.pi * (large**2 + small**2)
    print(f"{found / exact - 1:+.2%}")
    assert found == pytest.approx(exact, rel=error)

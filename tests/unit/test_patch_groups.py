"""Patches of one wheel told apart."""

import numpy as np
import pytest

from contactstudy.contact.patch_groups import patch_forces, patch_record
from contactstudy.contact.points import contact_points
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.wheel import wheel_profile


def grid(quadrature):
    """Two millimetres for two Gauss points an interval, one for nodes: as many points."""
    step = 2e-3 if quadrature == "gauss" else 1e-3
    half_x, half_y = round(12e-3 / step), round(16e-3 / step)
    return contact_points(
        np.arange(-half_x, half_x + 1) * step,
        np.arange(-half_y, half_y + 1) * step,
        0.46,
        rail_profile(),
        wheel_profile("cylinder"),
        symmetric=False,
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
    found = patch_forces(points, wide + small)
    assert len(found) == 2
    np.testing.assert_array_equal(found[0], wide)
    np.testing.assert_array_equal(found[1], small)
    record = patch_record(points, wide + small)
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
    (found,) = patch_forces(points, forces.ravel())
    assert found.sum() == forces.sum()


def test_nothing_in_touch_is_no_patch():
    points = grid("gauss")
    assert patch_forces(points, np.zeros(len(points.gap))) == []
    assert set(patch_record(points, np.zeros(len(points.gap))).values()) == {0.0}

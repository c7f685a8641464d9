"""The meshed 60E1 section against the standard's figures and the exact outline."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.section import polygon_properties
from contactstudy.solids.cell import section_of
from contactstudy.solids.mapped import Grading, graded
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.section_mesh import rail_section_mesh


def grading(size, coarse=0.009, growth=1.5):
    return Grading(size, coarse, growth)


@pytest.mark.parametrize("size", [0.001, 0.002, 0.004])
def test_section_of_the_standard(size):
    """EN 13674-1, 60E1: A 76.70 cm2, I_y 3038.3 cm4, I_z 512.3 cm4, centroid 80.92 mm."""
    p = rail_section_mesh(rail_profile(), grading(size)).properties(0.3)
    print(f"{size * 1e3:.0f} mm: A {p.area * 1e4:.2f} cm2, I_y {p.second_moment_y * 1e8:.1f} cm4")
    assert p.area == pytest.approx(76.70e-4, rel=0.01)
    assert p.second_moment_y == pytest.approx(3038.3e-8, rel=0.01)
    assert p.second_moment_z == pytest.approx(512.3e-8, rel=0.02)
    assert p.area * 7850 == pytest.approx(60.21, rel=0.01)
    assert 0.172 + p.centroid_z == pytest.approx(0.08092, rel=0.01)


def test_area_approaches_the_outline():
    exact, *_ = polygon_properties(rail_profile().outline)
    errors = [
        abs(rail_section_mesh(rail_profile(), grading(h, 3 * h)).properties(0.3).area / exact - 1)
        for h in (0.004, 0.002, 0.001)
    ]
    assert errors[2] < 0.3 * errors[0]


def test_whole_section_is_two_halves():
    half = rail_section_mesh(rail_profile(), grading(0.004))
    whole = rail_section_mesh(rail_profile(), grading(0.004), symmetric=False)
    a, b = half.properties(0.3), whole.properties(0.3)
    assert a.area == pytest.approx(b.area, rel=1e-12)
    assert a.second_moment_y == pytest.approx(b.second_moment_y, rel=1e-12)
    assert a.shear_coefficient_z == pytest.approx(b.shear_coefficient_z, rel=1e-6)
    np.testing.assert_allclose(
        whole.nodes[whole.surface, 0], -whole.nodes[whole.surface[::-1], 0], atol=1e-15
    )
    assert len(whole.surface) == 2 * len(half.surface) - 1


@pytest.mark.parametrize("symmetric", [True, False])
def test_surface_lies_on_the_crown_at_the_spacing(symmetric):
    mesh = rail_section_mesh(rail_profile(), grading(0.002), symmetric=symmetric)
    y, z = mesh.nodes[mesh.surface].T
    np.testing.assert_allclose(np.diff(rail_profile().curve.arc_of_y(y)), 0.002, rtol=1e-6)
    np.testing.assert_allclose(z, rail_profile().curve.height(y), atol=1e-15)
    assert np.allclose(mesh.nodes[mesh.foot, 1], -0.172)


def test_no_element_is_inverted():
    for size in (0.001, 0.002, 0.003, 0.005, 0.008):
        mesh = rail_section_mesh(rail_profile(), grading(size), symmetric=False)
        p = mesh.nodes[mesh.quads]
        a, b = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
        assert np.min(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]) > 0


@pytest.mark.parametrize("size", [0.001, 0.002, 0.004, 0.006])
@pytest.mark.parametrize("centre", [-0.020, -0.030, 0.035])
def test_fine_zone_round_the_gauge_corner(size, centre):
    """On the drawing to rounding, at equal steps, with sound elements, and the same section."""
    profile, half_width = rail_profile(), 0.014
    mesh = rail_section_mesh(profile, grading(size), centre, half_width, symmetric=False)
    y, z = mesh.nodes[mesh.surface].T
    np.testing.assert_allclose(z, profile.curve.height(y), atol=1e-15)
    arc = profile.curve.arc_of_y(y)
    np.testing.assert_allclose(arc[[0, -1]], [centre - half_width, centre + half_width], atol=2e-6)
    np.testing.assert_allclose(
        np.diff(arc), 2 * half_width / round(2 * half_width / size), rtol=2e-3
    )
    # positive at the Gauss points; one element's corner on the straight underside is a flat angle
    p, g = mesh.nodes[mesh.quads], np.sqrt(1 / 3)
    for xi, eta in ((-g, -g), (g, -g), (g, g), (-g, g)):
        dN = np.array([[eta - 1, 1 - eta, 1 + eta, -1 - eta], [xi - 1, -1 - xi, 1 + xi, 1 - xi]])
        assert np.linalg.det(0.25 * dN @ p).min() > 0
    bent = mesh.properties(0.3)
    plain = rail_section_mesh(profile, grading(size), symmetric=False).properties(0.3)
    assert bent.area == pytest.approx(plain.area, rel=0.004)
    assert bent.second_moment_y == pytest.approx(plain.second_moment_y, rel=0.004)
    assert bent.second_moment_z == pytest.approx(plain.second_moment_z, rel=0.004)


def test_slice_mass_and_rigid_motion():
    _, piece, rows = section_of(CellRecipe(size=0.004))
    up = rows.rigid[:, 1]
    M = piece.mass
    total = up @ (M.aa + M.ab + M.ab.T + M.bb) @ up / piece.thickness
    assert total == pytest.approx(60.21, rel=0.01)
    for motion in rows.rigid.T[:2]:
        force = (piece.stiffness.aa + piece.stiffness.ab) @ motion
        assert np.abs(force).max() < 1e-6 * np.abs(piece.stiffness.aa).max()
    assert rows.foot[0] @ up == pytest.approx(1.0)
    assert rows.centre[0] @ up == pytest.approx(1.0)


def test_graded_steps():
    x = graded(0.05, 0.002, 1.5, 0.008)
    steps = np.diff(x)
    assert x[-1] == pytest.approx(0.05)
    assert steps[0] <= 0.002
    assert steps.max() <= 0.008
    assert np.all(steps[1:] / steps[:-1] < 1.5 + 1e-9)


def test_bad_sizes_are_all_named():
    with pytest.raises(InputError, match=r"mesh size.*\n.*contact_half_width.*\n.*growth"):
        rail_section_mesh(rail_profile(), grading(-1.0, growth=0.5), 0.0, 0.03)
    with pytest.raises(InputError, match=r"size = 0.*\n.*interface_modes.*\n.*density"):
        CellRecipe(size=0.0, interface_modes=2, density=-1.0)

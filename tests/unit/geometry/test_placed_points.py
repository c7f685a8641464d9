"""Wheel in any position on an inclined rail: first touch and gap, against independent ways."""

import math

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from contactstudy.exceptions import InputError
from contactstudy.geometry.facing import surface_gap
from contactstudy.geometry.interpolation import grid_rows
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.quadrature import Quadrature, grid_facets, point_line
from contactstudy.geometry.smooth_touch import smooth_touch
from contactstudy.geometry.touch import first_touch
from contactstudy.profiles.named import rail_curve, wheel_curve

RAIL = rail_curve()
INCLINED = math.atan(1 / 40)
RADIUS = 0.46
# (profile, pose): tread near the centre, tread with yaw, flange root, steep rail
CASES = {
    "cone": ("cone", Pose(INCLINED, 0.0, 0.0, 0.01)),
    "tread": ("S1002", Pose(INCLINED, -2e-3, 1e-3, 12e-3)),
    "flange": ("S1002", Pose(INCLINED, 8e-3, -2e-3, -20e-3)),
    "1:20": ("S1002", Pose(math.atan(1 / 20), -4e-3)),
}


def placed(case):
    name, pose = CASES[case]
    return PlacedWheel(wheel_curve(name), RADIUS, pose)


def test_centred_cylinder_against_what_lies_below_its_points() -> None:
    lines = np.linspace(-8e-3, 8e-3, 17)
    new = contact_points(Geometry(RAIL, wheel_curve("cylinder"), RADIUS), lines, lines)
    line = point_line(lines, "gauss")
    x, y = np.repeat(line.at, len(line.at)), np.tile(line.at, len(line.at))
    vertical = RADIUS - np.sqrt(RADIUS**2 - x**2) + 0.300 - np.sqrt(0.300**2 - y**2)
    slope, normal_z = np.abs(y) / np.sqrt(0.300**2 - y**2), np.sqrt(1 - (y / 0.300) ** 2)
    # "distance down times n_z" is the distance from the tangent plane below the point; the
    # closest point lies v sin(g) aside, where the surface has fallen by k (v sin(g))^2/2 more
    bound = 0.5 * (1 / 0.300) * (vertical * slope) ** 2
    assert np.all(np.abs(new.gap - vertical * normal_z) <= 1.01 * bound + 1e-16)
    assert new.normal_z == pytest.approx(normal_z, abs=5e-6)
    # areas of surfaces that are not parallel differ by the square of the angle between them
    area = np.multiply.outer(line.weight, line.weight).ravel() / normal_z
    assert new.area == pytest.approx(area, rel=2 * slope.max() ** 2)
    # feet of the closest point and below the point lie v sin(g) apart
    aside = (vertical * slope).reshape(len(new.x), -1).min(axis=0).max() + 1e-12
    assert new.arc == pytest.approx(0.300 * np.arcsin(line.at / 0.300), abs=aside)
    assert new.y == pytest.approx(line.at, abs=aside)
    assert np.array_equal(new.facet, grid_facets(line, line, 17))
    np.testing.assert_allclose(
        new.wheel_rows.matrix(17 * 17),
        grid_rows(line.rows, line.rows, 17).matrix(17 * 17),
        atol=1e-15,
    )


@pytest.mark.parametrize("quadrature", ["gauss", "nodes"])
def test_half_of_the_points_is_that_of_the_whole(quadrature: Quadrature) -> None:
    x, s = 2e-3 * np.arange(-6, 7), 2e-3 * np.arange(5)
    bodies = Geometry(RAIL, wheel_curve("cylinder"), RADIUS)
    half = contact_points(bodies, x, s, quadrature, symmetric=True)
    whole = contact_points(bodies, x, np.r_[-s[:0:-1], s], quadrature)
    right = np.flatnonzero(whole.y > -1e-12)
    np.testing.assert_allclose(whole.arc[right], half.arc, atol=1e-15)
    for name in ("gap", "normal_z"):
        ours, both = (getattr(p, name).reshape(len(half.x), -1) for p in (half, whole))
        np.testing.assert_allclose(both[:, right], ours, atol=1e-15)
    # both halves; a line in the middle belongs to both
    assert half.area.sum() == pytest.approx(whole.area.sum(), rel=1e-12)


@pytest.mark.parametrize("angle", [INCLINED, -0.1])
def test_turning_both_bodies_together_changes_nothing(angle: float) -> None:
    wheel, lateral = wheel_curve("S1002"), 1e-3
    first = smooth_touch(PlacedWheel(wheel, RADIUS, Pose(0.0, lateral)), RAIL)
    # the same place on the rail, in axes turned by the angle
    c, s = math.cos(angle), math.sin(angle)
    pose = Pose(angle, lateral * c + first.travel * s, angle)
    turned = smooth_touch(PlacedWheel(wheel, RADIUS, pose), RAIL)
    touch = first.travel * c - lateral * s
    same = PlacedWheel(wheel, RADIUS, pose)
    x, grid = np.meshgrid(np.linspace(-5e-3, 5e-3, 11), np.linspace(-30e-3, 10e-3, 41))
    a = surface_gap(
        PlacedWheel(wheel, RADIUS, Pose(0.0, lateral)), RAIL, first.travel, x.ravel(), grid.ravel()
    )
    b = surface_gap(same, RAIL, turned.travel, x.ravel(), grid.ravel())
    assert turned.travel == pytest.approx(touch, abs=1e-9)
    assert b.gap == pytest.approx(a.gap, abs=1e-9)
    assert turned.wheel_s == pytest.approx(first.wheel_s, abs=1e-5)
    assert turned.angle == pytest.approx(first.angle + angle, abs=1e-5)


def test_opposite_yaw_is_the_mirror_image_along_the_rail() -> None:
    wheel, x = wheel_curve("S1002"), np.linspace(-12e-3, 12e-3, 13)
    s = np.linspace(-20e-3, 5e-3, 12)
    one, other = (
        contact_points(Geometry(RAIL, wheel, RADIUS, Pose(INCLINED, 1e-3, 2e-3, yaw)), x, s)
        for yaw in (0.02, -0.02)
    )
    shape = len(one.x), len(one.y)
    assert other.gap.reshape(shape)[::-1] == pytest.approx(one.gap.reshape(shape), abs=1e-14)
    assert other.area.reshape(shape)[::-1] == pytest.approx(one.area.reshape(shape), rel=1e-9)


@pytest.mark.parametrize("case", CASES)
def test_nothing_overlaps_at_first_touch_and_something_touches(case: str) -> None:
    wheel = placed(case)
    touch = smooth_touch(wheel, RAIL)
    # the whole surface, not only the locus that the search follows
    x, s = np.meshgrid(np.linspace(-50e-3, 50e-3, 201), np.linspace(-50e-3, 40e-3, 181))
    gap = surface_gap(wheel, RAIL, touch.travel, x.ravel(), s.ravel()).gap
    assert gap.min() >= -1e-15
    near = (
        touch.wheel_x + 1e-4 * np.linspace(-1, 1, 21),
        touch.wheel_s + 1e-4 * np.linspace(-1, 1, 21),
    )
    x, s = np.meshgrid(*near)
    facing = surface_gap(wheel, RAIL, touch.travel, x.ravel(), s.ravel())
    gap = facing.gap
    assert abs(gap[220]) < 2e-15
    assert gap.min() >= -2e-15
    assert 1.0 - facing.alignment[220] < 1e-12


@pytest.mark.parametrize("case", CASES)
def test_gap_is_the_distance_of_finely_sampled_surfaces(case: str) -> None:
    wheel = placed(case)
    touch = smooth_touch(wheel, RAIL)
    step = 0.05e-3
    x, s = np.meshgrid(
        touch.wheel_x + np.linspace(-6e-3, 6e-3, 9), touch.wheel_s + np.linspace(-4e-3, 4e-3, 9)
    )
    gap = surface_gap(wheel, RAIL, touch.travel, x.ravel(), s.ravel()).gap
    points, _ = wheel.points_and_normals(x.ravel(), s.ravel())
    points[:, 1:] -= touch.travel * wheel.pose.vertical
    arc = touch.arc + np.arange(-8e-3, 8e-3, step)
    along = np.arange(points[:, 0].min() - 1e-3, points[:, 0].max() + 1e-3, step)
    profile = RAIL.point(arc)
    rail = np.concatenate(
        [np.repeat(along, len(arc))[:, None], np.tile(profile, (len(along), 1))], axis=1
    )
    brute, _ = cKDTree(rail).query(points)
    # the nearest sample lies within half a diagonal of the foot
    assert np.all(brute >= gap - 1e-12)
    assert np.all(np.sqrt(np.maximum(brute**2 - 0.5 * step**2, 0.0)) <= gap + 1e-7)


def triangulated(points: np.ndarray) -> trimesh.Trimesh:
    n, m = points.shape[:2]
    node = np.arange(n * m).reshape(n, m)
    a, b, c, d = node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], 2).reshape(-1, 3)
    return trimesh.Trimesh(points.reshape(-1, 3), faces, process=False)


@pytest.mark.parametrize("case", ["tread", "flange"])
def test_first_touch_of_triangulated_bodies_converges_to_the_smooth_one(case: str) -> None:
    wheel = placed(case)
    touch = smooth_touch(wheel, RAIL)
    errors = []
    for step in (0.5e-3, 0.25e-3):
        # odd shares of the step, so that no node sits on the touch
        along = touch.wheel_x + step * (np.arange(-8, 9) + 0.37)
        arc = touch.wheel_s + step * (np.arange(-10, 11) + 0.29)
        x, s = np.meshgrid(along, arc, indexing="ij")
        body = wheel.points_and_normals(x.ravel(), s.ravel())[0].reshape(*x.shape, 3)
        profile = RAIL.point(touch.arc + step * (np.arange(-20, 21) + 0.41))
        rail = np.empty((2, len(profile), 3))
        rail[0, :, 0], rail[1, :, 0] = touch.x - 20 * step, touch.x + 20 * step
        rail[:, :, 1:] = profile
        # to track axes, where "down" is Z
        pose = wheel.pose
        for surface in (body, rail):
            surface[..., 1:] = pose.track_of_rail(surface[..., 1:])
        found = first_touch(triangulated(rail), triangulated(body))
        errors.append(abs(found.travel - touch.travel))
    # chords lie off the arcs by k h^2/8; a vertical travel feels it divided by n_z
    bend = max(
        abs(wheel.curve.curvature(touch.wheel_s)), 1 / 13e-3 if case == "flange" else 1 / 0.08
    )
    bound = (2 * bend + 1 / RADIUS) * 0.5e-3**2 / 8 / math.cos(touch.angle)
    assert errors[0] < bound
    assert errors[1] < bound / 4


def test_impossible_poses_and_grids_are_refused() -> None:
    with pytest.raises(InputError) as found:
        Pose(1.0, 1.0, math.nan)
    assert len(found.value.problems) == 3
    wheel = wheel_curve("S1002")
    with pytest.raises(InputError, match="reaches beyond the profile"):
        contact_points(Geometry(RAIL, wheel, RADIUS), np.arange(3.0), np.array([0.0, 0.1]))
    with pytest.raises(InputError, match="end of a profile"):
        smooth_touch(PlacedWheel(wheel_curve("cone"), RADIUS, Pose(0.0, -0.09)), RAIL)
    with pytest.raises(InputError, match="a wheel's is needed"):
        PlacedWheel(RAIL, RADIUS, Pose())

"""Triangulated profiles, and candidates of a wheel in any position on an inclined rail."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.geometry.boxes import largest_sagitta
from contactstudy.geometry.facets import (
    in_track_axes,
    rail_surface,
    tread_candidates,
    wheel_surface,
)
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.smooth_touch import smooth_touch
from contactstudy.geometry.touch import first_touch
from contactstudy.profiles.named import rail_curve, wheel_curve

RAIL, WHEELS = rail_curve("60E1"), {n: wheel_curve(n) for n in ("S1002", "cone", "cylinder")}
RADIUS = 0.46


@given(
    wheel=st.sampled_from(sorted(WHEELS)),
    size=st.sampled_from([1e-3, 2e-3]),
    inclination=st.sampled_from([0.0, math.atan(1 / 40), math.atan(1 / 20)]),
    lateral=st.floats(-8e-3, 6e-3),
    yaw=st.floats(-0.024, 0.024),
    roll=st.floats(-5e-3, 5e-3),
    approach=st.floats(1e-7, 2e-4),
)
@settings(max_examples=12)
def test_candidates_of_a_placed_wheel(wheel, size, inclination, lateral, yaw, roll, approach):
    pose = Pose(inclination, lateral, roll, yaw)
    curve = WHEELS[wheel]
    touch = smooth_touch(PlacedWheel(curve, RADIUS, pose), RAIL)
    x = np.arange(-8, 9) * 2e-3
    low, high = max(touch.wheel_s - 0.02, curve.s_range[0]), touch.wheel_s + 0.02
    s = np.linspace(low, high, round((high - low) / size) + 1)
    bodies = Geometry(RAIL, curve, RADIUS, pose)
    points, candidates = contact_points(bodies, x, s), tread_candidates(bodies, x, s)
    for a in (approach, 0.3 * approach):
        overlapping = np.unique(points.facet[points.gap < a * points.normal_z])
        assert np.all(np.isin(overlapping, candidates.quads(a)))
    # above a box's lower edge by more than its height, 2 mm and a facet of 0.5 mm with paddings,
    # there is nothing; 1 mm suffices only where the contact is not steep
    assert len(candidates.quads(-3e-3)) == 0


@pytest.mark.parametrize(("lateral", "yaw"), [(0.0, 0.0), (4e-3, 5e-3), (-5e-3, -0.012)])
def test_facets_touch_where_the_smooth_surfaces_do(lateral, yaw):
    """The facets' travel goes to the smooth surfaces' with the square of their size."""
    pose = Pose(math.atan(1 / 40), lateral, 0.0, yaw)
    wheel = WHEELS["S1002"]
    exact = smooth_touch(PlacedWheel(wheel, RADIUS, pose), RAIL)
    errors = []
    for h in (2e-3, 1e-3, 0.5e-3):
        x = exact.wheel_x + np.arange(-round(0.012 / h), round(0.012 / h) + 1) * h
        s = np.arange(exact.wheel_s - 0.012, exact.wheel_s + 0.012, h)
        t = np.arange(exact.arc - 0.015, exact.arc + 0.015, h)
        upper = in_track_axes(wheel_surface(wheel, RADIUS, x[:, None], s[None]), pose, True)
        lower = in_track_axes(rail_surface(RAIL, 1.5 * x[:, None], t[None]), pose, False)
        errors.append(first_touch(lower, upper).travel - exact.travel)
        # facets lie off their bodies by the sagittas, along the normal
        curves = (largest_sagitta(wheel, s), largest_sagitta(RAIL, t), h**2 / 8 / RADIUS)
        assert abs(errors[-1]) * math.cos(exact.angle) <= sum(curves)
    assert abs(errors[-1]) < 0.2 * max(np.abs(errors[:2]))


def test_normals_point_out_of_the_bodies():
    x, s = np.linspace(-0.02, 0.02, 5)[:, None], np.linspace(-0.02, 0.02, 9)[None]
    assert np.all(rail_surface(RAIL, x, s).face_normals[:, 2] > 0)
    tread = wheel_surface(WHEELS["S1002"], RADIUS, x, s)
    assert np.all(tread.face_normals[:, 2] < 0)
    axle = np.array([0.0, 0.0, RADIUS])
    rho = np.linalg.norm((tread.vertices - axle)[:, [0, 2]], axis=1)
    local = RADIUS - WHEELS["S1002"].point(s.ravel())[:, 1]
    np.testing.assert_allclose(rho.reshape(5, 9), np.tile(local, (5, 1)), atol=1e-15)

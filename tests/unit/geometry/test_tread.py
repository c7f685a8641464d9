"""A meshed wheel's tread: what speaks against pressing it, and the lines of its points."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import contact_points
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.tread import mesh_problems, tread_lines, wheel_points
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, rigid_wheel

WHEEL = rigid_wheel(WheelRecipe(size=0.008, contact_half_width=0.016))
POINTS = wheel_points(WHEEL)


def track(last: float) -> Any:
    """Rail whose running surface is finely meshed from the crown to an arc length in m."""
    return SimpleNamespace(recipe=CellRecipe(), surface_arc=np.linspace(0.0, last, 5))


def test_grid_beyond_the_finely_meshed_running_surface_is_named() -> None:
    (problem,) = mesh_problems(track(0.010), WHEEL, POINTS)
    assert problem.startswith("wheel contact_half_width = 0.016 m: its contact points lie from ")
    assert f" to {POINTS.arc.max():.4g} m of the rail's arc length" in problem
    assert problem.endswith("beyond the finely meshed running surface, 0 to 0.01 m")


def test_grid_within_the_finely_meshed_running_surface_is_accepted() -> None:
    assert mesh_problems(track(0.016), WHEEL, POINTS) == []


@pytest.mark.parametrize("quadrature", ["gauss", "nodes"])
def test_tread_lines_are_heights_over_the_tangent_at_the_touch(quadrature: Any):
    """S1002 on 60E1 at 1:40, against the profile as a function z(y)."""
    pose = Pose(rail_inclination=float(np.arctan(1 / 40)))
    geometry = Geometry(rail_curve("60E1"), wheel_curve("S1002"), 0.43, pose)
    touch = geometry.touch.wheel_s
    across = touch + np.linspace(-0.012, 0.012, 13)
    points = contact_points(geometry, np.linspace(-0.01, 0.01, 11), across, quadrature)
    lines = tread_lines(points, geometry)
    assert len(lines.y) == len(points.y)
    y0, h = float(geometry.wheel.point(touch)[0]), 1e-6
    z0, low, high = (float(geometry.wheel.height(y)) for y in (y0, y0 - h, y0 + h))
    slope = (high - low) / (2 * h)
    above = geometry.wheel.height(lines.y) - z0 - slope * (lines.y - y0)
    np.testing.assert_allclose(lines.rise, above / np.hypot(1.0, slope), atol=1e-10)
    assert np.ptp(lines.rise) > 100e-6

"""What speaks against pressing a meshed wheel on a meshed rail."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from contactstudy.geometry.tread import mesh_problems, wheel_points
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

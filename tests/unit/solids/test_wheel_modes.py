"""Elastic modes of the wheel: dynamic flexibility by brute force, residual, masses."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from contactstudy.exceptions import InputError
from contactstudy.profiles import rail_curve
from contactstudy.solids.wheel import WheelFlexibility, WheelRecipe, elastic_wheel
from contactstudy.solids.wheel_modes import (
    ModesRecipe,
    WheelModes,
    residual_flexibility,
    wheel_modes,
)
from contactstudy.verification.cases.wheel_frequencies import whole_ring

HALF = WheelRecipe(size=0.008, contact_half_length=0.016, contact_half_width=0.016)
WHOLE = replace(HALF, profile="S1002", symmetric=False)


@cache
def wheel(recipe: WheelRecipe) -> WheelFlexibility:
    return elastic_wheel(recipe)


@cache
def modes(recipe: WheelRecipe, highest: float = 5000.0) -> WheelModes:
    return wheel_modes(ModesRecipe(recipe, highest))


@pytest.mark.slow
def test_dynamic_flexibility_is_that_of_the_whole_ring() -> None:
    recipe = HALF
    section, found = recipe.section(), modes(recipe, 12000.0)
    K, M, free = whole_ring(recipe)
    K, M = 2 * K, 2 * M  # both halves
    omega = 2 * np.pi * 900.0
    # unit loads at all tread nodes along the rail's normal, and the hub moving up by 1 m
    n, k, ny = len(section.nodes), len(recipe.x) // 2, len(recipe.y)
    rail = rail_curve("60E1")
    normal = rail.normal(rail.arc_of_y(recipe.y))
    B = np.zeros((K.shape[0], len(recipe.x) * ny))
    for i in range(-k, k + 1):
        for j, node in enumerate(section.tread):
            at = 3 * ((i % (K.shape[0] // (3 * n))) * n + node)
            B[at + 1 : at + 3, (i + k) * ny + j] = normal[j]
    up = np.tile([0.0, 0.0, 1.0], K.shape[0] // 3)
    moved = np.column_stack([B, omega**2 * (M @ up)])
    u = np.zeros_like(moved)
    u[free] = splu((K - omega**2 * M)[free][:, free].tocsc()).solve(moved[free])
    F = B.T @ u
    rest = residual_flexibility(wheel(recipe), found).flexibility
    gain = 1 / (found.stiffness - omega**2)
    direct = rest + found.shapes.T @ (gain[:, None] * found.shapes)
    carried = omega**2 * found.shapes.T @ (gain * found.participation)
    largest = F[:, :-1].max()
    print("largest difference, relative", np.abs(direct - F[:, :-1]).max() / largest)
    print("of the hub's motion", np.abs(carried / F[:, -1] - 1).max())
    np.testing.assert_allclose(direct, F[:, :-1], atol=2e-4 * largest)
    # the modes left out follow the hub statically
    np.testing.assert_allclose(carried, F[:, -1], rtol=0.02)


@pytest.mark.parametrize("recipe", [HALF, WHOLE])
def test_the_residual_is_positive_and_completes_the_modes(recipe: WheelRecipe) -> None:
    full, found = wheel(recipe), modes(recipe)
    rest = residual_flexibility(full, found)
    assert np.linalg.eigvalsh(rest.flexibility).min() > 0
    shared = found.shapes.T @ (found.shapes / found.stiffness[:, None])
    np.testing.assert_allclose(rest.flexibility + shared, full.flexibility, rtol=1e-12)
    # the section under the middle of the tread moves as the tread itself
    k = recipe.section().tread[0 if recipe.symmetric else len(recipe.y) // 2]
    n = len(recipe.x) // 2 * len(recipe.y) + (0 if recipe.symmetric else len(recipe.y) // 2)
    upward = found.section_shapes[:, k, 1] if recipe.symmetric else None
    if upward is not None:
        np.testing.assert_allclose(upward, found.shapes[:, n], atol=1e-12)


def test_symmetries_come_in_pairs() -> None:
    found = modes(WHOLE)
    nx, ny = len(WHOLE.x), len(WHOLE.y)
    shapes = found.shapes.reshape(-1, nx, ny)
    even = np.abs(shapes - shapes[:, ::-1]).max(axis=(1, 2)) < 1e-9 * np.abs(shapes).max()
    odd = np.abs(shapes + shapes[:, ::-1]).max(axis=(1, 2)) < 1e-9 * np.abs(shapes).max()
    assert np.all(even | odd)
    for waves in range(1, 4):
        at = np.flatnonzero(found.waves == waves)
        pairs = found.frequencies[at].reshape(-1, 2)
        np.testing.assert_allclose(pairs[:, 0], pairs[:, 1], rtol=0.01)
    # only one wave round the wheel moves its centre of mass
    assert np.abs(found.participation[(found.waves != 1) | odd]).max() < 0.5
    assert 0.7 * found.mass < (found.participation**2).sum() < found.mass


def test_frequencies_below_the_limit_do_not_depend_on_it() -> None:
    low, high = modes(HALF, 3000.0), modes(HALF)
    assert len(low.frequencies) < len(high.frequencies)
    np.testing.assert_allclose(low.frequencies, high.frequencies[: len(low.frequencies)], rtol=2e-3)


def test_modes_of_another_wheel_are_refused() -> None:
    with pytest.raises(InputError, match="another wheel"):
        residual_flexibility(wheel(HALF), modes(WHOLE))
    with pytest.raises(InputError, match="highest frequency"):
        ModesRecipe(HALF, -1.0)

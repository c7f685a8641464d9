"""Elastic wheel against an independent sparse solution of the whole ring."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from contactstudy.exceptions import InputError
from contactstudy.profiles import rail_curve, wheel_curve
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.hexahedron import hex_stiffness
from contactstudy.solids.mapped import Grading
from contactstudy.solids.ring import ring_slice
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel, rigid_wheel
from contactstudy.solids.wheel_section import wheel_section

COARSE = WheelRecipe(size=0.008, contact_half_length=0.016, contact_half_width=0.016)


def section_of(recipe: WheelRecipe):  # type: ignore[no-untyped-def]
    tread, sizes = wheel_curve("cylinder"), Grading(recipe.size, 0.012, 1.6)
    return wheel_section(recipe.dimensions, tread, 0.0, recipe.contact_half_width, sizes, True)


def whole_ring(recipe: WheelRecipe) -> tuple[np.ndarray, np.ndarray]:
    """Flexibility of the tread and response of the section, whole ring in Cartesian axes."""
    section = section_of(recipe)
    half = recipe.angles
    theta = np.concatenate([half, 2 * np.pi - half[-2:0:-1]])
    y, rho = section.nodes.T
    n, m = len(y), len(theta)
    # z up from the axis, theta from the bottom
    nodes = np.stack(
        [
            rho * np.sin(theta[:, None]),
            np.broadcast_to(y, (m, n)),
            -rho * np.cos(theta[:, None]),
        ],
        axis=2,
    )
    first = np.arange(m)[:, None, None] * n
    after = np.roll(first, -1, axis=0)
    elements = np.concatenate([section.quads + first, section.quads + after], axis=2)
    elements = elements.reshape(-1, 8)
    corners = nodes.reshape(-1, 3)[elements]
    volume = np.linalg.det(corners[0, [1, 3, 4]] - corners[0, 0])
    if volume < 0:
        elements = elements[:, [4, 5, 6, 7, 0, 1, 2, 3]]
    K = 2 * hex_stiffness(nodes.reshape(-1, 3)[elements], 210e9, 0.3)
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    A = sp.coo_array(
        (
            K.ravel(),
            (np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()),
        ),
        shape=(3 * n * m, 3 * n * m),
    ).tocsc()
    held = np.zeros((m, n, 3), dtype=bool)
    held[:, section.bore] = True
    held[:, section.plane_of_symmetry, 1] = True
    free = np.flatnonzero(~held.ravel())
    k, ny = len(recipe.x) // 2, len(section.tread)
    rail = rail_curve("60E1")
    normal = rail.normal(rail.arc_of_y(y[section.tread]))
    B = np.zeros((3 * n * m, len(recipe.x) * ny))
    for i in range(-k, k + 1):
        for j, node in enumerate(section.tread):
            at = 3 * ((i % m) * n + node)
            B[at + 1 : at + 3, (i + k) * ny + j] = normal[j]
    u = np.zeros_like(B)
    u[free] = splu(A[free][:, free]).solve(B[free])
    return B.T @ u, u[: 3 * n].reshape(n, 3, -1)[:, 1:]


def test_flexibility_and_section_equal_the_whole_ring() -> None:
    wheel = elastic_wheel(COARSE)
    F, section = whole_ring(COARSE)
    print("largest difference", np.abs(wheel.flexibility - F).max() / F.max())
    np.testing.assert_allclose(wheel.flexibility, F, atol=1e-8 * F.max())
    np.testing.assert_allclose(wheel.section_response, section, atol=1e-8 * F.max())


def test_flexibility_is_symmetric_and_positive_definite() -> None:
    F = elastic_wheel(COARSE).flexibility
    np.testing.assert_array_equal(F, F.T)
    assert np.linalg.eigvalsh(F).min() > 0
    nx, ny = len(COARSE.x), len(COARSE.y)
    mirrored = F.reshape(nx, ny, nx, ny)[::-1, :, ::-1]
    np.testing.assert_allclose(mirrored.reshape(F.shape), F, atol=1e-12 * F.max())


def test_ring_slice_has_the_rigid_motions() -> None:
    section = section_of(COARSE)
    angle = 0.1
    n = len(section.nodes)
    piece = ring_slice(section, angle, 210e9, 0.3, np.ones(3 * n, dtype=bool))
    K = sp.block_array([[piece.aa, piece.ab], [piece.ab.T, piece.bb]]).toarray()
    rho = section.nodes[:, 1]

    def both(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.concatenate([a.ravel(), b.ravel()])

    up = [np.tile([-np.cos(t), 0.0, np.sin(t)], (n, 1)) for t in (0.0, angle)]
    along = [np.tile([np.sin(t), 0.0, np.cos(t)], (n, 1)) for t in (0.0, angle)]
    turn = [np.stack([0 * rho, 0 * rho, rho], axis=1) for _ in range(2)]
    across = [np.tile([0.0, 1.0, 0.0], (n, 1)) for _ in range(2)]
    for a, b in (up, along, turn, across):
        assert np.abs(K @ both(a, b)).max() < 1e-9 * np.abs(K).max() * np.abs(a).max()


def test_tread_grid() -> None:
    recipe = WheelRecipe()
    assert recipe.angles[-1] == pytest.approx(np.pi)
    np.testing.assert_allclose(recipe.x, -recipe.x[::-1])
    assert recipe.x[-1] == pytest.approx(0.012, rel=1e-3)
    section = section_of(recipe)
    np.testing.assert_allclose(section.nodes[section.tread, 0], recipe.y, atol=1e-12)
    np.testing.assert_allclose(section.nodes[section.tread, 1], 0.43, atol=1e-12)
    np.testing.assert_allclose(section.nodes[section.bore, 1], 0.095, atol=1e-12)


def test_section_area() -> None:
    section = section_of(WheelRecipe())
    y, r = section.nodes[section.quads].transpose(2, 0, 1)
    area = 0.5 * (y * np.roll(r, -1, 1) - np.roll(y, -1, 1) * r).sum(axis=1)
    assert area.min() > 0
    exact = 0.0675 * 0.060 + 0.0125 * (0.37 - 0.13) + 0.09 * 0.035
    assert area.sum() == pytest.approx(exact, rel=1e-9)


def test_rigid_wheel_gives_nothing() -> None:
    wheel = rigid_wheel(COARSE)
    assert not wheel.flexibility.any()
    assert len(wheel.flexibility) == len(wheel.x) * len(wheel.y)


def test_bad_wheels_are_refused() -> None:
    with pytest.raises(InputError, match="bore_radius"):
        WheelDimensions(hub_radius=0.5)
    with pytest.raises(InputError, match="must be positive"):
        WheelDimensions(web_thickness=(-0.01, 0.02))
    with pytest.raises(InputError, match="size"):
        WheelRecipe(size=0.0)
    with pytest.raises(InputError, match="even tread"):
        elastic_wheel(replace(COARSE, profile="cone"))

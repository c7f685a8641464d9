"""Integrals of the 60E1 section against the standard, shear coefficients against Cowper."""

import itertools
import math

import numpy as np
import pytest

from contactstudy.profiles import polygon_properties, rail_profile, section_properties


def _grid(y: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Structured quads over node arrays y, z of shape (n+1, m+1)."""
    i = np.arange(y.size).reshape(y.shape)
    quads = np.stack([i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]], axis=-1).reshape(-1, 4)
    return np.stack([y.ravel(), z.ravel()], axis=1), quads


def _rectangle(width: float, height: float, n: int, half: bool = False):
    y0 = 0.0 if half else -width / 2
    y, z = np.meshgrid(
        np.linspace(y0, width / 2, (n if not half else n // 2) + 1),
        np.linspace(-height / 2, height / 2, n + 1),
        indexing="ij",
    )
    return _grid(y, z)


def _disc(n: int):
    y, z = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    square, radius = np.maximum(abs(y), abs(z)), np.hypot(y, z)
    scale = np.divide(square, radius, out=np.ones_like(radius), where=radius > 0)
    return _grid(y * scale, z * scale)


def _half_rail(n: int, size: float):
    """Strips of n quads from the axis to the outline (the topmost 10 um of the crown are cut)."""
    rail = rail_profile()
    corners = rail.half_outline(chord_error=size**2)[:, 1]
    corners = np.unique(np.round(np.append(corners[corners < -1e-5], -1e-5), 9))
    parts = [
        np.linspace(a, b, math.ceil((b - a) / size) + 1)[:-1]
        for a, b in itertools.pairwise(corners)
    ]
    z = np.append(np.concatenate(parts), corners[-1])
    y = rail.half_width(z) * np.linspace(0, 1, n + 1)[:, None]
    return _grid(y, np.broadcast_to(z, y.shape))


def test_60e1_outline_against_the_standard():
    rail = rail_profile()
    area, (y, z), second_y, second_z = polygon_properties(rail.outline)
    computed = {
        "mass": area * 7850.0,
        "area": area * 1e4,
        "second_moment_y": second_y * 1e8,
        "second_moment_z": second_z * 1e8,
        "centroid_above_foot": (z + rail.height) * 1e3,
    }
    for key, reference in rail.reference:
        print(f"60E1 {key}: EN 13674-1 {reference}, computed {computed[key]:.4f}")
        assert computed[key] == pytest.approx(reference, rel=2e-4)
    assert abs(y) < 1e-12


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_shear_coefficients_of_rectangle_and_circle(nu):
    rectangle = 10 * (1 + nu) / (12 + 11 * nu)
    circle = 6 * (1 + nu) / (7 + 6 * nu)
    errors = []
    for n in (8, 16):
        box = section_properties(*_rectangle(2.0, 1.0, n), nu)
        disc = section_properties(*_disc(n), nu)
        print(
            f"nu {nu}, {n} x {n}: rectangle {box.shear_coefficient_z:.5f}, "
            f"{box.shear_coefficient_y:.5f} (Cowper {rectangle:.5f}); "
            f"circle {disc.shear_coefficient_z:.5f} (Cowper {circle:.5f})"
        )
        errors.append(
            [
                box.shear_coefficient_z - rectangle,
                box.shear_coefficient_y - rectangle,
                disc.shear_coefficient_z - circle,
            ]
        )
        assert disc.shear_coefficient_y == pytest.approx(disc.shear_coefficient_z, rel=1e-9)
    assert np.abs(errors[-1]).max() < 0.004
    # bilinear elements: the error falls with h^2
    np.testing.assert_allclose(np.array(errors[0]) / errors[1], 4.0, rtol=0.1)


def test_half_mesh_gives_the_whole_section():
    whole = section_properties(*_rectangle(2.0, 1.0, 8), 0.3)
    half = section_properties(*_rectangle(2.0, 1.0, 8, half=True), 0.3, symmetric=True)
    for key, value in vars(whole).items():
        assert vars(half)[key] == pytest.approx(value, rel=1e-9, abs=1e-12), key


def test_60e1_meshed_half_section():
    coarse = section_properties(*_half_rail(6, 0.002), 0.3, symmetric=True)
    fine = section_properties(*_half_rail(12, 0.001), 0.3, symmetric=True)
    print(
        f"60E1 kappa vertical {coarse.shear_coefficient_z:.4f}, {fine.shear_coefficient_z:.4f}"
        f"; lateral {coarse.shear_coefficient_y:.4f}, {fine.shear_coefficient_y:.4f}"
    )
    assert fine.area == pytest.approx(76.70e-4, rel=3e-3)
    assert fine.second_moment_y == pytest.approx(3038.3e-8, rel=3e-3)
    assert fine.second_moment_z == pytest.approx(512.3e-8, rel=3e-3)
    # usual value for vertical shear of this section (e.g. Thompson, Railway Noise, 2009): 0.4
    assert fine.shear_coefficient_z == pytest.approx(0.4, abs=0.01)
    assert coarse.shear_coefficient_z == pytest.approx(fine.shear_coefficient_z, rel=0.01)

"""Area of a patch from the gap around it: closed forms, a plain twin, patches of elements."""

import numpy as np
import pytest

from contactstudy.contact.area import area_below, patch_area
from contactstudy.exceptions import NumericalError
from contactstudy.geometry.quadrature import point_line
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.verification.cases.hertz_ellipses import relative_radii
from contactstudy.verification.cases.pressed_blocks import blocks

MODULUS, RADIUS = contact_modulus(), 0.3
LOADS = np.geomspace(20e3, 200e3, 13)


def sphere_gap(distance: np.ndarray, load: float) -> np.ndarray:
    """Gap of a sphere pressed on a half-space (Johnson 1985, eq. (3.42a) outside of the patch)."""
    a = hertz_contact(load, MODULUS, RADIUS, RADIUS).semi_axis_x
    r, p0 = np.maximum(distance, a), 1.5 * load / np.pi / a**2
    # at r = a all terms cancel
    lift = (2 * a**2 - r**2) * np.arcsin(a / r) + r * np.sqrt(np.maximum(r**2 - a**2, 0)) * a / r
    return r**2 / (2 * RADIUS) - a**2 / RADIUS + p0 / (2 * MODULUS * a) * lift


def gauss(half: float, step: float = 2e-3) -> np.ndarray:
    n = round(half / step)
    return point_line(step * np.arange(-n, n + 1), "gauss").at


def test_area_below_is_that_of_many_samples():
    rng = np.random.default_rng(4)
    t, dx, dy = rng.uniform(size=(5, 4)), np.array([1.0, 2.0, 0.5, 1.0]), np.array([0.7, 1.0, 2.0])
    u = (np.arange(400) + 0.5) / 200 - 1.0
    U, V = np.meshgrid(u, u, indexing="ij")
    for level in (0.1, 0.4, 0.5, 0.8):
        expected = 0.0
        for i in range(4):
            for j in range(3):
                a, b, c, d = t[i, j], t[i + 1, j], t[i + 1, j + 1], t[i, j + 1]
                # from the centre's mean towards the side that the ray through the sample meets
                far = np.maximum(np.abs(U), np.abs(V))
                p, q = U / far, V / far
                side = (a * (1 - p) * (1 - q) + b * (1 + p) * (1 - q)) / 4
                side += (c * (1 + p) * (1 + q) + d * (1 - p) * (1 + q)) / 4
                value = (1 - far) * (a + b + c + d) / 4 + far * side
                expected += np.mean(value < level) * dx[i] * dy[j]
        assert area_below(t, dx, dy, level) == pytest.approx(expected, rel=2e-3, abs=2e-3)


def test_sphere_over_a_decade_of_loads():
    x = gauss(16e-3)
    distance = np.hypot(x[:, None], x[None, :])
    half = distance[:, x > 0]
    errors = []
    for load in LOADS:
        gap, exact = sphere_gap(distance, load), hertz_contact(load, MODULUS, RADIUS, RADIUS).area
        errors.append(patch_area(x, x, gap, False) / exact - 1)
        mirrored = patch_area(x, x[x > 0], sphere_gap(half, load), True)
        assert mirrored / exact - 1 == pytest.approx(errors[-1], abs=1e-9)
    print("sphere at 2 mm, closed form of the gap: errors", np.round(errors, 4))
    assert np.abs(errors).max() < 0.02


def test_open_points_in_the_patch_and_its_penetration_do_not_matter():
    x, load = gauss(16e-3), 80e3
    distance = np.hypot(x[:, None], x[None, :])
    gap = sphere_gap(distance, load)
    expected = patch_area(x, x, gap, False)
    rng = np.random.default_rng(0)
    a = hertz_contact(load, MODULUS, RADIUS, RADIUS).semi_axis_x
    scattered = np.where(distance < 0.8 * a, rng.uniform(-0.1e-6, 1e-6, gap.shape), gap)
    assert patch_area(x, x, scattered, False) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("loads", [(80e3, 80e3), (150e3, 20e3)])
def test_patches_add_up(loads):
    x, y = gauss(16e-3), gauss(32e-3)
    gaps = [
        sphere_gap(np.hypot(x[:, None], y[None, :] - at), load)
        for at, load in zip((-15e-3, 15e-3), loads, strict=True)
    ]
    exact = sum(hertz_contact(load, MODULUS, RADIUS, RADIUS).area for load in loads)
    found = patch_area(x, y, np.minimum(*gaps), False)
    print(f"two patches: {1e6 * found:.1f} mm^2, each by itself {1e6 * exact:.1f} mm^2")
    assert found == pytest.approx(exact, rel=0.02)


def test_area_is_as_continuous_as_the_gap():
    x = gauss(16e-3)
    distance = np.hypot(x[:, None], x[None, :])
    loads = np.linspace(60e3, 62e3, 41)
    found = np.array([patch_area(x, x, sphere_gap(distance, load), False) for load in loads])
    # Gauss points stand for 1 mm^2: their sum would go in steps of four
    assert np.all(np.diff(found) > 0) and np.diff(found).max() < 0.2e-6


def test_patch_at_the_edge_of_its_points_is_an_error():
    x = gauss(8e-3)
    gap = sphere_gap(np.hypot(x[:, None], x[None, :] - 7e-3), 80e3)
    with pytest.raises(NumericalError, match="edge"):
        patch_area(x, x, gap, False)


@pytest.mark.parametrize(
    ("ratio", "elements", "quadrature", "mean", "largest"),
    [
        (1.0, 4, "gauss", 0.02, 0.08),
        (2.0, 4, "gauss", 0.02, 0.08),
        (1.0, 8, "gauss", 0.015, 0.03),
        (1.0, 8, "nodes", 0.03, 0.05),
    ],
)
def test_hertz_of_elements(ratio, elements, quadrature, mean, largest):
    """Elements over the semi-axes at 240 kN; at 20 kN 1.7 of 4 and 3.5 of 8."""
    radii = relative_radii(ratio)
    top = hertz_contact(1.2 * LOADS[-1], MODULUS, *radii)
    bodies = blocks((top.semi_axis_x, top.semi_axis_y), elements, radii, quadrature=quadrature)
    errors, summed = [], []
    for load in LOADS:
        found, exact = bodies.press(load, 1e16), hertz_contact(load, MODULUS, *radii).area
        errors.append(found.area / exact - 1)
        summed.append(found.points.area[found.active].sum() / exact - 1)
    for name, of in (("from the gap", errors), ("sum of points", summed)):
        print(f"a/b = {ratio:g}, {elements} elements, {quadrature}, {name}:", np.round(of, 3))
    assert abs(np.mean(errors)) < mean and np.abs(errors).max() < largest
    assert abs(np.mean(summed)) > 2.5 * abs(np.mean(errors))

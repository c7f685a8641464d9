"""Whole wheel section: mesh anywhere on the tread, flexibility by brute force and by mirroring."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import wheel_curve
from contactstudy.profiles.pieces import LinePiece
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids import wheel as wheel_module
from contactstudy.solids.mapped import Grading
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solids.wheel_section import WheelSection, wheel_section
from contactstudy.verification.cases.wheel_frequencies import whole_ring

SIZES = Grading(0.002, 0.012, 1.6)
COARSE = WheelRecipe(
    profile="S1002",
    symmetric=False,
    size=0.008,
    contact_half_length=0.016,
    contact_half_width=0.016,
    far_step=np.pi / 6,
)


def corner_angles(section: WheelSection) -> np.ndarray:
    """Sine of the interior angle at every corner of every quadrilateral."""
    q = section.nodes[section.quads]
    after, before = np.roll(q, -1, axis=1) - q, np.roll(q, 1, axis=1) - q
    cross = after[..., 0] * before[..., 1] - after[..., 1] * before[..., 0]
    return cross / np.linalg.norm(after, axis=2) / np.linalg.norm(before, axis=2)


@pytest.mark.parametrize("centre", [-0.044, -0.038, -0.032, -0.02, 0.0, 0.01, 0.03, 0.045])
def test_the_fine_zone_lies_anywhere_on_the_profile(centre: float) -> None:
    curve = wheel_curve("S1002")
    section = wheel_section(WheelDimensions(), curve, centre, 0.008, SIZES)
    assert len(section.nodes) < 600
    assert corner_angles(section).min() > 0.15
    tread = np.c_[section.nodes[section.tread, 0], 0.43 - section.nodes[section.tread, 1]]
    s, distance = curve.project(tread)
    np.testing.assert_allclose(s, centre + 0.002 * np.arange(-4, 5), atol=1e-9)
    assert np.abs(distance).max() < 1e-9


def test_area_of_the_section() -> None:
    d, curve = WheelDimensions(), wheel_curve("S1002")
    section = wheel_section(d, curve, 0.0, 0.010, Grading(0.002, 0.004, 1.6))
    y, r = section.nodes[section.quads].transpose(2, 0, 1)
    area = 0.5 * (y * np.roll(r, -1, 1) - np.roll(y, -1, 1) * r).sum()
    # web and hub, and the rim below the profile, continued straight to the face
    s = np.linspace(*curve.s_range, 20001)
    py, pz = curve.point(s).T
    end = 0.065 - py[-1]
    slope = np.diff(pz[-2:])[0] / np.diff(py[-2:])[0]
    rim = np.trapezoid(0.060 - pz, py) + end * (0.060 - pz[-1] - 0.5 * end * slope)
    exact = rim + 0.025 * (0.37 - 0.13) + 0.18 * 0.035
    print(f"area {area:.6e}, exact {exact:.6e} m^2")
    # the flange's curves are cut by chords of 4 mm
    assert area == pytest.approx(exact, rel=2e-3)


def test_impossible_zones_and_profiles() -> None:
    with pytest.raises(InputError, match="contact zone from s ="):
        wheel_section(WheelDimensions(), wheel_curve("S1002"), 0.06, 0.008, SIZES)
    with pytest.raises(InputError, match="contact_centre"):
        WheelRecipe(contact_centre=0.01)


@pytest.mark.slow
def test_flexibility_equals_the_whole_ring() -> None:
    wheel = elastic_wheel(COARSE)
    section = COARSE.section()
    K, _, free = whole_ring(COARSE)
    n, planes = len(section.nodes), K.shape[0] // (3 * len(section.nodes))
    k, ny = len(COARSE.x) // 2, len(section.tread)
    normal = -wheel_curve("S1002").normal(COARSE.y)
    B = np.zeros((K.shape[0], len(COARSE.x) * ny))
    for i in range(-k, k + 1):
        for j, node in enumerate(section.tread):
            at = 3 * ((i % planes) * n + node)
            B[at + 1 : at + 3, (i + k) * ny + j] = normal[j]
    u = np.zeros_like(B)
    u[free] = splu(K[free][:, free]).solve(B[free])
    F = B.T @ u
    np.testing.assert_allclose(wheel.flexibility, F, atol=1e-8 * F.max())
    np.testing.assert_allclose(
        wheel.section_response, u[: 3 * n].reshape(n, 3, -1)[:, 1:], atol=1e-8 * F.max()
    )


def test_a_half_wheel_is_its_mirrored_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    half_recipe = WheelRecipe(size=0.008, contact_half_length=0.016, contact_half_width=0.016)
    half = half_recipe.section()
    n = len(half.nodes)
    mirrored = half.nodes * [-1.0, 1.0]
    own = np.arange(n)
    image = np.where(np.isin(own, half.plane_of_symmetry), own, own + n)
    whole = WheelSection(
        np.vstack([half.nodes, mirrored]),
        np.vstack([half.quads, image[half.quads[:, ::-1]]]),
        np.r_[image[half.tread[:0:-1]], half.tread],
        # nodes of the image that no element uses are held like the bore
        np.unique(np.r_[half.bore, image[half.bore], half.plane_of_symmetry + n]),
        symmetric=False,
    )
    level = ProfileCurve("level", (LinePiece((-0.1, 0.0), (0.1, 0.0)),), -0.1, upper=True)
    monkeypatch.setattr(wheel_module, "rail_curve", lambda _: level)
    paired = elastic_wheel(half_recipe)
    whole_recipe = replace(half_recipe, symmetric=False)
    monkeypatch.setattr(WheelRecipe, "section", lambda self: whole)
    F = elastic_wheel(whole_recipe).flexibility
    nx, ny = len(half_recipe.x), len(half_recipe.y)
    F = F.reshape(nx, 2 * ny - 1, nx, 2 * ny - 1)
    folded = 0.5 * (F[..., ny - 1 :] + F[..., ny - 1 :: -1])[:, ny - 1 :]
    np.testing.assert_allclose(
        folded.reshape(nx * ny, -1), paired.flexibility, atol=1e-9 * paired.flexibility.max()
    )

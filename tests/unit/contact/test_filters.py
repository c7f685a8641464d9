"""What a wheel feels of a profile, against closed forms and brute force."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from contactstudy.contact.filters import PatchMean, Trajectory
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.irregularity import HarmonicProfile

RADIUS = 0.43
A = hertz_contact(80e3, contact_modulus(), RADIUS, 0.30).semi_axis_x


def wave(wavelength, amplitude=1.0):
    return HarmonicProfile(np.array([amplitude]), np.array([2 * np.pi / wavelength]), np.zeros(1))


def test_wheel_in_a_notch():
    slope = 0.05
    # it touches where its circle has the slope of the sides: R (sqrt(1 + s^2) - 1) above the notch
    ahead, height = Trajectory(RADIUS).rest(lambda x: slope * np.abs(x), np.array([0.0, 0.03]))
    assert height[0] == pytest.approx(RADIUS * (np.hypot(1, slope) - 1), rel=1e-9)
    assert abs(ahead[0]) == pytest.approx(RADIUS * slope / np.hypot(1, slope), rel=1e-3)
    # on one side alone it runs parallel to it
    side = RADIUS * slope / np.hypot(1, slope)
    assert height[1] == pytest.approx(slope * 0.03 + height[0], rel=1e-9) and side < 0.03


def test_wheel_on_an_edge():
    # rail that falls away behind an edge at X = 0: the wheel's circle about the edge
    x = np.array([0.0, 0.01, 0.02])
    felt = Trajectory(RADIUS)(lambda x: np.where(x <= 0.0, 0.0, -0.01), x)
    np.testing.assert_allclose(felt, np.sqrt(RADIUS**2 - x**2) - RADIUS, atol=3e-7)


@pytest.mark.parametrize(("wavelength", "amplitude"), [(0.05, 50e-6), (0.1, 1e-3), (1.0, 1e-3)])
def test_wheel_on_a_wave(wavelength, amplitude):
    profile, x = wave(wavelength, amplitude), np.linspace(0.2, 0.2 + wavelength, 12)
    felt = Trajectory(RADIUS)(profile, x)
    for at, found in zip(x, felt, strict=True):
        tried = np.linspace(-0.1, 0.1, 400)

        def below(ahead, at=at):
            return float(RADIUS - np.sqrt(RADIUS**2 - ahead**2) - profile(at + ahead))

        start = tried[np.argmin([below(t) for t in tried])]
        best = minimize_scalar(
            below, bounds=(start - 1e-3, start + 1e-3), method="bounded", options={"xatol": 1e-9}
        )
        assert found == pytest.approx(-best.fun, abs=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_wheel_rests_the_same_whatever_else_is_asked(seed):
    """Few positions or many: brute force over all that a wheel can reach."""
    random = np.random.default_rng(seed)
    k = 2 * np.pi / random.uniform(0.03, 5.0, 6)
    profile = HarmonicProfile(10 ** random.uniform(-6, -3, 6), k, random.uniform(0, 6, 6))
    bump = random.uniform(-0.15, 0.15)

    def level(x):
        return profile(x) + 2e-3 * np.exp(-(((x - bump) / 0.02) ** 2))

    at = random.uniform(-0.1, 0.1, 1 + seed % 3)
    found = Trajectory(RADIUS)(level, at)
    ahead = np.linspace(-0.42, 0.42, 168_001)
    for x, height in zip(at, found, strict=True):
        best = np.max(level(x + ahead) - (RADIUS - np.sqrt(RADIUS**2 - ahead**2)))
        assert height == pytest.approx(best, abs=2e-9)
        assert Trajectory(RADIUS)(level, np.array([x]))[0] == pytest.approx(height, abs=1e-12)


def test_smooth_rail_is_left_alone():
    x = np.linspace(0.0, 1.0, 7)
    np.testing.assert_array_equal(Trajectory(RADIUS)(np.zeros_like, x), 0.0)
    np.testing.assert_array_equal(PatchMean.uniform(A)(np.zeros_like, x), 0.0)


@pytest.mark.parametrize("wavelength", [2.5e-3, 0.01, 2 * A, 0.02, 0.1, 1.0])
def test_mean_over_the_patch_of_waves(wavelength):
    profile, x = wave(wavelength), np.linspace(0.0, 0.3, 31)
    k = 2 * np.pi / wavelength
    exact = np.sin(k * A) / (k * A)
    np.testing.assert_allclose(PatchMean.uniform(A)(profile, x), exact * profile(x), atol=1e-12)


def test_mean_over_the_patch_as_published():
    # half-space computation, 80 kN, R 0.43 m on 0.30 m: amplitude ratios 0.973 and 0.449
    felt = [float(PatchMean.uniform(A)(wave(w), np.zeros(1))[0]) for w in (0.1, 0.02, 0.01)]
    print("100, 20, 10 mm: published 0.973, 0.449, negative; computed", felt)
    np.testing.assert_allclose(felt[:2], [0.973, 0.449], rtol=0.01)
    assert felt[2] < 0

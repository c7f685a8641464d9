"""The contact-patch filter against its closed form, presses of wavy bodies, and its limits."""

import numpy as np
import pytest

from contactstudy.contact.complementarity import PressedForces, press
from contactstudy.contact.press_table import load_weights
from contactstudy.exceptions import InputError
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.verification.cases.patch_filter import influence_matrix
from contactstudy.verification.cases.wave_filter import (
    PatchPoints,
    ellipse_filter,
    pressed_filter,
    small_amplitude_filter,
)

RADII, LOAD, CELL = (0.43, 0.30), 80e3, 1e-3
A = hertz_contact(LOAD, contact_modulus(), *RADII).semi_axis_x


def half_spaces():  # type: ignore[no-untyped-def]
    x, y = CELL * np.arange(-8, 9), CELL * np.arange(-6, 7)
    X, Y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    M = influence_matrix(X, Y, CELL, CELL, contact_modulus()) / CELL**2
    return M, X**2 / (2 * RADII[0]) + Y**2 / (2 * RADII[1]), np.ones(len(X)), X


def test_closed_form_is_the_published_one() -> None:
    found = ellipse_filter(A, np.array([0.100, 0.020]))
    print("half-spaces at 100 and 20 mm: published 0.973, 0.449; sin(ka)/(ka)", found)
    np.testing.assert_allclose(found, [0.973, 0.449], rtol=0.01)
    # nothing is left of a wave as long as the patch
    assert ellipse_filter(A, np.array([2 * A]))[0] == pytest.approx(0, abs=1e-15)


def test_flat_punch_gives_the_plain_mean() -> None:
    # integral across the patch of 1/sqrt(1 - x^2/a^2 - y^2/b^2) = pi b, whatever x is
    for x in (0.0, 0.3, 0.9):
        c = np.sqrt(1 - x**2)
        # y = c sin(t) takes the singular edge away; the integrand is then 1
        t = np.linspace(-np.pi / 2, np.pi / 2, 11)[1:-1]
        value = c * np.cos(t) / np.sqrt(1 - x**2 - (c * np.sin(t)) ** 2)
        np.testing.assert_allclose(value, 1.0)


def test_weights_on_half_spaces() -> None:
    M, gap, normal, x = half_spaces()
    weights = load_weights(M, normal, press(M, gap, normal, LOAD))
    assert weights.sum() == pytest.approx(1.0) and weights.min() >= 0
    assert small_amplitude_filter(weights, x, np.array([1e3]))[0] == pytest.approx(1.0, abs=1e-8)
    waves = np.array([0.314, 0.1, 0.05, 0.0315, 0.025])
    found = small_amplitude_filter(weights, x, waves)
    np.testing.assert_allclose(found, ellipse_filter(A, waves), atol=0.02)


def test_small_amplitudes_are_the_limit_of_presses() -> None:
    M, gap, normal, x = half_spaces()
    weights = load_weights(M, normal, press(M, gap, normal, LOAD))
    for wavelength in (0.02, 0.05):
        exact = small_amplitude_filter(weights, x, np.array([wavelength]))[0]
        tiny = pressed_filter(PatchPoints(M, gap, normal, x), LOAD, wavelength, 1e-9, 6)
        # the same points stay in contact: equal to the rounding of approach/amplitude
        assert tiny == pytest.approx(exact, abs=1e-4)


def test_uniform_lift_is_followed_wholly() -> None:
    M, gap, normal, x = half_spaces()
    found = pressed_filter(PatchPoints(M, gap, normal, x), LOAD, 1e3, 1e-6, 4)
    assert found == pytest.approx(1.0, abs=1e-6)


def test_no_contact_is_refused() -> None:
    nothing = PressedForces(np.zeros(2), np.zeros(2, dtype=bool), 0, 0.0, 0.0)
    with pytest.raises(InputError, match="no point"):
        load_weights(np.eye(2), np.ones(2), nothing)

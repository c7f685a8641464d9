"""Laws that feel the profile along the patch, and the press as a law: closed forms, brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from contactstudy.contact.law_forces import of_penetration
from contactstudy.contact.laws import HertzSpring, PressSpring, point_forces
from contactstudy.contact.patch_laws import FollowingPatch, WinklerBedding
from contactstudy.contact.press_table import LARGEST, PressTable
from contactstudy.exceptions import InputError
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.irregularity import HarmonicProfile

LOAD = 80e3
HERTZ = hertz_contact(LOAD, contact_modulus(), 0.43, 0.30)
SPRING = HertzSpring(HERTZ.stiffness)
BEDDING = WinklerBedding(HERTZ.semi_axis_x, HERTZ.approach, LOAD)
FOLLOWING = FollowingPatch.on_ellipse(SPRING, HERTZ.semi_axis_x, HERTZ.approach)
LOADS = LOAD * np.linspace(0.1, LARGEST, 12)
TABLE = PressSpring((LOADS / HERTZ.stiffness) ** (2 / 3), LOADS)
SOFT = np.array([[3e-9]])


def wave(wavelength, amplitude, phase=0.0):
    k = np.array([2 * np.pi / wavelength])
    return HarmonicProfile(np.array([amplitude]), k, np.array([phase]))


def height(law, level, force, x=0.0):
    """Level of the wheel over its place on nothing, at which the law gives a force, at X = x."""
    felt, shape = law.seen(level, np.array([x]))

    def lacking(h):
        gap = np.array([h - felt[0]])
        return point_forces(law, np.array([[1e-30]]), gap, np.zeros(1), shape=shape)[0] - force

    return brentq(lacking, -1e-3, 1e-3, xtol=1e-17, rtol=1e-13)


@pytest.mark.parametrize("share", [1e-4, 0.05, 0.5, 1.0, 2.5, 7.0])
def test_table_of_hertz_is_hertz(share):
    # also below the first row of the table and beyond the last
    d = HERTZ.approach * share ** (2 / 3)
    one = point_forces(TABLE, SOFT, np.array([-d]), np.zeros(1))
    np.testing.assert_allclose(one, point_forces(SPRING, SOFT, np.array([-d]), np.zeros(1)), 1e-10)
    assert TABLE.approach_at(LOADS[3]) == pytest.approx(TABLE.approach[3], rel=1e-14)


def test_table_goes_through_its_rows_and_grows():
    rows = np.array([20e-6, 40e-6, 80e-6, 82e-6]), np.array([5e3, 40e3, 41e3, 90e3])
    law = PressSpring(*rows)
    none = np.zeros(0)
    d = np.linspace(1e-9, 120e-6, 3001)
    force = np.array([of_penetration(law.kind, law.numbers, none, v)[0] for v in d])
    assert np.all(np.diff(force) > 0)
    np.testing.assert_allclose(np.interp(rows[0], d, force), rows[1], rtol=1e-3)
    assert law.largest == 90e3


@given(
    st.sampled_from([SPRING, TABLE, BEDDING, FOLLOWING]),
    st.floats(1e-6, 2e-4),
    st.floats(0.0, 6.0),
    st.sampled_from([0.02, 0.05, 0.3]),
)
def test_slopes_are_those_of_the_forces(law, d, phase, wavelength):
    shape = np.zeros(0)
    if law in (BEDDING, FOLLOWING):
        shape = law.seen(wave(wavelength, 10e-6, phase), np.zeros(1))[1][0]
    h = 1e-11
    low, high = (of_penetration(law.kind, law.numbers, shape, d + s)[0] for s in (-h, h))
    slope = of_penetration(law.kind, law.numbers, shape, d)[1]
    kink = 5e-3 * slope if law is FOLLOWING else 0.0  # its mean is straight between approaches
    assert (high - low) / (2 * h) == pytest.approx(slope, rel=1e-4, abs=kink)


@pytest.mark.parametrize("share", [0.1, 0.5, 1.0, 2.0, 3.0])
def test_bedding_is_hertz_on_a_smooth_rail(share):
    found = height(BEDDING, np.zeros_like, share * LOAD)
    # the profile is straight between n places on half the patch: 1/(4 n^2) of the force is lost
    n = HERTZ.semi_axis_x * share ** (1 / 3) / BEDDING.step
    assert -found == pytest.approx(HERTZ.approach * share ** (2 / 3), rel=1 / (4 * n**2))
    assert -height(BEDDING, np.zeros_like, LOAD) == pytest.approx(HERTZ.approach, rel=1e-9)


@pytest.mark.parametrize(("wavelength", "amplitude"), [(0.03, 100e-6), (0.012, 20e-6), (0.2, 1e-3)])
def test_bedding_against_quadrature(wavelength, amplitude):
    level, a, d0 = wave(wavelength, amplitude, 2.0), HERTZ.semi_axis_x, HERTZ.approach
    k, R = 3 * LOAD / (4 * a * d0), a**2 / (2 * d0)

    def force(h):
        def pressed(x):
            return max(float(level(np.array([x]))[0]) - x**2 / (2 * R) - h, 0.0)

        return k * quad(pressed, -0.03, 0.03, limit=400, epsabs=1e-9, points=[-a, 0, a])[0]

    exact = brentq(lambda h: force(h) - LOAD, -2e-3, 2e-3, xtol=1e-12)
    assert height(BEDDING, level, LOAD) == pytest.approx(exact, abs=3e-3 * d0)


@pytest.mark.parametrize("law", [BEDDING, FOLLOWING])
@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("wavelength", [0.01, 0.016, 0.02, 0.05, 0.1])
def test_small_waves_are_felt_as_their_mean(law, share, wavelength):
    # the half length at this load
    a = HERTZ.semi_axis_x * share ** (1 / 3)
    ka = 2 * np.pi * a / wavelength
    amplitude = 1e-8
    smooth = height(law, np.zeros_like, share * LOAD)
    rise = height(law, wave(wavelength, amplitude), share * LOAD) - smooth
    assert rise / amplitude == pytest.approx(np.sin(ka) / ka, abs=0.006)


def test_weights_of_a_press_by_load():
    offsets = np.array([-2e-3, 0.0, 2e-3])
    rows = np.array([[0.0, 1.0, 0.0], [0.5, 0.0, 0.5]])
    forces = np.array([0.5, 1.5]) * LOAD
    approach = (forces / HERTZ.stiffness) ** (2 / 3)
    none = np.zeros(0)
    table = PressTable(None, forces, approach, offsets, rows, none, none, none)
    np.testing.assert_allclose(table.weights_at(LOAD), [0.25, 0.5, 0.25])
    law = FollowingPatch.of_press(SPRING, table)
    level, amplitude = wave(0.02, 1e-9), 1e-9
    for force, share in zip(forces, (1.0, np.cos(2 * np.pi * 2e-3 / 0.02)), strict=True):
        rise = height(law, level, force) - height(law, np.zeros_like, force)
        assert rise / amplitude == pytest.approx(share, abs=0.01)


def test_two_wheels_add_up():
    W = np.array([[3e-9, 1e-9], [1e-9, 4e-9]])
    gap = np.array([-3e-4, -4e-4])
    for law in (TABLE, BEDDING, FOLLOWING):
        shape = None
        if law is not TABLE:
            shape = law.seen(wave(0.05, 30e-6), np.array([0.0, 0.03]))[1]
        both = point_forces(law, W, gap, np.zeros(2), shape=shape)
        for i in range(2):
            own = None if shape is None else shape[i : i + 1]
            seen = gap[i : i + 1] + W[i, 1 - i] * both[1 - i]
            one = point_forces(law, W[i : i + 1, i : i + 1], seen, np.zeros(1), shape=own)
            assert both[i] == pytest.approx(one[0], rel=1e-9)
        apart = point_forces(law, W, np.array([1e-6, 2e-6]), np.zeros(2), shape=shape)
        np.testing.assert_array_equal(apart, 0.0)


@pytest.mark.parametrize("approach", [[2e-5, 1e-5, 3e-5], [1e-5, 1e-5, 2e-5], [0.0, 1e-5, 2e-5]])
def test_a_press_that_does_not_grow_is_refused(approach):
    with pytest.raises(InputError, match="approach and force must grow"):
        PressSpring(np.array(approach), np.array([1e4, 2e4, 3e4]))

"""Manufactured refinements: known order and limit, noise, oscillation, holes, verdicts."""

import math

import numpy as np
import pytest
from scipy.optimize import curve_fit

from contactstudy.compare.refinement import convergence
from contactstudy.exceptions import InputError

SIZES = [1 / n for n in (2, 4, 8, 16, 32)]


def powers(p, sizes=SIZES, limit=3.0, gain=-2.0):
    return [limit + gain * h**p for h in sizes]


@pytest.mark.parametrize("p", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("sizes", [(0.1, 0.17, 0.31), (0.31, 0.1, 0.17, 0.05)])
def test_order_and_limit_of_a_manufactured_series(p, sizes):
    result = convergence(sizes, powers(p, sizes))
    assert result.order == pytest.approx(p, rel=1e-8)
    assert result.limit == pytest.approx(3.0, rel=1e-9)
    assert result.uncertainty == pytest.approx(1.25 * 2.0 * min(sizes) ** p, rel=1e-7)
    assert result.index == pytest.approx(result.uncertainty / abs(3.0 - 2.0 * min(sizes) ** p))


def test_units_of_size_and_value_do_not_matter():
    plain = convergence(SIZES, powers(2))
    other = convergence([1e-6 * h for h in SIZES], [1e9 * f for f in powers(2)])
    assert other.order == pytest.approx(plain.order, rel=1e-8)
    assert other.index == pytest.approx(plain.index, rel=1e-6)
    assert other.verdict == plain.verdict == "asymptotic"


@pytest.mark.parametrize("gain", [2.0, 2e-6, 2e-10])
def test_standard_error_does_not_depend_on_how_small_the_differences_are(gain):
    """Beside scipy's curve_fit, which takes the Jacobian by differences, of a series by hand."""
    sizes = np.array([0.5, 0.25, 0.125, 0.0625, 0.03125])
    bent = sizes**2 + np.array([0.01, -0.004, 0.003, -0.002, 0.001])
    result = convergence(sizes, 1.0 + gain * bent, floor=1e-14)

    def power(h, limit, factor, p):
        return limit + factor * h**p

    for weights in (None, sizes**0.5):
        found, covariance = curve_fit(power, sizes, bent, p0=(0.0, 1.0, 2.0), sigma=weights)
        if found[2] == pytest.approx(result.order, rel=1e-4):
            assert result.order_error == pytest.approx(covariance[2, 2] ** 0.5, rel=1e-3)
            return
    pytest.fail(f"neither fit has the order {result.order}")


def test_noise_is_told_by_the_standard_error():
    """Order 2 plus noise: the true order is within two standard errors as often as it should.

    Student's t with 3 degrees of freedom is within 2 in 86 % of cases.
    """
    sizes = [1 / n for n in (2, 3, 4, 6, 8, 12)]
    random = np.random.default_rng(1)
    results = [
        convergence(sizes, np.array(powers(2, sizes)) + 2e-4 * random.standard_normal(6))
        for _ in range(200)
    ]
    orders = np.array([r.order for r in results])
    errors = np.array([r.order_error for r in results])
    assert np.median(orders) == pytest.approx(2.0, abs=0.01)
    assert 0.75 < np.mean(np.abs(orders - 2.0) < 2 * errors) < 0.95
    # the band about the finest value covers the limit in about 95 % of cases
    covered = [abs(powers(2, sizes)[-1] - 3.0) <= r.uncertainty for r in results]
    assert np.mean(covered) > 0.9


def test_norms_of_differences_from_the_finest():
    """An error C(x) h^p of fixed shape: order and what the finest has itself are found."""
    x = np.linspace(0.0, 1.0, 101)
    signals = [np.cos(3 * x) + np.sin(20 * x) * h**2 for h in SIZES]
    norm = [float(np.linalg.norm(s - signals[-1])) for s in signals]
    result = convergence(SIZES, norm, scale=1.0)
    own = np.linalg.norm(np.sin(20 * x)) * SIZES[-1] ** 2
    assert result.order == pytest.approx(2.0, rel=1e-7)
    assert result.limit == pytest.approx(-own, rel=1e-6)
    assert result.index == result.uncertainty == pytest.approx(1.25 * own, rel=1e-6)
    assert result.verdict == "asymptotic"


def test_holes_are_left_out():
    values = powers(2)
    values[1] = math.nan
    assert convergence(SIZES, values).order == pytest.approx(2.0, rel=1e-7)
    nothing = convergence(SIZES, [math.nan] * 5)
    assert math.isnan(nothing.uncertainty) and nothing.verdict == "not yet"
    one = convergence(SIZES, [math.nan] * 4 + [1.0])
    assert math.isnan(one.index) and one.verdict == "not yet"


def test_constant_values_are_at_rounding():
    for value in (0.0, 5.0):
        result = convergence(SIZES, [value] * 5)
        assert result.verdict == "round-off"
        assert math.isnan(result.order)
        assert result.uncertainty == result.index == 0.0


def test_finest_value_of_zero_has_no_relative_index():
    result = convergence([1, 2, 4], [0.0, 1.0, 5.0])
    assert result.order == pytest.approx(2.0)
    assert result.uncertainty == pytest.approx(1.25 / 3)
    assert math.isnan(result.index)


def test_two_values_need_an_expected_order():
    unknown = convergence([1, 2], [1.0, 1.3])
    assert math.isnan(unknown.index) and math.isnan(unknown.order)
    result = convergence([1, 2], [1.0, 1.3], expected=2)
    assert math.isnan(result.order)
    assert result.limit == pytest.approx(0.9)
    assert result.index == pytest.approx(3 * 0.1)  # ASME V&V 20: safety 3 for two grids
    assert result.verdict == "not yet"


def test_oscillating_values_have_no_order():
    """Signs change from size to size: three times the range (Eca & Hoekstra 2006)."""
    values = [1 + 0.2 * (-1) ** k * h for k, h in enumerate(SIZES)]
    for n in (3, 5):
        result = convergence(SIZES[:n], values[:n])
        assert math.isnan(result.order) and math.isnan(result.limit)
        assert result.uncertainty == pytest.approx(3 * np.ptp(values[:n]))
        assert result.verdict == "not yet"


def test_an_order_above_the_expected_one_is_not_trusted():
    result = convergence(SIZES, powers(4), expected=2)
    assert result.order == pytest.approx(4.0, rel=1e-7)
    assert result.verdict == "not yet"
    assert result.uncertainty > convergence(SIZES, powers(4), expected=4).uncertainty


def test_verdicts():
    assert convergence(SIZES, powers(2)).verdict == "asymptotic"
    assert convergence(SIZES, powers(2), expected=2).verdict == "asymptotic"
    assert convergence(SIZES, powers(1), expected=2).verdict == "not yet"
    assert convergence(SIZES, powers(0.3)).verdict == "not yet"
    assert convergence(SIZES[:3], powers(2, SIZES[:3])).verdict == "not yet"
    assert convergence(SIZES[:3], powers(2, SIZES[:3]), expected=2).verdict == "asymptotic"
    # two terms: first order for fine sizes only
    mixed = [1 + 0.2 * h + h**4 for h in (1.0, 0.5, 0.25, 0.125)]
    assert convergence((1.0, 0.5, 0.25, 0.125), mixed).verdict == "not yet"
    # away from the limit again at the finest
    assert convergence(SIZES, [1.5, 1.1, 1.02, 1.01, 1.04]).verdict == "not yet"


def test_round_off():
    tail = [*powers(4, [0.1, 0.05, 0.025]), 3.0 + 2e-9, 3.0 - 5e-9, 3.0 + 4e-9]
    sizes = [0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003]
    result = convergence(sizes, tail)
    assert result.verdict == "round-off"
    assert abs(result.uncertainty) < 1e-4
    # the last step below the floor of what was solved
    assert convergence(SIZES, [1.5, 1.1, 1.02, 1.01, 1.01 + 1e-6], floor=1e-5).verdict == (
        "round-off"
    )


@pytest.mark.parametrize(
    "sizes, values, said",
    [
        ([1, 2], [1.0], "one value a size"),
        ([1, 1, 2], [1.0, 2.0, 3.0], "positive and different"),
        ([0, 1, 2], [1.0, 2.0, 3.0], "positive and different"),
        ([math.nan, 1, 2], [1.0, 2.0, 3.0], "positive and different"),
    ],
)
def test_sizes_that_are_none(sizes, values, said):
    with pytest.raises(InputError, match=said):
        convergence(sizes, values)

"""Each norm against a value worked out by hand."""

import numpy as np
import pytest

from contactstudy.compare import norms
from contactstudy.exceptions import InputError

X = np.linspace(0.0, 2.0, 20001)
SINE = np.sin(2 * np.pi * 5 * X)  # ten whole periods
COSINE = np.cos(2 * np.pi * 5 * X)


def test_relative_l2_of_a_gain_and_of_a_quarter_period():
    assert norms.relative_l2(1.05 * SINE, SINE, X) == pytest.approx(0.05, abs=1e-12)
    # ||sin - cos||^2 = ||sin||^2 + ||cos||^2
    assert norms.relative_l2(SINE, COSINE, X) == pytest.approx(np.sqrt(2), abs=1e-6)


def test_dynamic_error_leaves_the_static_values_out():
    a, b = 100.0 + 1.1 * SINE, 90.0 + SINE
    dynamic = norms.relative_l2_dynamic(a, b, X, 100.0, 90.0)
    assert dynamic == pytest.approx(0.1, abs=1e-12)
    # total: sqrt(10^2 + 0.1^2/2) / sqrt(90^2 + 1/2)
    expected = np.sqrt(100 + 0.005) / np.sqrt(8100.5)
    assert norms.relative_l2(a, b, X) == pytest.approx(expected, rel=1e-9)


def test_linf_and_rms():
    assert norms.linf(3 + 2 * COSINE, 3 * np.ones_like(X)) == pytest.approx(2.0)
    assert norms.rms(3 + 2 * COSINE, 3.0, X) == pytest.approx(np.sqrt(2.0), rel=1e-6)


def test_correlation():
    assert norms.correlation(5 + 2 * SINE, SINE, X) == pytest.approx(1.0)
    assert norms.correlation(-SINE, SINE, X) == pytest.approx(-1.0)
    assert norms.correlation(SINE, COSINE, X) == pytest.approx(0.0, abs=1e-6)
    for constant in (1.0, 46597.5):  # whose mean is rounded
        assert np.isnan(norms.correlation(np.full_like(X, constant), SINE, X))


def test_norms_do_not_depend_on_uneven_sampling():
    # Three quarters of the samples in the first half: plain sums would weight it threefold.
    uneven = np.concatenate([np.linspace(0, 1, 30001), np.linspace(1, 2, 10001)[1:]])
    a, b = np.sin(2 * np.pi * uneven) * uneven, np.sin(2 * np.pi * uneven)
    even = np.sin(2 * np.pi * X) * X, np.sin(2 * np.pi * X)
    assert norms.relative_l2(a, b, uneven) == pytest.approx(norms.relative_l2(*even, X), 1e-6)
    assert norms.rms(a, b, uneven) == pytest.approx(norms.rms(*even, X), rel=1e-6)


def test_sprague_geers_published_checks():
    gain = norms.sprague_geers(1.05 * SINE, SINE, X)
    print(f"gain 5 %: M = 0.05 ({gain.magnitude:.6f}), P = 0 ({gain.phase:.6f})")
    assert gain.magnitude == pytest.approx(0.05, abs=1e-12)
    assert gain.phase == pytest.approx(0.0, abs=1e-7)
    assert gain.combined == pytest.approx(0.05, abs=1e-9)
    shift = norms.sprague_geers(np.sin(2 * np.pi * 5 * (X - 0.002)), SINE, X)
    print(f"2 ms at 5 Hz: M = 0 ({shift.magnitude:.6f}), P = 0.020 ({shift.phase:.6f})")
    assert shift.magnitude == pytest.approx(0.0, abs=1e-9)
    assert shift.phase == pytest.approx(0.020, abs=1e-6)


def test_zero_reference_is_nan_not_an_exception():
    zero = np.zeros_like(X)
    assert np.isnan(norms.relative_l2(SINE, zero, X))
    assert np.isnan(norms.sprague_geers(SINE, zero, X).phase)


def test_two_wheels_are_summed_over():
    two = np.stack([1.1 * SINE, SINE]), np.stack([SINE, SINE])
    # ||0.1 s||^2 / (2 ||s||^2)
    assert norms.relative_l2(*two, X) == pytest.approx(0.1 / np.sqrt(2), rel=1e-9)
    assert norms.rms(two[0] + 1, two[0], X) == pytest.approx(1.0)


def test_common_positions_take_the_finer_grid_behind_the_fade_in():
    coarse, fine = np.linspace(0, 10, 11), np.linspace(0.5, 8.5, 81)
    x = norms.common_positions(coarse, fine, start=3.0)
    assert x[0] == pytest.approx(3.0) and x[-1] == pytest.approx(8.5) and len(x) == 56
    with pytest.raises(InputError, match="in common"):
        norms.common_positions(coarse, coarse + 20, start=0.0)


def test_interpolation_keeps_samples_and_is_fourth_order():
    x = np.linspace(0, 1, 41)
    np.testing.assert_array_equal(norms.at_positions(np.sin(x), x, x[5:20]), np.sin(x)[5:20])
    fine = np.linspace(0, 1, 1001)
    err = [
        np.abs(norms.at_positions(np.sin(9 * s), s, fine) - np.sin(9 * fine)).max()
        for s in (np.linspace(0, 1, 41), np.linspace(0, 1, 81))
    ]
    assert np.log2(err[0] / err[1]) > 3.5

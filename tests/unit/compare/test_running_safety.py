"""Wheel forces as EN 14363 takes them."""

import numpy as np
import pytest

from contactstudy.compare.running_safety import sliding_mean, track_shift_limit, wheel_force_limit


def test_sliding_mean_by_brute_force():
    values, spacing = np.random.default_rng(3).normal(size=(3, 100)), 0.1
    found = sliding_mean(values, spacing)
    expected = [[row[k : k + 20].mean() for k in range(81)] for row in values]
    np.testing.assert_allclose(found, expected)
    # a peak of half the window has half its height
    peak = np.where(np.abs(np.arange(100) - 50) < 5, 1.0, 0.0)
    assert sliding_mean(peak, spacing).max() == pytest.approx(9 / 20)
    np.testing.assert_allclose(sliding_mean([1.0, 3.0], spacing), [2.0])


def test_limits():
    # 17 t an axle: 10 + 166.8/3 kN
    assert track_shift_limit(166.77e3) == pytest.approx(65.59e3)
    assert track_shift_limit(166.77e3, freight=True) == pytest.approx(0.85 * 65.59e3)
    assert wheel_force_limit(60e3, 100 / 3.6) == 150e3
    assert wheel_force_limit(112.5e3, 100 / 3.6) == 200e3
    assert wheel_force_limit(85e3, 300 / 3.6) == 170e3
    assert wheel_force_limit(85e3, 301 / 3.6) == 160e3

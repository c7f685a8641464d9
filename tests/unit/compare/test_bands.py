import numpy as np
import pytest

from contactstudy.compare.bands import share_above


@pytest.mark.parametrize("n", [1000, 1001])
def test_share_of_the_variance_above_a_frequency(n):
    # two sines with whole periods in the record: variances 1/2 and 9/2, and a mean
    dt = 1.0 / (n * 1.0)
    t = dt * np.arange(n)
    signal = 5.0 + np.sin(2 * np.pi * 40.0 * t) + 3.0 * np.cos(2 * np.pi * 200.0 * t)
    assert share_above(signal, dt, 100.0) == pytest.approx(0.9, abs=1e-9)
    assert share_above(signal, dt, 300.0) == pytest.approx(0.0, abs=1e-9)
    assert share_above(np.full(n, 7.0), dt, 1.0) == 0.0


def test_the_highest_frequency_counts_once():
    # variances 1 (at half the sampling rate) and 1/2
    signal = np.array([1.0, -1.0] * 4) + np.sin(2 * np.pi * np.arange(8) / 8)
    assert share_above(signal, 1.0, 0.4) == pytest.approx(1.0 / 1.5, rel=1e-12)

"""Confidence intervals against scipy's Student distribution, and their coverage."""

import numpy as np
import pytest
from scipy import stats

from contactstudy.compare.statistics import running, spread


def test_interval_is_students():
    x = np.random.default_rng(3).normal(7.0, 2.0, 12)
    found = spread([*x, np.nan])
    low, high = stats.t.interval(0.95, 11, loc=x.mean(), scale=stats.sem(x))
    assert found.n == 12 and found.mean == pytest.approx(x.mean())
    assert found.mean - found.half_width == pytest.approx(low)
    assert found.mean + found.half_width == pytest.approx(high)
    assert (found.low, found.high) == (x.min(), x.max())


def test_the_interval_holds_the_mean_as_often_as_it_says():
    rng = np.random.default_rng(11)
    inside = [
        abs(one.mean - 3.0) <= one.half_width
        for one in (spread(rng.normal(3.0, 1.0, 5)) for _ in range(4000))
    ]
    # binomial: three standard deviations of 4000 trials
    assert np.mean(inside) == pytest.approx(0.95, abs=3 * np.sqrt(0.95 * 0.05 / 4000))


def test_running_means_end_with_the_whole_sample():
    x = np.array([1.0, 3.0, np.nan, 5.0])
    n, mean, half = running(x)
    assert n.tolist() == [2, 3] and mean.tolist() == [2.0, 3.0]
    assert half[-1] == spread(x).half_width


def test_too_few():
    assert spread([]).n == 0 and np.isnan(spread([2.0]).half_width) and spread([2.0]).mean == 2.0

import numpy as np
import pytest

from contactstudy.compare.records import (
    Alignment,
    _correlations,
    agreement,
    aligned,
    is_reversed,
    overlaid,
)
from contactstudy.exceptions import InputError


def pulses(t, centres=(1.0, 1.6, 2.5), width=0.08):
    return sum((k + 1) * np.exp(-(((t - c) / width) ** 2)) for k, c in enumerate(centres))


def pair(shift=0.73, scale=2.5, noise=0.0, rate=800.0):
    """A run of two channels, and a record of the same with another clock, rate and scale."""
    t = np.linspace(0.0, 4.0, 4001)
    run = np.array([pulses(t), pulses(t - 0.1)])
    t_record = np.arange(0.0, 6.0, 1.0 / rate)
    at = t_record + shift
    record = scale * np.array([pulses(at), pulses(at - 0.1)])
    record = record + noise * np.random.default_rng(1).normal(size=record.shape)
    return (t, run), (t_record, record)


@pytest.mark.parametrize("shift", [0.0, 0.73, -0.5123, 1.00037])
def test_shift_and_scale_are_found_to_a_part_of_a_sample(shift):
    computed, measured = pair(shift)
    found = aligned(computed, measured)
    assert found.shift == pytest.approx(shift, abs=0.05 / 800)
    assert found.scale == pytest.approx(2.5, rel=1e-3)
    over = overlaid(computed, measured, found)
    for k in range(2):
        one = agreement(over, k)
        assert one.correlation > 0.9999 and one.normalised_error < 5e-3
        assert one.peak_ratio == pytest.approx(1.0, abs=2e-3)
        assert abs(one.timing) < 0.1 / 800


def test_noise_moves_them_little():
    found = aligned(*pair(0.4, noise=0.3))
    assert found.shift == pytest.approx(0.4, abs=2e-3)
    assert found.scale == pytest.approx(2.5, rel=0.02)


def test_zeros_of_gauges_are_found_with_the_scale():
    computed, (t, record) = pair(0.4)
    zeros = np.array([1.5, -0.8])
    off = (t, record + zeros[:, None])
    found = aligned(computed, off, zero=True)
    assert found.shift == pytest.approx(0.4, abs=1e-3)
    assert found.scale == pytest.approx(2.5, rel=1e-3)
    np.testing.assert_allclose(found.zero, zeros, atol=2e-3)
    assert agreement(overlaid(computed, off, found), 1).normalised_error < 5e-3
    # a scale that is given is kept: the zero is then what is left in the mean
    given = aligned(computed, off, shift=0.4, scale=2.5, zero=True)
    np.testing.assert_allclose(given.zero, zeros, atol=2e-3)
    # asked for nothing, nothing is taken off, and the scale suffers
    assert aligned(computed, off).zero == ()
    assert abs(aligned(computed, off).scale / 2.5 - 1.0) > 0.05


def test_given_shift_and_scale_are_kept():
    computed, measured = pair(0.4)
    found = aligned(computed, measured, shift=0.41, scale=2.0)
    assert (found.shift, found.scale) == (0.41, 2.0)
    one = agreement(overlaid(computed, measured, found), 0)
    # record time + 0.41 s: the measured comes 10 ms late, so the computed one 10 ms early
    assert one.timing == pytest.approx(-0.01, abs=2e-4)
    assert one.peak_ratio == pytest.approx(0.8, rel=1e-3)
    assert one.normalised_error > 0.2


def test_correlations_are_those_of_numpy_over_each_overlap():
    rng = np.random.default_rng(3)
    a, b = rng.normal(size=(2, 30)), rng.normal(size=(2, 21))
    lags, found = _correlations(a, b)
    for lag, value in zip(lags, found, strict=True):
        lo, hi = max(0, lag), min(30, lag + 21)
        if hi - lo < 10.5:
            assert value == -1.0
            continue
        left, right = a[:, lo:hi].ravel(), b[:, lo - lag : hi - lag].ravel()
        assert value == pytest.approx(np.corrcoef(left, right)[0, 1], abs=1e-9)


def test_negative_peaks_keep_their_sign():
    t = np.linspace(0.0, 4.0, 2001)
    over = overlaid((t, -pulses(t)[None]), (t, -2.0 * pulses(t)[None]), Alignment(0.0, 1.0))
    assert agreement(over, 0).peak_ratio == pytest.approx(0.5)


def swing(t):
    """What agrees nearly as well half a period later, with the opposite sign."""
    return np.exp(-((t - 1.5) ** 2)) * np.sin(2 * np.pi * 4 * t)


@pytest.mark.parametrize("of", [pulses, swing])
@pytest.mark.parametrize("fitted", [True, False])
@pytest.mark.parametrize("signs", [(1, 1, 1), (1, 1, -1), (-1, -1, -1)])
def test_channels_of_the_opposite_sign_are_named(signs, fitted, of):
    if of is swing and fitted and len(set(signs)) == 1:
        return  # no other channel tells a reversed swing from one half a period later
    t, t_record = np.linspace(0.0, 4.0, 2001), np.arange(0.0, 6.0, 1 / 700)
    run = t, np.array([of(t - k * 0.2) for k in range(3)])
    noise = 0.1 * np.random.default_rng(2).normal(size=(3, len(t_record)))
    rows = [sign * 2.0 * of(t_record + 0.3 - k * 0.2) for k, sign in enumerate(signs)]
    record = t_record, np.array(rows) + noise
    shift = aligned(run, record).shift if fitted else 0.3
    found = [
        is_reversed((t, run[1][k : k + 1]), (t_record, record[1][k : k + 1]), shift, fitted)
        for k in range(3)
    ]
    assert found == [sign < 0 for sign in signs]


def test_records_without_a_common_time_or_without_a_signal():
    computed, measured = pair()
    with pytest.raises(InputError, match="no common time with the run: shifted by 100 s"):
        aligned(computed, measured, shift=100.0)
    with pytest.raises(InputError, match="are zero"):
        aligned(computed, (measured[0], 0.0 * measured[1]), shift=0.0)

import numpy as np
import pytest
from scipy.signal import butter, freqs

from contactstudy.compare.comfort import (
    mean_comfort,
    sperling,
    sperling_weight,
    weighted_rms,
    weighting,
)
from contactstudy.exceptions import InputError

DT = 1e-3


def sine(f, a, seconds=10.0, dt=DT):
    return a * np.sin(2 * np.pi * f * np.arange(round(seconds / dt)) * dt + 0.3)


# W = 0.896 (a^3 F/f)^(1/10), a in cm/s^2, worked out by hand from Sperling's F
@pytest.mark.parametrize(
    ("f", "a", "direction", "F"),
    [
        (1.0, 0.5, "Z", 0.325),
        (2.0, 0.3, "Z", 1.3),
        (8.0, 0.3, "Z", 6.25),
        (25.0, 1.0, "Z", 1.0),
        (1.0, 0.5, "Y", 0.8),
        (4.0, 0.2, "Y", 12.8),
        (10.0, 0.2, "Y", 6.5),
    ],
)
def test_sperlings_index_of_a_sine(f, a, direction, F):
    expected = 0.896 * ((100 * a) ** 3 * F / f) ** 0.1
    assert sperling(sine(f, a), DT, direction) == pytest.approx(expected, rel=1e-3)
    assert sperling_weight(f, direction) == pytest.approx(F)


def test_sperlings_index_adds_by_tenth_powers_and_knows_no_mean():
    one, two = (sperling(sine(f, a), DT) for f, a in ((2.0, 0.4), (6.0, 0.2)))
    both = sperling(sine(2.0, 0.4) + sine(6.0, 0.2) + 3.0, DT)
    assert both == pytest.approx((one**10 + two**10) ** 0.1, rel=1e-9)
    # below 0.5 and above 40 Hz nothing counts
    assert sperling(sine(0.2, 1.0) + sine(45.0, 1.0), DT) == pytest.approx(0.0, abs=1e-3)
    assert sperling(sine(2.0, 0.4, 3.0), DT) == pytest.approx(one, rel=1e-9)


def test_lateral_weighting_is_that_of_iso_2631():
    # ISO 2631-1, table 3: W_d times 1000
    table = {0.5: 853, 1.0: 1011, 2.0: 890, 4.0: 512, 8.0: 253, 16.0: 125, 31.5: 63.2}
    for f, printed in table.items():
        assert 1e3 * weighting(f, "Y") == pytest.approx(printed, rel=6e-3), f


def test_vertical_weighting_follows_its_asymptotes():
    # BS 6841: 0.4 up to 2 Hz, f/5 to 5 Hz, 1 to 16 Hz, 16/f beyond; filters within 2 dB of them
    for f in (0.8, 1.25, 2.0, 3.15, 5.0, 8.0, 12.5, 20.0, 31.5, 50.0):
        line = 0.4 if f <= 2 else f / 5 if f <= 5 else 1.0 if f <= 16 else 16 / f
        assert abs(20 * np.log10(weighting(f, "Z") / line)) < 2.1, f


def test_band_limits_are_butterworth_filters():
    f = np.array([0.3, 0.4, 0.6])
    b, a = butter(2, 2 * np.pi * 0.4, "highpass", analog=True)
    high = np.abs(freqs(b, a, 2 * np.pi * f)[1])
    np.testing.assert_allclose(weighting(f, "Z") / 0.4, high, rtol=0.02)


def test_weighted_rms_of_a_sine_and_of_a_sum():
    for f, direction in ((2.0, "Z"), (8.0, "Z"), (1.0, "Y")):
        found = weighted_rms(sine(f, 0.6, 15.0), DT, direction)
        assert found.shape == (3,)
        np.testing.assert_allclose(found, 0.6 / np.sqrt(2) * weighting(f, direction), rtol=1e-9)
    both = weighted_rms(sine(2.0, 0.6) + sine(7.0, 0.5), DT)
    parts = [weighted_rms(sine(f, a), DT) for f, a in ((2.0, 0.6), (7.0, 0.5))]
    np.testing.assert_allclose(both, np.hypot(*parts), rtol=1e-9)


def test_mean_comfort_of_two_sines():
    vertical, lateral = sine(8.0, 0.3, 30.0), sine(1.0, 0.2, 30.0)
    a_z, a_y = 0.3 / np.sqrt(2) * weighting(8.0, "Z"), 0.2 / np.sqrt(2) * 1.011
    found = mean_comfort(vertical, lateral, DT)
    assert found == pytest.approx(6 * np.hypot(a_z, a_y), rel=2e-3)


def test_short_or_bad_records_are_refused():
    for bad in (sine(2.0, 1.0, 1.5), np.full(5000, np.nan), np.zeros((2, 5000))):
        with pytest.raises(InputError, match="at least 2 s long"):
            sperling(bad, DT)
    with pytest.raises(InputError, match="time_step = 0"):
        weighted_rms(sine(2.0, 1.0), 0.0)

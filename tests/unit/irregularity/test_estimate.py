import numpy as np
import pytest
from scipy.signal import welch

from contactstudy.exceptions import InputError
from contactstudy.irregularity import nominal_centre, spectral_estimate, third_octave_levels


def _noise(n=4096, seed=2):
    return np.random.default_rng(seed).standard_normal(n)


def test_sides_and_units_against_scipy():
    x, dx = _noise(), 0.05
    f, one = welch(x, fs=1 / dx, window="hann", nperseg=512, noverlap=256)
    ours = {
        (s, u): spectral_estimate(x, dx, 512 * dx, s, u)
        for s in ("one", "two")
        for u in ("rad/m", "1/m")
    }
    inner = slice(1, -1)  # scipy does not double the lines at 0 and Nyquist
    np.testing.assert_allclose(ours["one", "1/m"].wavenumber, f)
    np.testing.assert_allclose(ours["one", "1/m"].density[inner], one[inner])
    np.testing.assert_allclose(ours["two", "1/m"].density[inner], one[inner] / 2)
    np.testing.assert_allclose(ours["one", "rad/m"].wavenumber, 2 * np.pi * f)
    np.testing.assert_allclose(ours["two", "rad/m"].density[inner], one[inner] / 4 / np.pi)
    assert ours["two", "rad/m"].n_segments == 15


def test_two_sided_density_integrates_to_the_variance():
    x = _noise(2**15)
    e = spectral_estimate(x, 0.1, 51.2)
    step = e.wavenumber[1]
    assert 2 * e.density.sum() * step == pytest.approx(x.var(), rel=0.02)


def test_nominal_centres():
    k = np.arange(-3, 14)
    expected = [
        0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0, 10.0, 12.5, 16.0, 20.0,
    ]  # fmt: skip
    np.testing.assert_array_equal(nominal_centre(10 ** (k / 10)), expected)


def test_a_sine_of_one_micrometre_rms_is_zero_decibels():
    x = np.arange(0.0, 40.0, 0.01)
    levels = third_octave_levels(np.sqrt(2) * 1e-6 * np.sin(2 * np.pi * x / 0.5), 0.01)
    at = np.argmin(abs(levels.wavelength - 0.5))
    assert levels.nominal[at] == 2.0
    assert levels.level[at] == pytest.approx(0.0, abs=0.01)
    assert levels.level[at - 2] < -60 and levels.level[at + 2] < -60


def test_bands_of_white_noise_carry_the_share_of_their_width():
    x, dt = _noise(2**16), 1e-3
    levels = third_octave_levels(x, dt, reference=1.0, band=(10.0, 400.0))
    share = levels.centre * (10**0.05 - 10**-0.05) / 500.0
    assert levels.nominal[0] == 10.0 and levels.nominal[-1] == 400.0
    lines = share * 2**15
    assert np.all(abs(levels.mean_square / share - 1) < 4 * np.sqrt(2.0 / lines))
    assert levels.mean_square.sum() == pytest.approx(share.sum(), rel=0.03)


def test_bands_narrower_than_a_line_are_left_out():
    levels = third_octave_levels(_noise(1000), 3e-4)  # 0.3 s: lines 3.3 Hz apart
    assert levels.centre[0] * (10**0.05 - 10**-0.05) >= 1 / 0.3
    assert levels.centre[-1] * 10**0.05 <= 0.5 / 3e-4


def test_wrong_arguments():
    with pytest.raises(InputError, match="spacing is 0"):
        spectral_estimate(_noise(), 0.0)
    with pytest.raises(InputError, match="8 or more finite"):
        spectral_estimate(np.array([1.0, np.nan] * 8), 0.1)
    with pytest.raises(InputError, match="segment length is 1e"):
        spectral_estimate(_noise(), 0.1, 1e6)
    with pytest.raises(InputError, match="'one' or 'two'"):
        spectral_estimate(_noise(), 0.1, sides="both")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="reference is 0"):
        third_octave_levels(_noise(), 0.1, reference=0.0)
    with pytest.raises(InputError, match="lowest <= highest"):
        third_octave_levels(_noise(), 0.1, band=(5.0, 1.0))


@pytest.mark.parametrize(("samples", "n"), [(1000, 125), (1001, 124), (64, 64), (999, 333)])
def test_welchs_estimate_against_scipys(samples, n):
    values = 3.0 + np.random.default_rng(1).normal(size=samples)
    mine = spectral_estimate(values, 0.01, 0.01 * n, unit="1/m")
    frequency, density = welch(
        values, 100.0, "hann", n, n // 2, detrend="constant", return_onesided=False
    )
    half = n // 2 + 1
    np.testing.assert_allclose(mine.wavenumber, np.abs(frequency[:half]), rtol=1e-12)
    np.testing.assert_allclose(mine.density, density[:half], rtol=1e-11, atol=1e-14)

"""The paper's irregularity against derived figures, spectra against their integrals."""

import itertools
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from contactstudy.irregularity import (
    band_deviations,
    measured_profile,
    sample_profile,
    spectral_estimate,
    spectrum,
    third_octave_levels,
)
from contactstudy.irregularity.spectra import NAMES

PAPER = spectrum("paper")


def test_frequencies_at_300_km_h():
    w = sample_profile(PAPER, 1).wavenumbers
    step = w[1] - w[0]
    v = 300 / 3.6
    low, high = ((w[0] - step / 2) * v / 2 / np.pi, (w[-1] + step / 2) * v / 2 / np.pi)
    print(f"Table 1 at 300 km/h: paper 1 to 265 Hz, computed {low:.3f} to {high:.2f} Hz")
    assert low == pytest.approx(1.06, abs=0.005)
    assert high == pytest.approx(265, abs=0.5)
    assert step == pytest.approx(0.01992)


@pytest.mark.parametrize(
    ("longest", "reference"), [(np.inf, 1.32), (20.0, 0.55), (3.0, 0.072), (1.0, 0.014)]
)
def test_rms_by_wavelength(longest, reference):
    profile = sample_profile(PAPER, 1)
    short = profile.wavenumbers > 2 * np.pi / longest
    rms = np.sqrt(np.sum(profile.amplitudes[short] ** 2) / 2) * 1e3
    print(f"RMS of wavelengths below {longest} m: derived {reference} mm, computed {rms:.4f} mm")
    assert rms == pytest.approx(reference, rel=0.03 if longest == 1.0 else 0.01)  # printed digits


def test_half_peak_to_peak_in_20_m_windows():
    windows = [
        np.ptp(sample_profile(PAPER, seed)(np.arange(0.0, 300.0, 0.05)).reshape(-1, 400), axis=1)
        for seed in range(60)
    ]
    means = 0.5e3 * np.mean(windows, axis=1)
    error = means.std() / np.sqrt(len(means))
    print(f"half peak-to-peak in 20 m: derived 1.65 mm, computed {means.mean():.3f} "
          f"+- {error:.3f} mm (paper: 2 mm per 20 m)")  # fmt: skip
    assert means.mean() == pytest.approx(1.65, abs=max(3 * error, 0.02))


def test_near_repeat():
    x = np.linspace(0.0, 300.0, 6001)
    plain, jittered = sample_profile(PAPER, 1), sample_profile(PAPER, 1, jitter=True)
    assert plain.repeat_length == pytest.approx(315.42, abs=0.01)

    def correlation(profile, shift):
        return np.corrcoef(profile(x), profile(x + shift))[0, 1]

    # all terms turn by the same 2 pi omega_1/step; the sign and the angle left are
    angle = 2 * np.pi * plain.wavenumbers[0] / (plain.wavenumbers[1] - plain.wavenumbers[0])
    for shift, expected in ((315.4, -1.0), (630.8, 1.0)):
        found = correlation(plain, shift)
        exact = np.cos(angle * round(shift / 315.4))
        other = correlation(jittered, shift)
        print(f"r(X + {shift}) against r(X): correlation {found:.4f} "
              f"(common turn {exact:.4f}), jittered {other:.2f}")  # fmt: skip
        assert found == pytest.approx(expected, abs=0.03)
        assert found == pytest.approx(exact, abs=0.01)
        assert abs(other) < 0.8


@pytest.mark.parametrize("name", NAMES)
def test_sample_variance_against_the_integral_of_the_spectrum(name):
    g = spectrum(name)
    # the four branches of TB/T 3352 meet at these wavenumbers; the others are smooth there
    joints = 2 * np.pi * np.array([0.08 / 2 / np.pi, 0.0187, 0.0474, 0.1533, 20 / 2 / np.pi])
    integral = 2 * sum(
        quad(lambda w: float(g(w)), a, b, limit=500, epsabs=0, epsrel=1e-9)[0]
        for a, b in itertools.pairwise(joints)
    )
    profile = sample_profile(g, 11, n_terms=4000)
    x = np.arange(0.0, 8 * profile.repeat_length, 0.137)
    variance = profile(x).var()
    print(f"{name}: variance of the sample {variance * 1e6:.5f} mm2, "
          f"integral {integral * 1e6:.5f} mm2")  # fmt: skip
    assert g.variance(0.08, 20.0) == pytest.approx(integral, rel=1e-7)
    # 4000 terms leave the midpoint rule an error of up to 0.2 %, the length another 0.1 %
    assert variance == pytest.approx(integral, rel=5e-3)


def test_german_variance_in_closed_form():
    # int dw/((w^2+r^2)(w^2+c^2)) = [atan(w/r)/r - atan(w/c)/c]/(c^2-r^2)
    a, c, r = 4.032e-7, 0.8246, 0.0206

    def primitive(w):
        return (np.arctan(w / r) / r - np.arctan(w / c) / c) / (c**2 - r**2)

    exact = a * c**2 * (primitive(20.0) - primitive(0.08))  # one-sided
    computed = spectrum("german_low").variance(0.08, 20.0)
    print(f"German low: closed form {exact * 1e6:.6f} mm2, computed {computed * 1e6:.6f} mm2")
    assert computed == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize(("name", "published"), [("german_low", 0.98), ("fra6", 1.43)])
def test_standard_deviation_of_german_and_fra_spectra_from_3_to_25_m(name, published):
    """What these spectra give where they are read one-sided, as open programs do (D1)."""
    by_integral = 1e3 * np.sqrt(spectrum(name).variance(2 * np.pi / 25, 2 * np.pi / 3))
    profile = sample_profile(spectrum(name), 3, n_terms=8000)
    x = np.arange(0.0, 4 * profile.repeat_length, 0.2)
    wave = np.fft.rfft(profile(x) * np.hanning(len(x))) / np.sqrt(np.mean(np.hanning(len(x)) ** 2))
    k = np.fft.rfftfreq(len(x), 0.2)
    kept = (k > 1 / 25) & (k <= 1 / 3)
    of_samples = 1e3 * np.sqrt(2 * np.sum(np.abs(wave[kept]) ** 2)) / len(x)
    default = sample_profile(spectrum(name), 3)
    told = {b.band: 1e3 * b.deviation for b in band_deviations(default, (0.08, 20.0))}
    print(f"{name}: {published} mm; integral {by_integral:.3f}, profile {of_samples:.3f}, "
          f"told {told['D1']:.3f} mm")  # fmt: skip
    assert by_integral == pytest.approx(published, abs=0.01)
    assert of_samples == pytest.approx(published, rel=0.02)
    assert told["D1"] == pytest.approx(of_samples, rel=0.01)


def test_bands_that_a_profile_covers_in_part():
    found = band_deviations(sample_profile(PAPER, 1), (0.08, 20.0))
    assert [b.band for b in found] == ["D0", "D1", "D2", "D3"]
    assert (found[-1].shortest, found[-1].longest) == (70.0, pytest.approx(2 * np.pi / 0.08))
    assert str(found[-1]).startswith("part of D3 (70 to 78.5 m)")
    # known of Table 1: RMS 0.55 mm below 20 m
    assert 0.55 < 1e3 * np.hypot(found[0].deviation, found[1].deviation) < 0.75
    short = sample_profile(PAPER, 1, band=(3.0, 20.0))
    assert [b.band for b in band_deviations(short, (3.0, 20.0))] == ["D0"]


def test_welch_estimate_lies_on_the_two_sided_spectrum():
    profile = sample_profile(PAPER, 4, jitter=True)
    dx = 0.1
    estimate = spectral_estimate(profile(np.arange(0.0, 4000.0, dx)), dx, segment_length=100.0)
    w = estimate.wavenumber
    for low, high in ((0.3, 0.6), (0.6, 1.2), (1.2, 2.5), (2.5, 5.0), (5.0, 10.0), (10.0, 19.0)):
        inside = (w >= low) & (w <= high)
        ratio = np.mean(estimate.density[inside] / PAPER(w[inside]))
        decibel = 10 * np.log10(ratio)
        print(f"{low} to {high} rad/m: estimate over G_rr {ratio:.3f} ({decibel:+.2f} dB)")
        assert abs(decibel) < 0.5  # reading eq. (2) as one-sided would be 3 dB off


def test_third_octave_levels_against_the_integral_of_the_spectrum():
    profile = sample_profile(PAPER, 4, jitter=True)
    dx = 0.05
    levels = third_octave_levels(profile(np.arange(0.0, 1000.0, dx)), dx, band=(0.1, 2.5))
    for centre, nominal, level in zip(levels.centre, levels.nominal, levels.level, strict=True):
        edges = 2 * np.pi * centre * 10.0 ** np.array([-0.05, 0.05])
        exact = 10 * np.log10(PAPER.variance(*edges) / 1e-12)
        print(f"wavelength {1 / nominal:.3f} m: spectrum {exact:.2f} dB re 1 um, "
              f"sample {level:.2f} dB")  # fmt: skip
        assert level == pytest.approx(exact, abs=2.0 if centre < 0.3 else 1.0)


def test_measured_level_of_a_high_speed_line():
    file = Path(__file__).parents[2].parent / "shared" / "data" / "hsr_level_20170110.csv"
    if not file.exists():
        pytest.skip("measured track level (hsr_level_20170110.csv) is not on this machine")
    profile = measured_profile(
        file, "left_mm", "mm", x_column="chainage_m", origin=98000.0, wavelengths=(2.5, 42.0)
    )
    assert profile.domain == (0.0, pytest.approx(1999.75))
    levels = profile(np.arange(0.0, 1999.9, 0.25))
    estimate = spectral_estimate(levels, 0.25, segment_length=400.0)
    w = estimate.wavenumber
    print(f"left rail, 2.5 to 42 m: RMS {levels.std() * 1e3:.3f} mm")

    def difference(longest, shortest):
        inside = (w >= 2 * np.pi / longest) & (w <= 2 * np.pi / shortest)
        return float(np.mean(10 * np.log10(estimate.density[inside] / PAPER(w[inside]))))

    for longest, shortest in ((33.0, 20.0), (20.0, 10.0), (10.0, 7.0), (7.0, 3.0)):
        print(f"{longest} to {shortest} m: {difference(longest, shortest):+.1f} dB re Table 1")
    # known of this record: 3 to 10 dB smoother than Table 1, peaks at 33, 16.3, 10.9 m (girders)
    assert -10.0 < difference(33.0, 10.0) < -3.0
    for peak in (33.0, 16.3, 10.9):
        # the peaks are one or two lines wide; beside the first one the longer waves are cut off
        beside = [difference(peak / 1.05, peak / 1.2)]
        if peak < 30.0:
            beside.append(difference(peak * 1.2, peak * 1.05))
        above = difference(peak * 1.025, peak / 1.025) - float(np.mean(beside))
        print(f"peak at {peak} m: {above:+.1f} dB above the wavelengths beside it")
        assert above > 2.0
    assert levels.mean() == pytest.approx(0.0, abs=2e-6)  # outside the band nothing is left

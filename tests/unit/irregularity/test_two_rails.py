"""Irregularity of both rails: variance, coherence, seeds, gauge and cross level."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import csd

from contactstudy.exceptions import InputError
from contactstudy.irregularity import Irregularity, SmoothRail, both_rails, spectrum
from contactstudy.irregularity.spectra import NAMES

X = np.linspace(0.0, 400.0, 4001)


def table(**values):
    return Irregularity(**{"seed": 5, "terms": 800, "jitter": True} | values)


def measured_coherence(right, left, band):
    """Of ensembles of terms: |sum R L*|^2 / (sum |R|^2 sum |L|^2) in a band of wavenumbers."""
    cross = square_r = square_l = 0.0
    for r, s in zip(right, left, strict=True):
        keep = (r.wavenumbers >= band[0]) & (r.wavenumbers < band[1])
        a = (r.amplitudes * np.exp(1j * r.phases))[keep]
        b = (s.amplitudes * np.exp(1j * s.phases))[keep]
        cross += np.sum(a * b.conj())
        square_r += np.sum(np.abs(a) ** 2)
        square_l += np.sum(np.abs(b) ** 2)
    return np.abs(cross) ** 2 / (square_r * square_l)


def test_coherent_rails_are_the_profile_of_one_rail():
    pair, one = both_rails(table()), table().profile("Z")
    for rail in (0, 1):
        np.testing.assert_allclose(pair.level(rail, "Z", X), one(X), atol=1e-15)
    np.testing.assert_allclose(pair.cross_level(X), 0.0, atol=1e-15)
    np.testing.assert_allclose(pair.gauge(X), 0.0, atol=1e-15)
    np.testing.assert_allclose(pair.alignment(X), table().profile("Y")(X), atol=1e-15)
    np.testing.assert_allclose(pair.longitudinal_level(X), one(X), atol=1e-15)


@pytest.mark.parametrize("direction", ["Z", "Y"])
def test_every_rail_has_the_variance_of_the_spectrum(direction):
    band = (0.3, 20.0)
    formula = spectrum("paper")
    expected = 2.0 * quad(formula, *band, limit=200)[0]
    for coherence in (0.0, 0.5, "decaying"):
        pairs = [both_rails(table(seed=s, coherence=coherence, band=band)) for s in range(60)]
        for rail in (0, 1):
            found = [np.sum(p.of(rail, direction).amplitudes ** 2) / 2 for p in pairs]
            error = np.std(found) / np.sqrt(len(found))
            assert np.mean(found) == pytest.approx(expected, abs=4 * error + 2e-3 * expected)


@pytest.mark.parametrize("coherence", [0.0, 0.3, 0.8, 1.0])
def test_rails_have_the_coherence_that_is_stated(coherence):
    pairs = [both_rails(table(seed=s, coherence=coherence)) for s in range(40)]
    for direction in "ZY":
        right, left = ([p.of(rail, direction) for p in pairs] for rail in (0, 1))
        # weights of the terms are very uneven at low wavenumbers, so narrow bands
        for band in ((1.0, 1.5), (5.0, 7.0), (12.0, 20.0)):
            found = measured_coherence(right, left, band)
            assert found == pytest.approx(coherence, abs=0.08)


def test_coherence_decays_with_the_wavelength():
    values = {"coherence": "decaying", "coherence_wavelength": 4.0}
    pairs = [both_rails(table(seed=s, **values)) for s in range(60)]
    right, left = ([p.of(rail, "Z") for p in pairs] for rail in (0, 1))
    for wavelength in (40.0, 8.0, 4.0, 1.5, 0.5):
        w = 2 * np.pi / wavelength
        found = measured_coherence(right, left, (0.93 * w, 1.07 * w))
        assert found == pytest.approx(np.exp(-4.0 / wavelength), abs=0.09), wavelength


def test_coherence_of_the_levels_themselves():
    """By Welch's estimate of the sampled levels, not of the terms."""
    x = np.arange(0.0, 4000.0, 0.25)
    found = []
    for seed in range(6):
        pair = both_rails(table(seed=seed, coherence=0.6, terms=4000, band=(0.5, 8.0)))
        r, s = (pair.level(rail, "Y", x) for rail in (0, 1))
        f, cross = csd(r, s, 4.0, nperseg=512)
        found.append((cross, csd(r, r, 4.0, nperseg=512)[1], csd(s, s, 4.0, nperseg=512)[1]))
    cross, square_r, square_s = (np.mean([one[k] for one in found], axis=0) for k in range(3))
    inside = (2 * np.pi * f > 1.0) & (2 * np.pi * f < 7.0)
    gamma2 = np.abs(cross) ** 2 / (square_r.real * square_s.real)
    assert np.mean(gamma2[inside]) == pytest.approx(0.6, abs=0.03)


def test_vertical_and_transverse_are_independent():
    pairs = [both_rails(table(seed=s, coherence=0.5)) for s in range(40)]
    for rail in (0, 1):
        for other in (0, 1):
            found = measured_coherence(
                [p.of(rail, "Z") for p in pairs],
                [p.of(other, "Y") for p in pairs],
                (5.0, 9.0),
            )
            assert found < 0.03


def test_seeds_reproduce_and_differ():
    once, again = (both_rails(table(coherence=0.4)) for _ in range(2))
    other = both_rails(table(coherence=0.4, seed=6))
    for rail in (0, 1):
        for direction in "ZY":
            level = once.level(rail, direction, X)
            np.testing.assert_array_equal(level, again.level(rail, direction, X))
            assert np.abs(level - other.level(rail, direction, X)).max() > 1e-4
    # the right rail is that of the seed, whatever the coherence
    alone = both_rails(table(coherence=0.0))
    np.testing.assert_array_equal(alone.level(0, "Z", X), once.level(0, "Z", X))


def test_gauge_and_cross_level_are_differences_of_the_rails():
    pair = both_rails(table(coherence=0.0))
    right, left = (pair.level(rail, "Z", X) for rail in (0, 1))
    np.testing.assert_allclose(pair.cross_level(X), left - right)
    np.testing.assert_allclose(pair.longitudinal_level(X), (left + right) / 2)
    right, left = (pair.level(rail, "Y", X) for rail in (0, 1))
    # a left rail further to the left and a right rail further to the right widen the gauge
    np.testing.assert_allclose(pair.gauge(X), left - right)
    h = 1e-5
    slope = (pair.level(1, "Y", X + h) - pair.level(1, "Y", X - h)) / (2 * h)
    np.testing.assert_allclose(pair.level(1, "Y", X, 1), slope, atol=1e-8)


@pytest.mark.parametrize(("name", "lateral"), [("german_low", 2.119e-7), ("german_high", 6.125e-7)])
def test_german_lateral_spectra(name, lateral):
    w = np.array([0.1, 1.0, 5.0])
    printed = lateral * 0.8246**2 / ((w**2 + 0.0206**2) * (w**2 + 0.8246**2))
    np.testing.assert_allclose(2.0 * table(spectrum=name).formula("Y")(w), printed)
    ratio = {"german_low": 4.032e-7, "german_high": 1.08e-6}[name] / lateral
    np.testing.assert_allclose(table(spectrum=name).formula("Z")(w), ratio * printed / 2)
    up, across = (table(spectrum=name).profile(d) for d in "ZY")
    assert up.rms > across.rms


def test_every_named_spectrum_has_a_lateral_formula():
    w = np.geomspace(0.1, 20.0, 50)
    for name in NAMES:
        density = table(spectrum=name).formula("Y")(w)
        assert np.all(density > 0.0) and np.all(np.diff(density) < 0.0)
    # pieces of the Chinese formula meet where they change over, as its vertical ones do
    for direction in ("vertical", "lateral"):
        made = spectrum("tbt3352", direction=direction)
        ends = 2 * np.pi * np.array(made.breaks)
        np.testing.assert_allclose(made(ends * (1 - 1e-9)), made(ends * (1 + 1e-9)), rtol=5e-3)


def test_sinusoids_and_defects_are_on_both_rails():
    pair = both_rails(Irregularity(spectrum="sinusoid", amplitude=1e-4, wavelength=2.0))
    np.testing.assert_array_equal(pair.level(0, "Z", X), pair.level(1, "Z", X))
    assert isinstance(pair.of(1, "Y"), SmoothRail)
    from contactstudy.irregularity import DippedJoint

    joint = DippedJoint(at=20.0)
    pair = both_rails(Irregularity(spectrum="smooth", rail_defect=joint))
    assert pair.level(0, "Z", 20.0) == pair.level(1, "Z", 20.0) < 0.0


def test_measured_levels_of_both_rails(tmp_path):
    x = np.arange(0.0, 400.0, 0.25)
    waves = {
        "right": np.sin(x), "left": np.cos(x), "across": np.sin(0.5 * x),
    }  # fmt: skip
    rows = "\n".join(",".join(f"{v:.6f}" for v in row) for row in zip(x, *waves.values(),
                     strict=True))  # fmt: skip
    path = tmp_path / "level.csv"
    path.write_text("x," + ",".join(waves) + "\n" + rows)
    made = Irregularity(
        spectrum="measured", file=str(path), level_column="right", left_column="left",
        lateral_column="across", wavelengths=(2.0, 60.0),
    )  # fmt: skip
    pair, at = both_rails(made), np.linspace(150.0, 250.0, 101)
    np.testing.assert_allclose(pair.level(0, "Z", at), 1e-3 * np.sin(at), atol=3e-5)
    np.testing.assert_allclose(pair.level(1, "Z", at), 1e-3 * np.cos(at), atol=3e-5)
    for rail in (0, 1):
        np.testing.assert_allclose(pair.level(rail, "Y", at), 1e-3 * np.sin(at / 2), atol=3e-5)
    with pytest.raises(InputError, match="nonsense"):
        both_rails(Irregularity(spectrum="measured", file=str(path), level_column="right",
                                left_column="nonsense"))  # fmt: skip


def test_coherence_out_of_range():
    for wrong in (-0.1, 1.1):
        with pytest.raises(InputError, match='at least 0 and at most 1, or "decaying"'):
            Irregularity(coherence=wrong)
    with pytest.raises(InputError, match='must be a number, or "decaying"'):
        Irregularity(coherence="some")
    with pytest.raises(InputError, match="applies only with coherence"):
        Irregularity(coherence=0.5, coherence_wavelength=2.0)

"""What Fig. 1 gets to show, and the warnings that come with an irregularity."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.irregularity import RepeatWarning, SmoothRail, paper_spectrum
from contactstudy.irregularity.shown import from_dataset, to_dataset
from contactstudy.reporter import Quiet
from contactstudy.study.kinds.passage.forecast import needs
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.roughness import describe, irregularity_of

SMOOTH = {"irregularity": {"spectrum": "smooth"}}
LONG = {"track": {"length": "480 m"}, "journey": {"to": "400 m"}}


def test_the_estimate_lies_on_the_formula():
    """Table 1: mean difference in dB over the band, but for Welch's bias at its lowest lines."""
    info = describe(parse_study("demo", {})).info
    inside = (info.estimate.wavenumber > 0.2) & (info.estimate.wavenumber < 19.9)
    ratio = info.estimate.density[inside] / paper_spectrum()(info.estimate.wavenumber[inside])
    print(f"generated against eq. (3): 0 dB ({10 * np.log10(ratio).mean():.3f} dB)")
    assert abs(10 * np.log10(ratio).mean()) < 0.3
    assert info.spectrum.label == "eq. (3), Table 1"
    assert info.profile.position[0] == 0.0 and info.profile.position[-1] == 36.0
    assert info.measured is None


def test_a_study_longer_than_the_repeat_is_warned_about_and_jitter_helps():
    (warning,) = describe(parse_study("long", LONG)).warnings
    assert "315.4 m" in warning and "jitter" in warning
    assert issubclass(RepeatWarning, UserWarning)
    jittered = LONG | {"irregularity": {"jitter": True}}
    assert describe(parse_study("long", jittered)).warnings == ()
    assert describe(parse_study("short", {})).warnings == ()


def test_a_smooth_run_and_a_smooth_study():
    study = parse_study("demo", {})
    assert isinstance(irregularity_of(study, smooth=True), SmoothRail)
    smooth = parse_study("demo", {"irregularity": {"spectrum": "smooth"}})
    assert isinstance(irregularity_of(smooth), SmoothRail)
    info = describe(smooth).info
    assert info.spectrum is None and info.estimate is None and info.profile is None


def test_a_sinusoid_is_its_cosine_and_has_no_spectrum():
    table = {"wavelength": "50 mm", "amplitude": "20 um", "phase": 0.3, "spectrum": "sinusoid"}
    described, x = describe(parse_study("demo", {"irregularity": table})), np.linspace(6, 7, 99)
    np.testing.assert_allclose(
        described.profile(x), 20e-6 * np.cos(2 * np.pi * x / 0.05 + 0.3), atol=1e-16
    )
    info = described.info
    assert info.spectrum is None and info.estimate is None
    assert np.ptp(info.profile.level) > 1.99 * 20e-6 and info.profile.label == "sinusoid, 50 mm"
    with pytest.raises(InputError, match="wavelength: applies only with spectrum"):
        parse_study("bad", {"irregularity": {"wavelength": "50 mm"}})


def test_lateral_runs_get_the_independent_transverse_profile():
    study, x = parse_study("demo", {}), np.linspace(0, 36, 1000)
    vertical, lateral = irregularity_of(study)(x), irregularity_of(study, direction="Y")(x)
    assert not np.allclose(vertical, lateral)


@pytest.mark.parametrize("name", ["german_low", "german_high", "fra6", "tbt3352"])
def test_other_spectra_by_name(name):
    info = describe(parse_study("demo", {"irregularity": {"spectrum": name}})).info
    assert info.spectrum.label != "eq. (3), Table 1" and info.estimate is not None


@pytest.mark.parametrize(
    ("spectrum", "default"), [("paper", "two"), ("german_low", "one"), ("tbt3352", "one")]
)
def test_sides_are_the_spectrums_own_unless_they_are_given(spectrum, default):
    own = parse_study("demo", {"irregularity": {"spectrum": spectrum}}).irregularity
    assert own.resolved()["sides"] == own.sides == default
    other = {"one": "two", "two": "one"}[default]
    given = parse_study("demo", {"irregularity": {"spectrum": spectrum, "sides": other}})
    x = np.linspace(0.0, 30.0, 100)
    ratio = np.sqrt(2.0) if other == "two" else np.sqrt(0.5)
    assert given.irregularity.profile()(x) == pytest.approx(ratio * own.profile()(x))
    assert "sides" not in parse_study("demo", SMOOTH).irregularity.resolved()
    with pytest.raises(InputError, match="sides: applies only with spectrum"):
        parse_study("demo", {"irregularity": {"spectrum": "smooth", "sides": "one"}})


def test_check_and_results_say_the_standard_deviation_by_band():
    study = parse_study("demo", {})
    assert "D1 (3 to 25 m)" in describe(study).info.profile.deviations
    assert from_dataset(to_dataset(describe(study).info)).profile.deviations
    assert any(
        "D1 (3 to 25 m)" in line for line in needs(study, (), Quiet()) if isinstance(line, str)
    )
    assert describe(parse_study("demo", SMOOTH)).info.profile is None


def written(path, spacing, level, n=1000):
    x = spacing * np.arange(n)
    rows = [f"{a:.4f},{b:.5f}" for a, b in zip(x, level(x), strict=True)]
    path.write_text("\n".join(["x,um", *rows]), "utf-8")
    table = {"spectrum": "measured", "file": str(path), "level_column": "um", "level_unit": "um"}
    journey = {"from": "6 m", "to": "30 m"}
    return {"irregularity": table, "journey": journey, "runs": {"p": {"solver": "point"}}}


def test_the_default_wavelengths_do_not_silently_drop_a_record(tmp_path):
    data = written(tmp_path / "r.csv", 0.005, lambda x: 5 * np.sin(2 * np.pi * x / 0.1), 12000)
    with pytest.raises(InputError, match=r"wavelengths: the default of 2\.5 to 42 m leave out 9"):
        describe(parse_study("demo", data))
    data["irregularity"]["wavelengths"] = ["20 mm", "1 m"]
    study = parse_study("demo", data)
    note = describe(study).warnings[0]
    assert "0.02 to 1 m leave out" in note
    x = np.linspace(8, 28, 999)
    assert irregularity_of(study)(x) == pytest.approx(5e-6 * np.sin(20 * np.pi * x), abs=5e-8)


def test_a_journey_beyond_what_is_sound_is_warned_of_and_zero_is_said(tmp_path):
    waves = written(tmp_path / "r.csv", 0.25, lambda x: 500 * np.sin(2 * np.pi * x / 10), 240)
    waves["irregularity"]["wavelengths"] = ["2.5 m", "20 m"]
    share, sound = describe(parse_study("demo", waves)).warnings
    assert "leave out" in share and "of X = 0 to 59.75 m only X = 20 to 39.75 m is sound" in sound
    zero = written(tmp_path / "z.csv", 0.25, np.zeros_like, 1000)
    described = describe(parse_study("demo", zero))
    assert "z.csv: the level is zero throughout: the rail is smooth" in described.warnings
    assert described.info.measured is None and not described.info.profile.level.any()
    flat = {"irregularity": {"spectrum": "sinusoid", "amplitude": 0.0}}
    assert "zero throughout" in describe(parse_study("demo", flat)).warnings[0]

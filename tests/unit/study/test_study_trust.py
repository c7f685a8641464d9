"""The map of trust: waves that mean nothing, and the measured roughness that is drawn in."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.contact.filters import Trajectory
from contactstudy.driver import compute_study
from contactstudy.exceptions import InputError
from contactstudy.irregularity.profile import HarmonicProfile
from contactstudy.study.kinds.passage.roughness import sharpness
from contactstudy.study.kinds.passage.roughness_table import RoughnessTable
from contactstudy.study.loading import base_of, load_study

SBB = Path(__file__).parents[3].parent / "shared" / "data" / "sbb_rail_roughness.csv"
SHORT = {"track.length": "7.2 m", "journey.from": "1.2 m"}
POINT = """
[irregularity]
spectrum = "sinusoid"
[track]
length = "7.2 m"
[journey]
from = "1.2 m"
[runs.point]
solver = "point"
[sweep]
"irregularity.wavelength" = [0.05, 1.0]
"irregularity.amplitude" = [5e-6, 3e-4]
"""


@pytest.mark.parametrize(("amplitude", "followed"), [(0.9, True), (1.1, False)])
def test_a_wheel_rests_on_two_crests_where_troughs_are_sharper(amplitude, followed):
    # amplitudes in lambda^2/(4 pi^2 R); in a trough the wheel touches there, or on both sides
    wave = 0.1
    height = amplitude * wave**2 / (4 * np.pi**2 * 0.43)
    values = SHORT | {"irregularity.wavelength": wave, "irregularity.amplitude": height}
    study = base_of(load_study("trust_map", values))
    assert sharpness(study) == pytest.approx(amplitude, rel=1e-12)
    profile = HarmonicProfile.wave(height, wave)
    ahead, _ = Trajectory(0.43).rest(profile, np.array([0.5 * wave, 1.5 * wave]))
    assert bool(np.all(np.abs(ahead) < 1e-4)) is followed


def test_waves_that_mean_nothing_are_left_out_and_no_failures(tmp_path):
    file = tmp_path / "waves.toml"
    file.write_text(POINT)
    results = compute_study(load_study(file), tmp_path, workers=1, here=True)
    data = results.designs["sweep"]
    assert not results.failures
    ((reason, count),) = results.metrics["left_out"].items()
    assert "two crests" in reason and count == 1  # 300 um at 50 mm
    largest = data["largest"].sel(run="point", signal="contact_force")
    gone = {"irregularity.wavelength": 0.05, "irregularity.amplitude": 3e-4}
    assert np.isnan(largest.sel(gone)) and int(largest.isnull().sum()) == 1
    assert str(data["failure"].sel(gone).values) == reason


def test_a_grid_of_nothing_else_is_refused(tmp_path):
    file = tmp_path / "waves.toml"
    file.write_text(POINT.replace("[0.05, 1.0]", "[0.02, 0.03]").replace("5e-6", "2e-4"))
    with pytest.raises(InputError, match="two crests"):
        compute_study(load_study(file), tmp_path, workers=1, here=True)


def table(tmp_path, text, **values):
    file = tmp_path / "levels.csv"
    file.write_text(text)
    return RoughnessTable(file=str(file), **values)


def test_levels_of_one_wavelength_are_averaged_by_energy(tmp_path):
    made = table(tmp_path, "wl,R\n10,0\n5,3\n10,10\n", wavelength_column="wl",
                 level_column="R", wavelength_unit="cm")  # fmt: skip
    assert made.levels() == [[0.05, pytest.approx(3.0)], [0.1, pytest.approx(10 * np.log10(5.5))]]
    assert RoughnessTable().levels() == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("wavelength,level\n0,3\n", "line 2.*above 0"),
        ("wavelength,level\n0.1,rough\n", "line 2"),
        ("wavelength,dB\n0.1,3\n", "no column 'level'"),
        ("wavelength,level\n", "row"),
    ],
)
def test_tables_that_cannot_be_used_are_refused(tmp_path, text, message):
    with pytest.raises(InputError, match=message):
        table(tmp_path, text).levels()


@pytest.mark.skipif(not SBB.is_file(), reason="measured roughness spectra are not at hand")
def test_measured_spectra_have_their_published_means():
    made = RoughnessTable(file=str(SBB), wavelength_column="wl", wavelength_unit="cm",
                          level_column="R")  # fmt: skip
    levels = dict(map(tuple, made.levels()))
    for wave, level in ((0.316228, 10.2), (0.199526, 0.2), (0.1, -4.4), (0.0501187, -7.3)):
        near = min(levels, key=lambda w: abs(w - wave))
        assert near == pytest.approx(wave, rel=1e-3)
        assert levels[near] == pytest.approx(level, abs=0.06)

"""Smooth twins of runs: shared by seeds, and the part of a signal that the irregularity causes."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.driver import compute_study
from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage.metrics import compare_runs
from contactstudy.study.loading import load_study
from contactstudy.study.plan import plan_study

SHORT = """
[journey]
from = "6 m"
to = "7.5 m"
fade_in = "0.3 m"
[runs.fine]
solver = "point"
elements_per_bay = 8
[runs.point]
solver = "point"
k_r = "2 GN/m"
[compare]
reference = "fine"
smooth = true
"""


@pytest.fixture
def short(tmp_path):
    path = tmp_path / "short.toml"
    path.write_text(SHORT)
    return path


def test_norms_of_the_irregularitys_part_against_runs_by_hand(short, tmp_path):
    results = compute_study(load_study(short), tmp_path, 1)
    smooth = {"compare.smooth": False, "irregularity.spectrum": "smooth"}
    on_smooth = compute_study(load_study(short, smooth), tmp_path, 1).runs
    x = results.runs["fine"].position.values
    behind = x >= 6.3 - 1e-9
    part = {n: results.runs[n].contact_force.values - r.contact_force.values
            for n, r in on_smooth.items()}  # fmt: skip
    difference = (part["point"] - part["fine"])[behind]
    expected = np.sqrt(
        np.trapezoid(difference**2, x[behind]) / np.trapezoid(part["fine"][behind] ** 2, x[behind])
    )
    found = results.metrics["comparisons"]["point"]["contact_force"]
    assert found["relative_l2_irregularity"] == pytest.approx(expected, rel=1e-9)
    assert found["relative_l2_irregularity"] != pytest.approx(found["relative_l2_dynamic"])
    assert list(results.runs) == ["fine", "point"]
    assert found["sprague_geers_irregularity"]["M"] is not None


def test_a_gain_of_the_irregularitys_part_alone():
    x = np.linspace(0, 10, 1001)
    passing, wave = 3e3 * np.sin(2 * np.pi * x / 0.6), 5e3 * np.sin(2 * np.pi * x)

    def run(gain):
        data = {"contact_force": 6e4 + passing + gain * wave, "contact_force_smooth": 6e4 + passing}
        coords = {"time": x / 50, "position": ("time", x)}
        return xr.Dataset({n: ("time", v) for n, v in data.items()}, coords)

    found = compare_runs(run(1.1), run(1.0), 0.0)["contact_force"]
    assert found["relative_l2_irregularity"] == pytest.approx(0.1, rel=1e-9)
    assert found["sprague_geers_irregularity"]["M"] == pytest.approx(0.1, rel=1e-9)
    assert found["relative_l2_dynamic"] < 0.09


def test_seeds_share_their_twins(short, tmp_path):
    study = load_study(short, sweep={"irregularity.seed": "1 to 5"})
    plan = plan_study(study, tmp_path)
    names = [piece.work.name for piece in plan.pieces]
    assert sorted(set(names)) == ["fine", "fine.smooth", "point", "point.smooth"]
    assert names.count("fine") == 5 and names.count("fine.smooth") == 1
    # another stiffness of one run: its own twin only
    study = load_study(short, sweep={"runs.point.k_r": ["1 GN/m", "2 GN/m", "tangent"]})
    names = [piece.work.name for piece in plan_study(study, tmp_path).pieces]
    assert (names.count("fine"), names.count("fine.smooth")) == (1, 1)
    assert names.count("point.smooth") == 3


def test_a_smooth_run_has_no_twin_and_values_are_checked(short, tmp_path):
    study = load_study(short, {"runs.point.irregularity": "smooth"})
    names = [piece.work.name for piece in plan_study(study, tmp_path).pieces]
    assert names == ["fine", "point", "fine.smooth"]
    with pytest.raises(InputError, match=r"compare\.smooth = 3"):
        load_study(short, {"compare.smooth": 3})

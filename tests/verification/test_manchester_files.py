"""The Manchester benchmark's wheel and rail from the field's own files, by a study file."""

from pathlib import Path

import pytest

from contactstudy.study.kinds.positions.press import press_one
from contactstudy.study.loading import load_study

SHARED = Path(__file__).parents[2].parent / "shared" / "data" / "profiles"
STUDY = """
[positions]
wheels = ["right"]
load = "10 kN"
wheel_profile = "{folder}/MBench_S1002_v3.prw"
rail_profile = "{folder}/MBench_UIC60_v3{suffix}"
wheel_radius = "460 mm"
rail_inclination = 0.0  # the rail's file is inclined already
gauge = "1435 mm"
gauge_depth = "14 mm"
flange_backs = "1360 mm"
tape_line = "70 mm"
youngs_modulus = "209.92 GPa"
poisson_ratio = 0.28
"""


@pytest.mark.parametrize("suffix", [".ban", ".prr"])
def test_the_centred_wheelset(tmp_path, suffix):
    """338.3 MPa, 15.96 um and 51.64 mm^2 at y = 8.66 mm are CONTACT 25.2's published figures.

    Its vertical load includes that of friction, and its grid and ours are 0.2 mm: 0.3 %.
    """
    if not SHARED.is_dir():
        pytest.skip("sample profiles are not on this machine")
    file = tmp_path / "pair.toml"
    file.write_text(STUDY.format(folder=SHARED, suffix=suffix))
    study = load_study(file)
    (name,) = (w.name for w in _work(study))
    (patch,) = press_one(study, name)
    assert patch["peak_pressure"] == pytest.approx(338.3e6, rel=3e-3)
    assert patch["approach"] == pytest.approx(15.96e-6, rel=3e-3)
    assert patch["area"] == pytest.approx(51.64e-6, rel=0.02)
    assert patch["y"] == pytest.approx(-8.66e-3, abs=0.03e-3)


def _work(study):
    from contactstudy.study.kinds.positions.kind import POSITIONS

    return POSITIONS.work(study, POSITIONS.read_inputs(study))

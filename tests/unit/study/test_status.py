"""contactstudy status: what is done, failed and left."""

import pytest

from contactstudy import cli
from contactstudy.driver import run_study
from contactstudy.study.loading import load_study


def told(capsys, out):
    assert cli.main(["status", str(out)]) == 0
    return capsys.readouterr().out.splitlines()


def test_status_of_a_sweep(law, tmp_path, capsys):
    path, out = law('[sweep]\n"law.x" = "1 m to 5 m by 1 m"\n', "breaks_at = 3"), tmp_path / "out"
    run_study(load_study(path), out, 1)
    lines = told(capsys, out)
    assert lines[0] == "runs: 5 of 6 done, 1 failed"
    assert lines[1] == "variants: 4 of 5 have all their runs, 1 failed"
    assert lines[2] == "failed: run power (x = 3): x = 3 m breaks down"
    assert lines[3].startswith("left: 1 run, about 1 s with 1 at a time")
    for entry in (out / "runs").glob("power-*"):
        entry.unlink()
    assert told(capsys, out)[0] == "runs: 1 of 6 done, 1 failed"
    law('[sweep]\n"law.x" = "1 m to 5 m by 1 m"\n')
    run_study(load_study(path), out, 1, overwrite=True)
    assert told(capsys, out) == [
        "runs: 6 of 6 done, 0 failed",
        "variants: 5 of 5 have all their runs, 0 failed",
        "nothing is left to compute; results are written",
    ]
    (out / "result.nc").unlink()
    assert "results are still to be written" in told(capsys, out)[-1]


def test_status_of_a_study_without_axes_and_its_companions(law, tmp_path, capsys):
    law("", name="inner")
    path = tmp_path / "main.toml"
    path.write_text('companions = ["inner.toml"]\n[irregularity]\nspectrum = "smooth"\n')
    run_study(load_study(path), tmp_path / "out", 1)
    assert told(capsys, tmp_path / "out")[0] == "runs: 2 of 2 done, 0 failed"


def test_no_study_was_begun(tmp_path, capsys):
    assert cli.main(["status", str(tmp_path)]) == 2
    assert "no study was begun here" in capsys.readouterr().err


@pytest.mark.parametrize(("took", "expected"), [(120.0, "4 min"), (7200.0, "4.0 h")])
def test_the_time_left_follows_from_what_others_took(law, tmp_path, capsys, took, expected):
    """Four are left, two at a time, each like the one that is done."""
    path, out = law('[sweep]\n"law.seed" = "1 to 5"\n'), tmp_path / "out"
    run_study(load_study(path), out, 1)
    slips = sorted((out / "runs").glob("power-*.json"))
    for slip in slips[1:]:
        slip.with_suffix(".npz").unlink()
    text = slips[0].read_text()
    start = text.index('"seconds": {')
    end = text.index("}", start)
    seconds = f'"seconds": {{"setup": 0.0, "stepping": {took}'
    slips[0].write_text(text[:start] + seconds + text[end:])
    plan = out / "runs/plan.json"
    plan.write_text(plan.read_text().replace('"workers": 1', '"workers": 2'))
    assert told(capsys, out)[-1] == f"left: 4 runs, about {expected} with 2 at a time"

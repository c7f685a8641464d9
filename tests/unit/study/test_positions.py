"""Studies of positions: the table, the command, kept positions, results, report."""

import csv
import json
import math
import shutil
import subprocess

import numpy as np
import pytest

import contactstudy as cs
from contactstudy import cli
from contactstudy.driver import run_study
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.profiles.named import wheel_curve
from contactstudy.reporter import Quiet
from contactstudy.study.kinds.positions.check import check_positions
from contactstudy.study.kinds.positions.kind import POSITIONS
from contactstudy.study.kinds.positions.table import Positions
from contactstudy.study.loading import load_study
from contactstudy.study.results import open_results

HERTZ = """
title = "A cylinder on the crown"
[positions]
lateral = ["0 mm", "1 mm"]
roll = 0
wheels = ["right"]
wheel_profile = "cylinder"
rail_inclination = 0
wheel_radius = "460 mm"
load = "67.4 kN"
cell = "0.5 mm"
"""


@pytest.fixture
def study(tmp_path):
    path = tmp_path / "crown.toml"
    path.write_text(HERTZ)
    return path


def test_series():
    def read(lateral):
        return Positions(lateral=lateral, roll=0).lateral

    assert read("0 mm to 10 mm by 0.5 mm") == tuple(round(0.5e-3 * k, 6) for k in range(21))
    assert read("10 mm to 0 mm by -5 mm") == (0.01, 0.005, 0.0)
    assert read(["1 mm", 0.002]) == (0.001, 0.002) and read("3 mm") == (0.003,)
    assert read(np.array([0.001, 0.002])) == (0.001, 0.002)
    for wrong in ("0 mm to 1 mm by 0.3 mm", "0 mm to 1 mm by 0 mm", "0 to 1 by -1", [], b"12"):
        with pytest.raises(InputError):
            read(wrong)
    with pytest.raises(InputError, match=r"at least -0.1 and at most 0.1 m"):
        read("0 m to 1 m by 0.5 m")


def test_shipped_study_is_the_benchmark():
    study = load_study("manchester")
    assert len(study.positions) == 21 and study.table.wheels == ("left", "right")
    assert study.positions[10][:2] == (0.005, 0.012)
    assert study.table.rail_inclination == math.atan(1 / 40)
    assert study.modulus == pytest.approx(82e9 / 0.72)
    assert study.kind == "positions" and load_study("smooth_rail").kind == "passage"


def test_every_problem_at_once(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(
        'journey = 1\n[positions]\nlateral = ["0 mm", "1 mm"]\nyaw = [0, 1e-3, 2e-3]\n'
        'wheel_profile = "S1003"\nrail_profile = "gone.csv"\nrail_inclinaton = "1:40"\n'
    )
    with pytest.raises(InputError) as error:
        load_study(path)
    text = str(error.value)
    assert "journey: unknown key" in text
    assert "rail_inclinaton: unknown key (did you mean 'rail_inclination'?)" in text
    path.write_text(path.read_text().replace('rail_inclinaton = "1:40"\n', 'load = "5 kg"\n'))
    with pytest.raises(InputError, match="wrong unit 'kg'"):
        load_study(path)
    path.write_text(path.read_text().replace('load = "5 kg"\n', ""))
    with pytest.raises(InputError) as error:
        load_study(path)
    text = str(error.value)
    assert "positions.yaw: has 3 values; must have one, or one for each of the 2" in text
    assert "positions.wheel_profile" in text and "S1003" in text
    assert f"positions.rail_profile: {tmp_path / 'gone.csv'}" in text


def test_cylinder_on_the_crown_is_hertz(study, tmp_path):
    loaded = load_study(study)
    data = run_study(loaded, tmp_path / "out", workers=1).runs["right"]
    exact = hertz_contact(67.4e3, contact_modulus(), 0.46, 0.3)
    print(f"Hertz {exact}\ncomputed {data.isel(row=0)}")
    assert data.sizes["row"] == 2
    for row in range(2):  # the cylinder does not feel the shift
        assert float(data.approach[row]) == pytest.approx(exact.approach, rel=5e-3)
        assert float(data.peak_pressure[row]) == pytest.approx(exact.peak_pressure, rel=5e-3)
        assert float(data.area[row]) == pytest.approx(exact.area, rel=0.03)
        assert float(data.along[row]) == pytest.approx(exact.semi_axis_x, rel=5e-3)
        assert float(data.y[row]) == pytest.approx(0.0, abs=1e-6)


class Counting(Quiet):
    """Reporter that counts presses."""

    presses = 0

    def progress(self, name, done, total):
        self.presses = done if name == "positions" else self.presses


def test_positions_are_kept(study, tmp_path):
    loaded, out = load_study(study), tmp_path / "out"

    def run():
        reporter = Counting()
        return run_study(loaded, out, 2, reporter), reporter.presses

    first, presses = run()
    before = (out / "result.nc").read_bytes()
    assert presses == 2 and run()[1] == 0 and (out / "result.nc").read_bytes() == before
    kept = sorted((out / "runs").glob("right_*.json"))[0]
    kept.write_text(kept.read_text()[:-30])  # damaged
    (out / "result.nc").unlink()
    again, presses = run()
    assert again.runs["right"].equals(first.runs["right"]) and presses == 1
    assert (out / "result.nc").read_bytes() == before
    read = open_results(out)["right"]
    assert read.peak_pressure.attrs["units"] == "Pa" and list(read.wheel.values) == ["right"] * 2
    with (out / "patches.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    np.testing.assert_allclose([float(r["approach [m]"]) for r in rows], read.approach)
    metrics = json.loads((out / "metrics.json").read_text())["runs"]["right"]
    assert metrics["patches"] == 2 and metrics["largest"]["area"] == float(read.area.max())
    assert metrics["seconds"]["stepping"] > 0


def test_a_worn_profile_from_a_file_beside_the_study(tmp_path):
    curve = wheel_curve("S1002")
    points = 1e3 * curve.point(np.arange(curve.s_range[0] + 1e-3, curve.s_range[1] - 1e-3, 5e-4))
    rows = "\n".join(f"{y:.6f},{z:.6f}" for y, z in points)
    (tmp_path / "worn.csv").write_text(f"y [mm],z [mm]\n{rows}\n")
    path, found = tmp_path / "worn.toml", []
    for profile in ("S1002", "worn.csv"):
        path.write_text(
            f'[positions]\nroll = 0\nwheels = ["left"]\nwheel_profile = "{profile}"\ncell = 5e-4\n'
        )
        found.append(run_study(load_study(path), tmp_path / f"out_{len(found)}"))
    drawn, worn = (results.runs["left"] for results in found)
    print(
        f"approach: drawn {float(drawn.approach[0]):.6e}, its points {float(worn.approach[0]):.6e}"
    )
    assert float(worn.approach[0]) == pytest.approx(float(drawn.approach[0]), rel=5e-3)
    assert found[1].config["positions"]["wheel_profile"] == "worn.csv"  # no folder of this machine
    assert list(found[1].provenance["files"]) == ["worn.csv"]


def test_a_press_that_breaks_down_says_where(study, tmp_path, monkeypatch):
    (tmp_path / "breaking_press.py").write_text(
        "from contactstudy.exceptions import NumericalError\n"
        "from contactstudy.study.kinds.positions import press\n"
        "def breaking(*_, **__):\n"
        "    raise NumericalError('does not settle')\n"
        "def press_one(study, name, progress):\n"
        "    if name == 'right_002':\n"
        "        press.press_wheel = breaking\n"
        "    return press.press_one(study, name, progress)\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(type(POSITIONS), "computing", "breaking_press:press_one")
    with pytest.raises(NumericalError, match=r"^right wheel at 1 mm and 0 mrad: does not settle"):
        run_study(load_study(study), tmp_path / "out")
    assert len(list((tmp_path / "out" / "runs").glob("right_*.json"))) == 1  # the first is kept


def test_impossible_positions_are_all_found_before_any_is_pressed(tmp_path, capsys):
    path, out = tmp_path / "far.toml", tmp_path / "out"
    path.write_text(
        '[positions]\nlateral = ["0 mm", "1 mm", "30 mm"]\nroll = 0\nwheels = ["right"]\n'
        'load = "1 GN"\n'
    )
    told = []
    for command in (["check", str(path)], ["run", str(path), "--out", str(out)]):
        assert cli.main(command) == 2
        told.append(capsys.readouterr().err)
    assert told[0] == told[1] and len(told[0].splitlines()) == 2
    for where, what in (
        ("0 mm with a yaw of 0 mrad (and at 1 more)", "positions.load = 1e+09 N: presses"),
        ("30 mm with a yaw of 0 mrad", "stands on its rail with the flange's tip"),
    ):
        lines = [x for x in told[0].splitlines() if f"positions.lateral = {where}: " in x]
        assert len(lines) == 1 and what in lines[0]
    assert not list((out / "runs").glob("right_*.json"))


def test_no_roll_at_rest_is_found_by_the_check(tmp_path):
    path = tmp_path / "far.toml"
    path.write_text(HERTZ.replace("roll = 0\n", "").replace('"1 mm"]', '"90 mm"]'))
    with pytest.raises(InputError, match=r"positions\.lateral = 90 mm with a yaw of 0 mrad: "):
        check_positions(load_study(path))


def test_commands(study, tmp_path, capsys):
    out = tmp_path / "out"
    assert cli.main(["check", str(study)]) == 0
    assert "positions.load" in (text := capsys.readouterr().out) and "2 presses" in text
    assert cli.main(["run", str(study), "--out", str(out), "--set", "positions.load=50 kN"]) == 0
    text = capsys.readouterr().out
    assert "A cylinder on the crown: right wheel" in text and " 50.0" in text
    if (reader := shutil.which("pdftotext")) is not None:
        made = subprocess.run([reader, "-layout", out / "report.pdf", "-"], capture_output=True)
        text = made.stdout.decode()
        assert "A cylinder on the crown" in text and "peak (MPa)" in text
    assert (out / "figures" / "positions.png").is_file()
    assert cli.main(["run", str(study), "--out", str(out), "--set", "positions.lod=5"]) == 2
    assert "positions.lod: unknown key" in capsys.readouterr().err
    assert cli.main(["studies"]) == 0
    assert "manchester " in capsys.readouterr().out


def test_positions_over_loads_follow_hertz(study, tmp_path):
    """Peak pressure over the load as F^(1/3), approach as F^(2/3); figures and report are there."""
    loads = [2e4, 1.6e5]
    data = cs.sweep(study, {"positions.load": loads}, out=tmp_path / "out", workers=1)
    for name, power in (("peak_pressure", 1 / 3), ("approach", 2 / 3)):
        found = data[f"{name}_largest"]
        assert found.dims == ("positions.load", "run")
        assert found[1] / found[0] == pytest.approx(8**power, rel=0.02)
    figures = {path.stem for path in (tmp_path / "out/figures").glob("*.pdf")}
    assert "sweep_peak_pressure_largest" in figures
    assert (tmp_path / "out/report.pdf").is_file()


def test_a_refinement_of_the_cells_closes_in_on_hertz(study, tmp_path):
    """Cells of the half-space: the band about the finest approach holds that of Hertz."""
    cells = '[refine]\n"positions.cell" = ["1 mm", "0.7 mm", "0.5 mm", "0.35 mm"]\n'
    study.write_text(HERTZ.replace('["0 mm", "1 mm"]', '["0 mm"]') + cells)
    results = run_study(load_study(study), tmp_path / "out", 1)
    data = results.designs["refine.positions.cell"].isel(run=0)
    exact = hertz_contact(67.4e3, contact_modulus(210e9, 0.3), 0.46, 0.3).approach
    approach = data["approach_largest"].values
    band = float(data["approach_largest_uncertainty"])
    print(f"Hertz {1e6 * exact:.4f} um, cells {1e6 * approach}, band {1e6 * band:.4f} um")
    assert abs(approach[-1] / exact - 1.0) < abs(approach[0] / exact - 1.0) < 0.02
    assert abs(approach[-1] - exact) <= band < 0.02 * exact
    assert str(data["approach_largest_verdict"].item())
    assert (tmp_path / "out/figures/refine_positions_cell_convergence.pdf").is_file()

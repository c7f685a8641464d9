"""Folders that already hold something: other results, files for folders, what is made no longer."""

import json

import pytest
from short_study import HERTZ
from short_study import POINT as SHORT

from contactstudy import cli, driver
from contactstudy.study import earlier
from contactstudy.study.overrides import flat
from contactstudy.study.results import read_results


def render(results, out_dir, reporter):
    """Stands for figures and report: a figure a run."""
    made = [out_dir / "figures" / f"{name}.pdf" for name in results.runs]
    for file in made:
        file.parent.mkdir(exist_ok=True)
        file.write_bytes(b"%PDF")
    return made


@pytest.fixture
def run(tmp_path, monkeypatch, capfd):
    """Exit status and messages of `run` in one folder; drawing is left out."""
    monkeypatch.setattr(driver, "render", render)
    file = tmp_path / "short.toml"

    def call(*options: str, text: str = SHORT) -> tuple[int, str]:
        file.write_text(text)
        command = ["run", str(file), "--out", str(tmp_path / "out"), "--workers", "1", *options]
        return cli.main(command), capfd.readouterr().err

    return call


def files(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*.*")}


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--set", "journey.speed=200 km/h"], "journey.speed is 83.3333 m/s there and 55.5556 m/s"),
        (["--set", "runs.point.law=hertz"], "runs.point.k_r is set only there"),
        (["--sweep", "irregularity.seed=1 to 2"], "sweep.irregularity.seed is set only here"),
    ],
)
def test_other_results_are_not_written_over(run, tmp_path, options, told):
    assert run()[0] == 0
    before = files(tmp_path / "out")
    status, err = run(*options)
    assert status == 2 and f"{tmp_path / 'out'}: holds other results: " in err and told in err
    assert "another folder with --out, or replace them with --overwrite" in err
    assert files(tmp_path / "out") == before
    assert run(*options, "--overwrite")[0] == 0
    assert "all results are there and up to date" in run(*options)[1]
    assert run()[0] == 2


def test_more_runs_hold_the_earlier_ones_too(run, tmp_path):
    more = SHORT + HERTZ
    assert run()[0] == 0 and run(text=more)[0] == 0
    assert (tmp_path / "out" / "figures" / "hertz.pdf").exists()
    assert "runs.hertz.solver is set only there" in run()[1]
    (tmp_path / "out" / "figures" / "mine.pdf").write_bytes(b"mine")
    assert run("--overwrite")[0] == 0
    left = {p.name for p in (tmp_path / "out" / "figures").iterdir()}
    assert left == {"point.pdf", "mine.pdf"}  # what is made no longer went, what is not ours stays
    assert list(read_results(tmp_path / "out").runs) == ["point"]


def test_title_and_program_may_change(run, tmp_path, monkeypatch):
    assert run()[0] == 0
    assert run(text='title = "Another"\n' + SHORT)[0] == 0
    # an older version knew another key, and not all of today's
    monkeypatch.setattr(earlier, "code_digest", lambda: "another program")
    monkeypatch.setattr(earlier, "_plain", lambda config: {**config, "new": {"key": 1}})
    assert run("--set", "journey.speed=200 km/h")[0] == 2
    assert run()[0] == 0
    assert flat({"a": {"b": 1}, "c": [2]}) == {"a.b": 1, "c": [2]}


def test_a_study_that_was_not_finished_is_not_in_the_way(run, tmp_path, monkeypatch):
    def interrupt(*arguments):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(driver, "write_results", interrupt)
        assert run()[0] == 130
    assert list((tmp_path / "out" / "runs").glob("point-*.npz"))
    assert run("--set", "journey.speed=200 km/h")[0] == 0


def test_damaged_results_give_way(run, tmp_path):
    assert run()[0] == 0
    (tmp_path / "out" / "result.nc").write_bytes(b"no longer HDF5")
    assert run("--set", "journey.speed=200 km/h")[0] == 0


def test_changed_input_files_are_another_configuration(run, tmp_path):
    level = tmp_path / "level.csv"
    rows = [f"{0.25 * k},{(k * 7919 % 101) / 100}" for k in range(200)]
    level.write_text("x,level\n" + "\n".join(rows))
    table = f'spectrum = "measured"\nfile = {json.dumps(str(level))}\nlevel_column = "level"'
    options = 'level_unit = "mm"\nwavelengths = ["0.6 m", "3 m"]'
    text = SHORT.replace("terms = 50", f"{table}\n{options}")
    status, err = run(text=text)
    assert status == 0, err
    level.write_text("x,level\n" + "\n".join([*rows[:-1], "49.75,0.1"]))
    status, err = run(text=text)
    assert status == 2 and "the file" in err and "level.csv has changed" in err


@pytest.mark.parametrize("name", ["figures", "runs", "result.nc", "report.pdf", "metrics.json"])
def test_what_is_in_the_way_is_said_before_anything_runs(run, tmp_path, name):
    (tmp_path / "out").mkdir()
    if "." in name:
        (tmp_path / "out" / name).mkdir()
    else:
        (tmp_path / "out" / name).write_text("a file")
    status, err = run()
    assert status == 2 and f"contactstudy: {tmp_path / 'out' / name}: is a " in err
    assert "Traceback" not in err and not list((tmp_path / "out").glob("runs/*"))


def test_a_file_as_folder(run, tmp_path):
    (tmp_path / "out").write_text("a file")
    status, err = run()
    assert status == 2 and "a part of its path is a file" in err

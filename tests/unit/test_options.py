"""Options that commands share, JSON for other programs, completion for shells."""

import json
import shutil
import subprocess

import pytest
from short_study import HERTZ, POINT

from contactstudy import cli, driver
from contactstudy.reporter import Quiet
from contactstudy.study.loading import load_study
from contactstudy.study.terminal import check_study

POINT_RUN = POINT.replace('to = "3 m"', 'to = "2.4 m"') + 'k_r = "1 GN/m"\n'
SHORT = 'title = "A short one"' + POINT_RUN + HERTZ


@pytest.fixture
def short(tmp_path, monkeypatch):
    """Study file; drawing is left out."""
    monkeypatch.setattr(driver, "render", lambda results, out, reporter: [])
    path = tmp_path / "short.toml"
    path.write_text(SHORT, "utf-8")
    return str(path)


def test_check_as_json_is_what_the_study_says(short, capfd):
    assert cli.main(["check", short, "--set", "journey.speed=180 km/h", "--json"]) == 0
    told = json.loads(capfd.readouterr().out)
    study = load_study(short, ["journey.speed=180 km/h"])
    assert told["config"] == json.loads(json.dumps(study.config()))
    assert told["config"]["journey"]["speed"] == 50.0 and told["units"]["journey.speed"] == "m/s"
    assert told["warnings"] == list(check_study(study, Quiet()).warnings)
    (sizes,) = (item for item in told["needs"] if isinstance(item, list))
    assert [row["run"] for row in sizes] == ["point", "hertz"]
    assert told["expected_seconds"] > 0.0


def test_run_as_json_is_the_metrics_file(short, tmp_path, capfd):
    out = tmp_path / "out"
    assert cli.main(["run", short, "--out", str(out), "--json"]) == 0
    told = json.loads(capfd.readouterr().out)
    assert told["metrics"] == json.loads((out / "metrics.json").read_text("utf-8"))
    assert (told["out"], told["failures"], told["title"]) == (str(out), {}, "A short one")


def test_quiet_says_nothing_and_verbose_more(short, tmp_path, capfd):
    assert cli.main(["run", short, "--out", str(tmp_path / "a"), "--quiet"]) == 0
    assert capfd.readouterr() == ("", "")
    assert cli.main(["run", short, "--out", str(tmp_path / "b"), "-v"]) == 0
    told = capfd.readouterr()
    assert "point: begins" in told.err and "hertz: done after" in told.err
    assert "A short one" in told.out
    assert cli.main(["check", short, "-q", "-v"]) == 2
    assert "only one of them" in capfd.readouterr().err
    assert cli.main(["check", short, "-q", "--set", "track.length=-1"]) == 2
    assert "track.length" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("typed", "completed"),
    [
        ("contactstudy rep", "reproduce"),
        ("contactstudy run --work", "--workers"),
        ("contactstudy check mi", "mine.toml"),
        ("contactstudy new other.toml --like mi", "mine.toml"),
    ],
)
def test_bash_completes_commands_options_and_files(typed, completed, tmp_path, capfd):
    if not (bash := shutil.which("bash")):
        pytest.skip("there is no bash")
    assert cli.main(["completion", "bash"]) == 0
    (tmp_path / "completion.sh").write_text(capfd.readouterr().out, "utf-8")
    (tmp_path / "mine.toml").touch()
    words = typed.split()
    script = (
        f"source {tmp_path / 'completion.sh'}; COMP_WORDS=({typed}); "
        f"COMP_CWORD={len(words) - 1}; COMP_LINE='{typed}'; COMP_POINT={len(typed)}; "
        f'_contactstudy contactstudy {words[-1]} {words[-2]}; echo "${{COMPREPLY[@]}}"'
    )
    told = {"capture_output": True, "text": True, "check": True, "cwd": tmp_path}
    made = subprocess.run([bash, "-c", script], **told)
    assert completed in made.stdout.split()
    assert made.stderr == ""


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_get_a_script(shell, capfd):
    assert cli.main(["completion", shell]) == 0
    assert "contactstudy" in capfd.readouterr().out

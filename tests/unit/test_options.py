"""Options that commands share, JSON for other programs, completion for shells."""

import json
import os
import pty
import select
import shutil
import subprocess
import time

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


COMPLETED = {
    "contactstudy rep": "contactstudy reproduce",
    "contactstudy run --work": "contactstudy run --workers",
    "contactstudy check mi": "contactstudy check mine.toml",
    "contactstudy run wheel_mo": "contactstudy run wheel_models",
    "contactstudy reproduce ladder wheel_mo": "contactstudy reproduce ladder wheel_models",
    "contactstudy new mine.toml --like wheel_mo": "contactstudy new mine.toml --like wheel_models",
    "contactstudy verify short_w": "contactstudy verify short_waves",
}
INTERACTIVE = {"bash": ("--norc", "--noprofile", "-i"), "zsh": ("-f", "-i")}


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_complete_commands_options_files_and_names(shell, tmp_path, monkeypatch, capfd):
    if not (program := shutil.which(shell)):
        pytest.skip(f"there is no {shell}")
    assert cli.main(["completion", shell]) == 0
    (tmp_path / "completion").write_text(capfd.readouterr().out, "utf-8")
    (tmp_path / "mine.toml").touch()
    monkeypatch.chdir(tmp_path)
    if shell == "fish":
        for typed, whole in COMPLETED.items():
            asked = [program, "-N", "-c", f"source ./completion; complete -C '{typed}'"]
            made = subprocess.run(asked, capture_output=True, text=True, check=True)
            found = [line.partition("\t")[0] for line in made.stdout.splitlines()]
            assert (found, made.stderr) == ([whole.split()[-1]], "")
    else:
        found = tabbed([program, *INTERACTIVE[shell]], "source ./completion", list(COMPLETED))
        assert found == list(COMPLETED.values())


def tabbed(shell, setup, lines):
    """What lines are to an interactive shell when the tabulator is pressed at their ends."""
    process, terminal = pty.fork()
    if process == 0:
        os.execv(shell[0], shell)
    # the mark of the end is not in what is typed, which the terminal shows as well
    shown = "contactstudy() { printf '<<%s>''>' \"contactstudy $*\"; }"
    os.write(terminal, f"{setup}; {shown}; printf '<<ready>''>'\n".encode())
    told = [answer(terminal)]
    for line in lines:
        os.write(terminal, f"{line}\t\n".encode())
        told.append(answer(terminal))
    os.write(terminal, b"exit\n")
    os.close(terminal)
    os.waitpid(process, 0)
    assert told[0] == "ready"
    return told[1:]


def answer(terminal):
    got, end = b"", time.monotonic() + 60
    while b">>" not in got and time.monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            got += os.read(terminal, 4096)
    return got.rpartition(b">>")[0].rpartition(b"<<")[2].decode().strip()

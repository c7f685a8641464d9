"""The names that ``import contactstudy as cs`` gives, and README's snippets."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import contactstudy as cs
from contactstudy import cli
from contactstudy.exceptions import InputError

SNIPPETS = re.findall(
    r"```python\n(.*?)```", (Path(__file__).parents[2] / "README.md").read_text("utf-8"), re.DOTALL
)
SHORT = {
    "journey.from": "3 m",
    "journey.to": "3.4 m",
    "journey.fade_in": "0.1 m",
    "track.length": "6 m",
}


ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=[page.name for page in PAGES])
def test_links_of_the_pages_lead_somewhere(page):
    text = page.read_text("utf-8")
    links = [link for link in re.findall(r"\]\(([^)#]+)\)", text) if "://" not in link]
    links = [link for link in links if not link.startswith(("reference/", "book/"))]  # generated
    assert all((page.parent / link).exists() for link in links), links
    assert "\t" not in text and max(map(len, text.splitlines())) < 250


def test_the_readme_is_short():
    assert len((ROOT / "README.md").read_text("utf-8").splitlines()) <= 120


def test_every_name_is_there():
    for name in cs.__all__:
        assert getattr(cs, name) is not None
    assert set(cs.__all__) <= set(dir(cs))


def test_unknown_names_are_refused():
    with pytest.raises(AttributeError, match="surface_contacts"):
        cs.surface_contacts  # noqa: B018


@pytest.mark.parametrize("code", SNIPPETS, ids=["study", "sweep", "solvers"])
def test_snippets_of_the_readme(code, tmp_path):
    """As a script, without a guard for the worker processes."""
    script = tmp_path / "snippet.py"
    script.write_text(code, "utf-8")
    made = subprocess.run(
        [sys.executable, script], capture_output=True, check=False, text=True, timeout=500
    )
    assert made.returncode == 0, made.stderr
    assert made.stdout


def test_surface_contact_takes_ten_lines_at_most():
    assert all(len(code.strip().splitlines()) <= 10 for code in SNIPPETS)


def test_a_study_runs_without_writing_and_is_found_again(tmp_path, monkeypatch):
    monkeypatch.setenv("CONTACTSTUDY_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    study = tmp_path / "mine.toml"
    study.write_text('[runs.point]\nsolver = "point"\n', "utf-8")
    results = cs.run(study, SHORT | {"irregularity.seed": 2})
    assert list(results.runs) == ["point"]
    assert "Group: /point" in repr(results)
    assert "point" in results._repr_html_()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cache", "mine.toml"]
    kept = {path: path.stat().st_mtime_ns for path in (tmp_path / "cache" / "runs").iterdir()}
    again = cs.run(cs.load(study, SHORT | {"irregularity.seed": 2}))
    assert again.runs["point"].equals(results.runs["point"])
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    written = cs.run(study, SHORT | {"irregularity.seed": 2}, out=tmp_path / "out")
    for read in (cs.open, cs.open_results):
        assert read(tmp_path / "out")["point"].to_dataset().equals(written.tree["point"].ds)


def test_values_are_checked_as_those_of_a_file():
    with pytest.raises(InputError) as error:
        cs.load("point_vs_surface", {"journey.to": "40 m", "track.pad_stifness": 1.0})
    assert "track.pad_stifness: unknown key" in str(error.value)
    assert "journey.to = 40" in str(error.value)


def test_check_prints_the_resolved_values(capsys):
    cs.check(
        "manchester", {"positions.lateral": [0.0], "positions.yaw": 0.0, "positions.roll": 0.0}
    )
    assert "positions.gauge" in capsys.readouterr().out


def test_a_track_of_the_wrong_type_names_the_right_one():
    contact = cs.SurfaceContact(cs.meshed_wheel())
    with pytest.raises(InputError, match=r"give a SolidTrack, such as contactstudy.meshed_track"):
        cs.surface_contact(cs.Track(), contact, cs.wheel_column(), cs.SmoothRail(), cs.Journey())


def test_what_is_no_study_is_refused():
    for wrong in (None, 3, cs.Track()):
        with pytest.raises(InputError, match="must be a file, the name of a shipped study or a S"):
            cs.run(wrong)
        with pytest.raises(InputError, match="must be a file or the name of a shipped study"):
            cs.load(wrong)
        with pytest.raises(InputError, match="must be the folder of a study's results"):
            cs.open_results(wrong)


@pytest.mark.parametrize("key", [3, "", "journey.", ".speed", None, ("journey", "speed")])
def test_what_is_no_key_is_refused(key):
    with pytest.raises(InputError, match=r"must be a dotted key, e\.g\. 'journey\.speed'"):
        cs.load("smooth_rail", {key: 4, "journey.speed": 50.0})


@pytest.mark.parametrize("values", ["journey.speed=3", ["journey.speed=3"], 3, {"journey.speed"}])
def test_what_is_no_mapping_is_refused(values):
    for call in (cs.load, cs.check, cs.run, cs.sweep):
        with pytest.raises(InputError, match="must be a mapping from dotted keys"):
            call("smooth_rail", values)


def test_a_sweep_varies_something():
    for series in ({}, None, {3: [1, 2]}, {"combine": "zip"}):
        with pytest.raises(InputError, match=r"must name at least one key|dotted key"):
            cs.sweep("smooth_rail", series)
    with pytest.raises(InputError, match=r"out = 3: must be a folder"):
        cs.run("smooth_rail", out=3)


def test_values_of_a_caller_stay_as_they_are():
    table = {"spectrum": "paper", "seed": 2}
    cs.load("point_vs_surface", {"irregularity": table, "irregularity.spectrum": "smooth"})
    assert table == {"spectrum": "paper", "seed": 2}


def test_cache_counts_and_clears_runs_from_python(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("CONTACTSTUDY_CACHE", str(tmp_path / "cache"))
    study = tmp_path / "mine.toml"
    study.write_text('title = "[bold]x[/nope]"\n[runs.point]\nsolver = "point"\n', "utf-8")
    cs.run(study, SHORT)
    assert cli.main(["cache"]) == 0
    assert len(list((tmp_path / "cache" / "runs").iterdir())) == 2
    assert f"{tmp_path / 'cache' / 'runs'}" in capsys.readouterr().out.replace("\n", "")
    assert cli.main(["cache", "--clear"]) == 0
    assert list((tmp_path / "cache" / "runs").iterdir()) == []
    assert cli.main(["check", str(study)]) == 0
    assert "[bold]x[/nope] (mine)" in capsys.readouterr().out


def test_a_number_beyond_all_floats_is_refused():
    with pytest.raises(InputError, match="must be finite"):
        cs.Track(length=10**400)

"""Commands: exit status and message for every bad input, resuming, and Ctrl-C."""

import importlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from short_study import HERTZ, POINT

from contactstudy import cli, driver
from contactstudy.figures.irregularity import irregularity_of
from contactstudy.irregularity import paper_spectrum
from contactstudy.solids.bodies import rail_body
from contactstudy.solids.cache import cache_store, entry_path
from contactstudy.store import DATASET, Store
from contactstudy.study import compute
from contactstudy.study.kind import find_kind
from contactstudy.study.kinds.passage import build
from contactstudy.study.kinds.passage.roughness import describe
from contactstudy.study.loading import load_study
from contactstudy.study.results import read_results
from contactstudy.validation import entries

SHORT = 'title = "A short one"' + POINT + HERTZ


def render(results, out_dir, reporter):
    """Stands for figures and report, which have their own tests."""
    (out_dir / "figures").mkdir(exist_ok=True)
    files = [out_dir / "report.pdf", out_dir / "report.html"]
    for file in files:
        file.write_bytes(b"%PDF")
    return files


@pytest.fixture
def short(tmp_path, monkeypatch):
    """Study file; drawing is left out."""
    monkeypatch.setattr(driver, "render", render)
    path = tmp_path / "short.toml"
    path.write_text(SHORT)
    return path


def refused(capfd, *arguments: str | Path) -> str:
    """Run a command that must end with status 2, one message and no traceback."""
    assert cli.main([str(a) for a in arguments]) == 2
    err = capfd.readouterr().err
    assert err.startswith("contactstudy: ") and "Traceback" not in err
    return err


FILES = {
    f"{name}.{key}"
    for name, table in find_kind("passage").tables.items()
    for key, entry in entries(table).items()
    if entry.parameter.file
}


@pytest.mark.parametrize("key", sorted(FILES))
def test_a_file_that_is_not_there_is_refused_whatever_key_names_it(short, capfd, key):
    assert len(FILES) > 9
    more = {"vehicle.cars": ["vehicle.type=train"], "vehicle.car": ["vehicle.type=bogie"]}
    more |= {"irregularity.file": ["irregularity.spectrum=measured"]}
    if key.startswith(("solid.", "wheelset.")):
        more[key] = ["runs.point.k_r=tangent", "solid.section=whole"]
    options = [f"--set={one}" for one in (f"{key}=nowhere.csv", *more.get(key, ()))]
    assert re.search("nowhere|missing|only with", refused(capfd, "check", short, *options))


def test_studies_lists_names_and_titles(capsys):
    assert cli.main(["studies"]) == 0
    out = capsys.readouterr().out
    assert re.search("^point_vs_surface +Point contact against surface contact$", out, re.MULTILINE)


def test_keys_are_listed_with_their_meaning(capsys):
    assert cli.main(["keys"]) == 0
    out = capsys.readouterr().out
    for table in ("track", "solid", "runs.NAME", "positions"):
        assert f"## [{table}]\n" in out
    assert "| `pad_stiffness` | N/m | 6.5e+07 |" in out


def test_check_prints_values_sizes_and_time_without_running(capsys, short, tmp_path):
    assert cli.main(["check", str(short), "--set", "journey.speed=250 km/h"]) == 0
    out = capsys.readouterr().out
    assert "69.44444444" in out and "track.pad_stiffness" in out and "expected time" in out
    # 41 nodes with 2 dofs, less 4 at the clamped ends, 11 sleepers, 3 of the vehicle: 92
    assert "92" in out and "129" in out  # steps of 0.2 ms: 1.8 m at 69.4 m/s
    assert [p.name for p in tmp_path.iterdir()] == ["short.toml"]


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("track.pad_stifness=3", "did you mean 'pad_stiffness'"),
        ("track.pad_stiffness=65 kg", "wrong unit 'kg'; allowed: N/m"),
        ("track.pad_stiffness=-65 MN/m", "must be above 0 N/m"),
        ("runs.point.elements_per_bay=0", "must be a whole number at least 1"),
        ("journey.to=7 m", "journey.to = 7.0: must lie on the track, 0 to 6 m"),
    ],
)
@pytest.mark.parametrize("command", ["check", "run"])
def test_bad_values(capfd, short, tmp_path, command, setting, message):
    out = tmp_path / "out"
    extra = ["--out", out] if command == "run" else []
    assert message in refused(capfd, command, short, "--set", setting, *extra)
    assert not out.exists()


def test_usage_errors(capfd, short, tmp_path):
    assert "did you mean 'point_vs_surface'" in refused(capfd, "check", "point_vs_surfase")
    assert "did you mean 'smooth_rail'" in refused(capfd, "reproduce", "smooth-rail")
    assert 'Did you mean "check"' in refused(capfd, "chek", short)
    assert "--out" in refused(capfd, "run", short)
    assert "workers = 0" in refused(capfd, "run", short, "--out", tmp_path / "o", "--workers", "0")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("x,z\n0,0.1\n0.25,abc\n0.5,0.2\n", "line 3, column 'z'"),
        ("x,z\n0,0.1\n0.25,nan\n0.5,0.2\n", "line 3, column 'z'"),
        ("x,z\n0,0.1\n0.5,0.2\n0.25,0.3\n", "falls below the position before"),
        ("x,z\n0,0.1\n", "rows"),
        ("a,z\n0,0.1\n", "x"),
        (None, "no such file"),
    ],
)
@pytest.mark.parametrize("command", ["check", "run"])
def test_bad_csv(capfd, short, tmp_path, content, message, command):
    csv = tmp_path / "level.csv"
    if content is not None:
        csv.write_text(content)
    settings = [f"irregularity.file={csv}", "irregularity.spectrum=measured"]
    settings += ["irregularity.level_column=z"]
    text = SHORT.replace("terms = 50", "")
    short.write_text(text)
    arguments = [a for s in settings for a in ("--set", s)]
    extra = ["--out", tmp_path / "out"] if command == "run" else []
    err = refused(capfd, command, short, *arguments, *extra)
    assert "level.csv" in err and message in err
    assert not (tmp_path / "out" / "result.nc").exists()


def test_unwritable_folder_is_refused_before_anything_runs(capfd, short, tmp_path, monkeypatch):
    monkeypatch.setattr(compute, "run_tasks", lambda *a, **k: pytest.fail("must not compute"))
    (tmp_path / "file").write_text("")
    assert "cannot be written" in refused(capfd, "run", short, "--out", tmp_path / "file" / "out")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Folder with the results of the short study, computed once; tests work on copies."""
    folder = tmp_path_factory.mktemp("finished")
    (folder / "short.toml").write_text(SHORT)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(driver, "render", render)
        assert cli.main(["run", str(folder / "short.toml"), "--out", str(folder / "out")]) == 0
    return folder / "out"


@pytest.fixture
def out(finished, tmp_path):
    return Path(shutil.copytree(finished, tmp_path / "out"))


def test_what_a_run_writes(out):
    results = read_results(out)
    assert list(results.runs) == ["point", "hertz"] and results.reference == "point"
    assert results.title == "A short one" and results.provenance["seed"] == 1
    assert irregularity_of(results).spectrum.band == (0.08, 20.0)
    force = results.runs["hertz"].contact_force
    assert force.attrs["units"] == "N" and "position" in force.coords
    assert float(force[0]) == pytest.approx(6869 * 9.81)
    metrics = json.loads((out / "metrics.json").read_text())
    assert set(metrics["runs"]["point"]) == {"dofs", "steps", "dt", "seconds", "peak_memory_mb"}
    assert 30 < metrics["runs"]["point"]["peak_memory_mb"] < 2000
    assert set(metrics["comparisons"]) == {"hertz"}


def test_a_second_call_computes_and_draws_nothing(capfd, short, out, monkeypatch):
    before = {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}
    monkeypatch.setattr(compute, "run_tasks", lambda *a, **k: pytest.fail("must not compute"))
    monkeypatch.setattr(driver, "render", lambda *a, **k: pytest.fail("must not draw"))
    assert cli.main(["run", str(short), "--out", str(out)]) == 0
    assert "up to date" in capfd.readouterr().err
    assert before == {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}


@pytest.mark.parametrize("name", ["report.pdf", "report.html"])
def test_a_missing_figure_or_report_is_made_again_from_finished_runs(short, out, monkeypatch, name):
    (out / name).unlink()
    before = (out / "result.nc").read_bytes()
    monkeypatch.setattr(compute, "run_tasks", lambda *a, **k: pytest.fail("must not compute"))
    assert cli.main(["run", str(short), "--out", str(out)]) == 0
    assert (out / name).exists() and (out / "result.nc").read_bytes() == before


def test_results_of_a_program_without_the_page_get_one(short, tmp_path, monkeypatch):
    """Nothing is computed for it."""
    out = tmp_path / "out"

    def older(results, out_dir, reporter):
        return render(results, out_dir, reporter)[:1]

    with monkeypatch.context() as patch:
        patch.setattr(driver, "render", older)
        assert cli.main(["run", str(short), "--out", str(out)]) == 0
    (out / "report.html").unlink()
    monkeypatch.setattr(compute, "run_tasks", lambda *a, **k: pytest.fail("must not compute"))
    assert cli.main(["run", str(short), "--out", str(out)]) == 0
    assert (out / "report.html").exists()


def test_a_changed_value_computes_only_what_it_concerns(short, out):
    first = {p.name for p in (out / "runs").glob("*.npz")}
    setting = ["--set", "runs.point.k_r=hertz_tangent", "--overwrite"]
    assert cli.main(["run", str(short), "--out", str(out), *setting]) == 0
    new = {p.name for p in (out / "runs").glob("*.npz")} - first
    assert len(new) == 1 and new.pop().startswith("point-")


def test_a_damaged_run_is_found_out_and_computed_again(capfd, short, out):
    reference = (out / "result.nc").read_bytes()
    damaged = next((out / "runs").glob("hertz-*.npz"))
    content = bytearray(damaged.read_bytes())
    content[len(content) // 2] ^= 0xFF
    damaged.write_bytes(content)
    (out / "result.nc").write_bytes(b"")
    assert cli.main(["run", str(short), "--out", str(out)]) == 0
    assert f"{damaged}: is damaged" in capfd.readouterr().err
    assert (out / "result.nc").read_bytes() == reference  # and the same bytes again


def test_a_run_that_breaks_down_keeps_the_others(capfd, short, tmp_path, monkeypatch):
    module = tmp_path / "breaking.py"
    module.write_text(
        "from contactstudy.exceptions import NumericalError\n"
        "from contactstudy.study import compute\n"
        "execute = compute.execute\n"
        "def breaking(computing, batching, pieces, progress):\n"
        "    if pieces[0][1] == 'point':\n"
        "        raise NumericalError('step 7 at X = 1.3 m: the force is not finite')\n"
        "    return execute(computing, batching, pieces, progress)\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    breaking = importlib.import_module("breaking")
    monkeypatch.setattr(compute, "execute", breaking.breaking)
    out = tmp_path / "out"
    assert cli.main(["run", str(short), "--out", str(out)]) == 1
    err = capfd.readouterr().err
    assert "run point: step 7 at X = 1.3 m: the force is not finite" in err
    assert "finished runs are kept" in err and "Traceback" not in err
    assert [p.name[:6] for p in (out / "runs").glob("*.npz")] == ["hertz-"]
    assert not (out / "result.nc").exists()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["run", "smooth_rail", "--out", ""], "--out: is empty; give a name"),
        (["run", "smooth_rail", "--out", "a\0b/c"], r"a\x00b/c/file: cannot be written (a"),
        (["new", "a\0.toml"], r"a\x00.toml: cannot be written (a zero byte in the name)"),
        (["new", "x" * 300 + ".toml"], "x... its name is too long"),
        (["check", "x" * 5000], "x... no such file nor shipped study"),
        (["run", "smooth_rail", "--out", "x" * 300], "its name is too long"),
        (["run", "smooth_rail", "--out", "/".join(["y" * 200] * 30)], "its name is too long"),
        (["check", "smooth_rail", "--set", "journey.speed=1 m/s", "--set", "journey.speed=2 m/s"],
         "--set journey.speed=2 m/s: journey.speed is given twice"),
        (["run", "smooth_rail", "--out", "x", "-j", "1.5"], '-j "1.5": must be a whole number'),
        (["verify", "--workers", "two"], '--workers "two": must be a whole number at least 1'),
        (["rn"], 'Did you mean "run"?'),
        (["check", ""], "no such file nor shipped study"),
    ],
)  # fmt: skip
def test_odd_arguments(capfd, tmp_path, monkeypatch, arguments, told):
    monkeypatch.chdir(tmp_path)
    err = refused(capfd, *arguments)
    assert told in err and len(err) < 700
    assert list(tmp_path.iterdir()) == []


def test_a_link_to_nowhere_as_folder(capfd, short, tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "gone" / "folder")
    assert "a broken link" in refused(capfd, "run", short, "--out", tmp_path / "link")


def test_narrow_consoles_show_whole_values(capfd, short, monkeypatch):
    monkeypatch.setenv("COLUMNS", "30")
    assert cli.main(["check", str(short)]) == 0
    out = capfd.readouterr().out
    assert "\N{HORIZONTAL ELLIPSIS}" not in out


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_output_that_nobody_takes():
    """A pipe into a program that stops reading, a full disk, and a closed standard output."""
    command = f"{sys.executable} -m contactstudy.cli keys"
    for shell, status, told in (
        (f"{command} | head -1 > /dev/null; exit ${{PIPESTATUS[0]}}", 141, ""),
        (f"{command} > /dev/full", 1, "contactstudy: standard output: the disk is full\n"),
        (f"{command} >&-", 0, ""),
    ):
        made = subprocess.run(["bash", "-c", shell], capture_output=True, text=True, check=False)
        assert (made.returncode, made.stderr) == (status, told), shell


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_interrupt_leaves_whole_files_and_the_next_call_goes_on(short, tmp_path, number):
    """Ctrl-C as a terminal sends it: to the command and all its workers."""
    text = SHORT.replace('"0.2 ms"', '"40 ns"')  # half a million steps
    short.write_text(text + '[runs.quick]\nsolver = "point"\ntime_step = "0.2 ms"\n')
    out = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-m", "contactstudy.cli", "run", str(short), "--out", str(out), "-j", "3"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 300  # compiling included, on a machine that does other things
    while not list(out.glob("runs/quick-*.npz")):
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.05)
    os.killpg(process.pid, number)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 128 + number
    told = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}[number]
    (line,) = [line for line in err.splitlines() if not line.startswith("runs.")]
    assert line.startswith(f"contactstudy: {told}; finished runs are kept")
    left = sorted(p.name for p in out.rglob("*") if p.is_file())
    assert left.pop(0) == "plan.json"  # for `contactstudy status`
    assert len(left) == 2 and all(name.startswith("quick-") for name in left)
    path = next(out.glob("runs/quick-*.npz"))
    kept = Store(path.parent, DATASET).load(*path.stem.rsplit("-", 1))
    assert kept.damage == "" and isinstance(kept.value, xr.Dataset)
    assert np.all(np.isfinite(kept.value.contact_force))


SOLID = """
[track]
length = "6 m"
[irregularity]
spectrum = "smooth"
[journey]
from = "2.4 m"
to = "2.6 m"
fade_in = "0.05 m"
[solid]
mesh_size = "8 mm"
cell_length = "0.2 m"
interface_modes = 6
internal_modes = 0
[runs.hertz]
solver = "point"
rail = "solid"
law = "hertz"
"""


def test_a_damaged_cache_entry_is_found_out_and_rebuilt(capfd, short, tmp_path, monkeypatch):
    monkeypatch.setenv("CONTACTSTUDY_CACHE", str(tmp_path / "cache"))
    short.write_text(SOLID)
    entry = entry_path(rail_body(build.recipe(load_study(short))))
    entry.parent.mkdir()
    entry.write_bytes(b"PK\x03\x04 half a file")
    assert cli.main(["run", str(short), "--out", str(tmp_path / "out")]) == 0
    err = capfd.readouterr().err
    assert str(entry) in err and "Traceback" not in err
    assert len(entry.read_bytes()) > 10000  # whole again


LEVEL = Path(__file__).parents[2].parent / "shared" / "data" / "hsr_level_20170110.csv"


@pytest.mark.skipif(not LEVEL.is_file(), reason="the measured level is not there; not shipped")
def test_the_measured_level_study_reads_the_measured_file(capfd):
    assert cli.main(["check", "measured_level", "--set", f"irregularity.file={LEVEL}"]) == 0
    study = load_study("measured_level", [f"irregularity.file={LEVEL}"])
    info = describe(study).info
    assert info.measured.band == pytest.approx((2 * np.pi / 42, 2 * np.pi / 2.5))
    assert info.spectrum.label == "eq. (3), Table 1"
    # the measured line is 3 to 10 dB smoother than Table 1 inside its valid band
    inside = (info.measured.wavenumber > 0.2) & (info.measured.wavenumber < 2.0)
    table_1 = paper_spectrum()(info.measured.wavenumber[inside])
    difference = np.mean(10 * np.log10(info.measured.density[inside] / table_1))
    print(f"measured against Table 1: -10 to -3 dB ({difference:.1f} dB)")
    assert -10 < difference < -3
    refused(capfd, "check", "measured_level", "--set", f"irregularity.file={LEVEL}",
            "--set", "irregularity.origin=99990")  # fmt: skip


@pytest.mark.skipif(not LEVEL.is_file(), reason="the measured level is not there; not shipped")
def test_a_measured_level_can_be_drawn_beside_a_generated_one():
    settings = [f"irregularity.measured_overlay={LEVEL}", "irregularity.x_column=chainage_m",
                "irregularity.level_column=left_mm"]  # fmt: skip
    described = describe(load_study("paper_irregularity", settings))
    assert described.info.estimate is not None and described.info.measured is not None
    assert list(described.files) == [LEVEL.name]


def test_reproduce_puts_named_studies_below_the_folder(short, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["reproduce", "paper_irregularity"]) == 0
    results = read_results(tmp_path / "reports/out/paper_irregularity")
    assert not results.runs and irregularity_of(results).estimate is not None
    assert "paper_irregularity" in capfd.readouterr().out


def test_cache_says_what_is_there_and_clears_it(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("CONTACTSTUDY_CACHE", str(tmp_path / "cache"))
    assert cli.main(["cache"]) == 0
    cache_store().save("CellRecipe", "0123456789abcdef", {"a": np.zeros(250_000)})
    (tmp_path / "cache" / "mine.txt").write_text("no body")
    assert cli.main(["cache"]) == 0
    assert cli.main(["cache", "--clear"]) == 0
    where = tmp_path / "cache"
    lines = [f"{where}: 0 entries, 0.0 MB", f"{where}: 1 entry, 2.0 MB"]
    assert capsys.readouterr().out.splitlines() == [*lines, lines[0]]
    assert [p.name for p in where.iterdir()] == ["mine.txt"]


def test_vehicles_lists_cars_with_what_their_sources_give(capsys):
    assert cli.main(["vehicles"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert "13.7 t" in lines["s300"] and "three_dimensional" not in lines["s300"]
    assert (
        "three_dimensional" in lines["high_speed_motor"] and "16.0 t" in lines["high_speed_motor"]
    )

"""A kind of study in 70 lines goes all the way; companions do not overwrite each other."""

import json
import sys
from pathlib import Path

import pytest

from contactstudy import cli
from contactstudy.exceptions import InputError
from contactstudy.study import compute, kind
from contactstudy.study.loading import load_companions, load_study
from contactstudy.study.results import open_results, read_results

# One folder's worth: pendulums that swing freely, a run a length.
PENDULUM = '''
"""Pendulums: how long a swing takes."""
import dataclasses
import typing

import numpy as np
import xarray as xr

from contactstudy.exceptions import InputError
from contactstudy.plot.curves import Plot, curve
from contactstudy.plot.draw import draw
from contactstudy.plot.drawing import Drawing
from contactstudy.report.blocks import figure, table
from contactstudy.study.kind import Kind, Report, Work
from contactstudy.study.study import Study


@dataclasses.dataclass(frozen=True)
class Swings(Study):
    kind: typing.ClassVar[str] = "pendulum"
    lengths: tuple = ()

    def config(self):
        return {"pendulum": {"lengths": list(self.lengths)}}

    def units(self):
        return {"pendulum.lengths": "m"}


def swing(study, name, progress):
    length = study.lengths[int(name[1:])]
    t = np.linspace(0, 10, 501)
    progress(500, 500)
    angle = ("time", 0.1 * np.cos(np.sqrt(9.81 / length) * t), {"units": "rad"})
    return xr.Dataset({"angle": angle}, {"time": t}, {"length": length})


class Pendulum(Kind):
    name = "pendulum"
    computing = "pendulum:swing"
    tables: typing.ClassVar = {}

    def load(self, path, data, overrides, main=None):
        lengths = data["pendulum"]["lengths"]
        if min(lengths) <= 0:
            raise InputError(f"pendulum.lengths = {lengths}: must be above 0 m")
        return Swings(path.stem, "Pendulums", "A mass on a string.", lengths=tuple(lengths))

    def check(self, study, companions, reporter):
        return [f"{len(study.lengths)} pendulums"]

    def work(self, study, inputs):
        return [Work(f"p{k}", length) for k, length in enumerate(study.lengths)]

    def drawings(self, results):
        curves = [curve(n, run.time, run.angle) for n, run in results.runs.items()]
        plot = Plot("Angles.", "Time (s)", "Angle (rad)", tuple(curves))
        return [Drawing("angles", plot.caption, lambda: draw(plot))]

    def report(self, results, timings=False):
        rows = [[n, f"{run.attrs['length']:g}"] for n, run in results.runs.items()]
        blocks = [table(["Run", "Length (m)"], rows, "Pendulums."), figure("angles", "Angles.")]
        return Report(["They swing."], [{"title": "Swings", "blocks": blocks}])

    def summary(self, results):
        return [f"{name}: {run.attrs['length']:g} m" for name, run in results.runs.items()]


PENDULUM = Pendulum()
'''


@pytest.fixture
def pendulum(tmp_path, monkeypatch):
    """Study file of a kind that is one module and one line in the table of kinds."""
    (tmp_path / "pendulum.py").write_text(PENDULUM)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setitem(kind.KINDS, "pendulum", "pendulum:PENDULUM")
    path = tmp_path / "clock.toml"
    path.write_text("[pendulum]\nlengths = [1.0, 0.25]\n")
    yield path
    sys.modules.pop("pendulum", None)


def test_a_kind_in_a_test_goes_all_the_way(pendulum, tmp_path, capsys, monkeypatch):
    assert len(PENDULUM.splitlines()) < 80
    out = tmp_path / "out"
    assert cli.main(["check", str(pendulum)]) == 0
    told = capsys.readouterr().out
    assert "2 pendulums" in told and "pendulum.lengths" in told and "1, 0.25" in told
    assert cli.main(["run", str(pendulum), "--out", str(out)]) == 0
    assert "p1: 0.25 m" in capsys.readouterr().out
    # period 2 pi sqrt(l/g): back at the start after 2.006 s and 1.003 s
    runs = read_results(out).runs
    for run, period in zip(runs.values(), (2.006, 1.003), strict=True):
        assert float(run.angle.interp(time=period)) == pytest.approx(0.1, rel=1e-3)
    assert list(open_results(out).children) == ["p0", "p1"]
    metrics = json.loads((out / "metrics.json").read_text())
    assert set(metrics["runs"]) == {"p0", "p1"} and metrics["runs"]["p0"]["seconds"]
    assert (out / "figures/angles.png").is_file()
    assert (out / "report.pdf").read_bytes().startswith(b"%PDF")
    # again: found finished; without the report: made from what is kept
    monkeypatch.setattr(compute, "run_tasks", lambda *a, **k: pytest.fail("must not compute"))
    before = {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}
    assert cli.main(["run", str(pendulum), "--out", str(out)]) == 0
    assert "up to date" in capsys.readouterr().err
    (out / "report.pdf").unlink()
    assert cli.main(["run", str(pendulum), "--out", str(out)]) == 0
    assert before == {p: p.read_bytes() for p in out.rglob("*") if p.is_file()}


def test_a_kind_must_say_what_it_is():
    class Nothing(kind.Kind):
        name = "nothing"

    with pytest.raises(TypeError, match=r"load.*report.*work"):
        Nothing()


def test_what_a_kind_refuses_and_what_it_has_not(pendulum, tmp_path, capsys):
    arguments = ["export", str(pendulum), "--out", str(tmp_path / "press.inp")]
    assert cli.main(arguments) == 2
    assert "is a study of pendulum (table [pendulum])" in capsys.readouterr().err
    pendulum.write_text("[pendulum]\nlengths = [-1.0]\n")
    assert cli.main(["check", str(pendulum)]) == 2
    assert "must be above 0 m" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("companions", "message"),
    [
        (["a/one.toml", "b/one.toml"], r"b/one.toml: is called one like the companion .*a/one"),
        (["a/one.toml", "a/one.toml"], r"is called one like the companion"),
        (["a/main.toml"], r"is called main like the study that it accompanies"),
        (["a/One.toml", "b/one.toml"], r"is called one like the companion .*a/One"),
        (["a/Aux.toml"], r"is called Aux like a device of Windows"),
        (["a/figures.toml"], r"is called figures like a file or folder of the results"),
    ],
)
def test_companions_that_would_overwrite_each_other_are_refused(
    tmp_path, capsys, companions, message
):
    for name in ("a/one", "a/One", "a/Aux", "b/one", "a/main", "a/figures"):
        (path := tmp_path / f"{name}.toml").parent.mkdir(exist_ok=True)
        path.write_text('[irregularity]\nspectrum = "smooth"\n')
    path = tmp_path / "main.toml"
    path.write_text(f"companions = {companions}\n")
    with pytest.raises(InputError, match=message):
        load_companions(load_study(path))
    assert cli.main(["check", str(path)]) == 2
    assert "give its file another one" in capsys.readouterr().err


def test_a_companion_may_be_of_another_kind(pendulum, tmp_path):
    path = tmp_path / "main.toml"
    path.write_text('companions = ["clock.toml"]\n')
    (companion,) = load_companions(load_study(path))
    assert companion.kind == "pendulum" and companion.name == "clock"


def test_reproduced_studies_have_folders_of_their_own(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert cli.main(["reproduce", "point_vs_surface", "smooth_rail", *out]) == 2
    told = capsys.readouterr().err
    assert "study smooth_rail" in told and "companion of point_vs_surface" in told
    assert not list(Path(tmp_path).iterdir())

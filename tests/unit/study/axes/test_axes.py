"""Studies with axes of a kind with a closed form: what they give, resume, failures, refusals."""

import csv
import json
import shutil

import numpy as np
import pytest

import contactstudy as cs
from contactstudy import cli
from contactstudy.driver import run_study
from contactstudy.exceptions import InputError
from contactstudy.report.axes import parts
from contactstudy.store import Store
from contactstudy.study import compute, tasks
from contactstudy.study.axes import measure
from contactstudy.study.loading import load_study
from contactstudy.study.plan import plan_study


def swept(path, out, workers=1, **options):
    return run_study(load_study(path, **options), out, workers)


def test_a_grid_is_the_law(law, tmp_path):
    path = law('[sweep]\n"law.x" = "1 m to 3 m by 1 m"\n"law.order" = [1, 3]\n')
    data = swept(path, tmp_path / "out").designs["sweep"]
    largest = data["largest"].sel(run="power")
    assert largest.dims == ("law.x", "law.order")
    np.testing.assert_allclose(largest, [[6, 6], [7, 13], [8, 32]])
    assert largest.sel({"law.x": 2, "law.order": 3}) == 13
    assert data["law.x"].attrs["units"] == "m" and data["largest"].attrs["units"] == "m"
    with (tmp_path / "out/sweep.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert [float(r["largest.power [m]"]) for r in rows] == largest.values.ravel().tolist()
    assert [float(r["law.x [m]"]) for r in rows] == [1, 1, 2, 2, 3, 3]
    # from the file as from the run
    found = cs.open_results(tmp_path / "out")["sweep"].to_dataset()
    np.testing.assert_array_equal(found["largest"], data["largest"])
    assert (tmp_path / "out/report.pdf").is_file()


def test_zipped_and_sampled_keys(law, tmp_path):
    text = '[sweep]\n"law.x" = [1, 2, 3]\n"law.order" = [1, 2, 3]\ncombine = "zip"\n'
    data = swept(law(text), tmp_path / "zip").designs["sweep"]
    np.testing.assert_allclose(data["largest"].sel(run="power"), [6, 9, 32])
    assert data["law.order"].dims == ("case",)
    text = '[sweep]\n"law.x" = "uniform 1 m to 3 m"\n"law.order" = [1, 2]\n'
    text += 'combine = "sobol"\nsamples = 32\nseed = 7\n'
    data = swept(law(text), tmp_path / "sobol").designs["sweep"]
    x, order = data["law.x"], data["law.order"]
    np.testing.assert_allclose(data["largest"].sel(run="power"), 5 + x**order)
    assert np.bincount(order.values.astype(int)).tolist() == [0, 16, 16]


def test_equal_pieces_are_computed_once_and_finished_ones_never_again(law, tmp_path, monkeypatch):
    path = law('[sweep]\n"law.x" = "1 m to 6 m by 1 m"\n')
    plan = plan_study(load_study(path), tmp_path / "out")
    assert len(plan.variants) == 6 and len(plan.pieces) == 7
    swept(path, tmp_path / "out")
    before = {p: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()}
    # a larger sweep computes what is new, and the smaller one nothing
    law('[sweep]\n"law.x" = "1 m to 7 m by 1 m"\n')
    asked = []
    run_tasks = compute.run_tasks

    def watched(tasks, *rest, **named):
        asked.extend(name for task in tasks for _, name in task.arguments[2])
        return run_tasks(tasks, *rest, **named)

    monkeypatch.setattr(compute, "run_tasks", watched)
    swept(path, tmp_path / "out")
    assert asked == ["power"]
    law('[sweep]\n"law.x" = "1 m to 6 m by 1 m"\n')
    run_study(load_study(path), tmp_path / "out", 1, overwrite=True)
    assert asked == ["power"]
    assert {p: p.read_bytes() for p in before} == before


@pytest.mark.parametrize("word", ["", "batch"])
def test_bytes_do_not_depend_on_workers_order_or_batches(law, tmp_path, word, monkeypatch):
    path = law('[sweep]\n"law.seed" = "1 to 40"\n', f'word = "{word}"')
    outs = [tmp_path / f"{workers}" for workers in (1, 3)]
    for workers, out in zip((1, 3), outs, strict=True):
        swept(path, out, workers)
        monkeypatch.setattr(tasks, "BATCH", 7)
    for name in ("result.nc", "sweep.csv", "report.pdf"):
        one, other = ((out / name).read_bytes() for out in outs)
        assert one == other
    runs = [{p.name: p.read_bytes() for p in (out / "runs").glob("*.npz")} for out in outs]
    assert runs[0] == runs[1] and len(runs[0]) == 41


def test_killed_in_the_middle_it_goes_on(law, tmp_path, monkeypatch):
    path = law('[sweep]\n"law.seed" = "1 to 12"\n')
    swept(path, tmp_path / "whole")
    save, count = Store.save, []

    def killed(self, *arguments):
        count.append(arguments)
        if len(count) == 6:
            raise KeyboardInterrupt
        return save(self, *arguments)

    monkeypatch.setattr(Store, "save", killed)
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            swept(path, tmp_path / "killed")
        count.clear()
    monkeypatch.setattr(Store, "save", save)
    swept(path, tmp_path / "killed")
    for name in ("result.nc", "sweep.csv", "report.pdf"):
        assert (tmp_path / "killed" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


def test_failed_variants_are_recorded_and_the_others_go_on(law, tmp_path, capsys):
    path = law('[sweep]\n"law.x" = "1 m to 4 m by 1 m"\n', "breaks_at = 3")
    out = ["--out", str(tmp_path / "out"), "-j", "1"]
    assert cli.main(["run", str(path), *out]) == 1
    told = capsys.readouterr()
    assert "1 variant failed" in told.err and "x = 3 m breaks down" in told.err
    data = cs.open_results(tmp_path / "out")["sweep"].to_dataset()
    np.testing.assert_allclose(data["largest"].sel(run="power"), [6, 9, np.nan, 21])
    assert "x = 3 m breaks down" in str(data["failure"].sel({"law.x": 3}).item())
    assert data["failure"].values.tolist().count("") == 3
    metrics = json.loads((tmp_path / "out/metrics.json").read_text())
    assert [v["title"] for v in metrics["variants"].values() if "failure" in v] == ["x = 3"]
    # it is tried again, and only it
    assert cli.main(["run", str(path), *out]) == 1


def test_a_process_that_dies_in_a_batch_costs_its_own_variant_only(law, tmp_path):
    path = law('[sweep]\n"law.seed" = "1 to 12"\n', 'dies_at = 5\nword = "batch"')
    data = swept(path, tmp_path / "out", 2).designs["sweep"]
    failed = data["failure"] != ""
    assert data["law.seed"].values[failed].tolist() == [5]
    assert "process ended without a result" in str(data["failure"].values[failed])
    assert data["largest"].notnull().sum() == 2 * 11


def test_a_variant_that_cannot_be_measured_is_a_failure(law, tmp_path):
    data = swept(law('[sweep]\n"law.word" = ["odd", "even"]\n'), tmp_path / "out").designs["sweep"]
    assert data["failure"].values.tolist() == ["norms: cannot be measured", ""]
    np.testing.assert_allclose(data["largest"].sel(run="power"), [np.nan, 6])


def test_when_all_variants_fail_nothing_is_written(law, tmp_path, capsys):
    path = law('[sweep]\n"law.order" = [1, 2]\n', "breaks_at = 1.0")
    assert cli.main(["run", str(path), "--out", str(tmp_path / "out"), "-j", "1"]) == 1
    assert "run power (order = 2): x = 1 m breaks down" in capsys.readouterr().err
    assert not (tmp_path / "out/result.nc").exists()


def test_a_damaged_run_is_computed_again_if_it_is_needed(law, tmp_path):
    path = law('[sweep]\n"law.x" = [1, 2]\n')
    swept(path, tmp_path / "out")
    expected = (tmp_path / "out/result.nc").read_bytes()
    for piece in (tmp_path / "out/runs").glob("power-*.npz"):
        piece.write_bytes(b"damaged")
    for entry in (tmp_path / "out/runs").glob(f"{measure.MEASURED}-*"):
        entry.unlink()
    (tmp_path / "out/result.nc").unlink()
    swept(path, tmp_path / "out")
    assert (tmp_path / "out/result.nc").read_bytes() == expected


def test_refinements_are_a_star_and_cross_with_sweeps(law, tmp_path):
    text = '[refine]\n"law.x" = [4, 2, 1]\n"law.order" = [1, 2, 3, 4]\n'
    designs = load_study(law(text, "x = 3.0")).designs
    assert [d.name for d in designs] == ["refine.law.x", "refine.law.order"]
    assert [len(d) for d in designs] == [3, 4]
    data = swept(law(text, "x = 3.0"), tmp_path / "star").designs
    np.testing.assert_allclose(data["refine.law.x"]["largest"].sel(run="power"), [21, 9, 6])
    np.testing.assert_allclose(
        data["refine.law.order"]["largest"].sel(run="power"), [8, 14, 32, 86]
    )
    crossed = load_study(law(text + '[sweep]\n"law.scale" = [1, 2]\n')).designs
    assert [d.sizes for d in crossed] == [
        {"law.scale": 2, "law.x": 3}, {"law.scale": 2, "law.order": 4},
    ]  # fmt: skip


def test_series_from_the_command_line_and_from_python(law, tmp_path, capsys):
    path = law('[sweep]\n"law.x" = [1, 2]\n')
    out = str(tmp_path / "out")
    sweep = ["--sweep", "law.x=1 m to 3 m by 1 m", "--sweep", "law.order=[1, 2]"]
    assert cli.main(["check", str(path), *sweep]) == 0
    assert "6 variants with 12 runs, of which 7 differ" in capsys.readouterr().out
    assert cli.main(["run", str(path), *sweep, "--out", out, "-j", "1"]) == 0
    data = cs.sweep(path, {"law.x": "1 m to 3 m by 1 m", "law.order": [1, 2]}, out=out, workers=1)
    np.testing.assert_allclose(data["largest"].sel(run="power"), [[6, 6], [7, 9], [8, 14]])
    # a key that is set is no axis any more
    assert not hasattr(load_study(path, {"law.x": 2.0}), "designs")


def test_quick_values(law):
    text = '[sweep]\n"law.x" = "1 m to 9 m by 1 m"\n[quick]\n"law.x" = [1, 2]\n"law.scale" = 3.0\n'
    assert len(load_study(law(text)).variants) == 9
    quick = load_study(law(text), quick=True)
    assert len(quick.variants) == 2 and quick.study.law.scale == 3.0
    with pytest.raises(InputError, match=r"law\.scales: unknown key"):
        load_study(law(text.replace("scale", "scales")))
    named = law(text.replace('[quick]\n"law.x" = [1, 2]', '[quick]\n"sweep.law.x" = [1, 2, 3]'))
    assert len(load_study(named, quick=True).variants) == 3
    # a refined key about which all others are refined has a value of its own beside its series
    text = '[refine]\n"law.x" = [4, 2, 1]\n[quick]\n"law.x" = 3\n"refine.law.x" = [8, 6, 4]\n'
    both = load_study(law(text), quick=True)
    assert both.study.law.x == 3.0 and load_study(law(text)).study.law.x != 3.0
    assert [v.study.law.x for v in both.variants.values()] == [8.0, 6.0, 4.0]
    assert not hasattr(load_study(law(text), {"law.x": 5.0}, quick=True), "designs")


def test_all_that_is_wrong_is_said_at_once(law):
    text = '[sweep]\n"law.y" = [1]\n"lav.x" = [1]\n"law.x" = "1 kg to 2 m by 1 m"\ncombin = "zip"\n'
    text += 'keep = 3\n[refine]\n"law.order" = [1, 3, 2]\nexpected = { "law.orde" = 2 }\n'
    with pytest.raises(InputError) as caught:
        load_study(law(text, "scal = 1"))
    told = "\n".join(caught.value.problems)
    for part in (
        "law.y: unknown key", "lav.x: is no key of a study of law", "wrong unit 'kg'",
        "sweep.combin: unknown key", "sweep.keep = 3", "refine.law.order", "coarse to fine",
        "refine.expected.law.orde", "law.scal: unknown key",
    ):  # fmt: skip
        assert part in told


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        ('[sweep]\n"law.x" = "uniform 1 m to 2 m"\n', 'drawn only in [sweep] with combine = "sob'),
        ('[sweep]\n"law.x" = ["1e x tangent"]\n', "unknown unit 'e x tangent'"),
        ('[refine]\n"law.seed" = [4, 2, 1]\n', "coarse to fine, that is increasing"),
        ('[refine]\n"law.scale" = [2, 1, 0]\n', "2 or more numbers above 0"),
        ('[refine]\n"law.x" = [4, 2, 3]\n', "must be 2 or more numbers above 0, coarse to fine"),
    ],
)
def test_series_that_mean_something_else(law, axes, message):
    with pytest.raises(InputError) as error:
        load_study(law(axes))
    assert message in str(error.value)


def test_zipped_series_may_repeat_a_value(law, tmp_path):
    text = '[sweep]\n"law.x" = [1, 2, 2]\n"law.order" = [1, 1, 2]\ncombine = "zip"\n'
    data = swept(law(text), tmp_path / "zip").designs["sweep"]
    np.testing.assert_allclose(data["largest"].sel(run="power"), [6, 7, 9])


def test_impossible_variants_are_named_with_their_values(law):
    text = '[sweep]\n"law.x" = [10, 200, 300]\n"law.order" = [1, 2.5]\n'
    with pytest.raises(InputError) as caught:
        load_study(law(text))
    assert caught.value.problems == (
        "x = 200, order = 1: law.x = 200: must be below 100 times law.order",
        "x = 300, order = 1; x = 300, order = 2.5: law.x = 300: must be below 100 times law.order",
    )


def test_too_many_variants_are_refused_before_they_are_made(law):
    text = '[sweep]\n"law.seed" = "1 to 20000"\n"law.x" = "1 m to 20 m by 20000, linear"\n'
    with pytest.raises(
        InputError, match=r"400000000 variants \(20000 x 20000\); allowed are 20000"
    ):
        load_study(law(text))


def test_histories_are_kept_where_asked(law, tmp_path):
    path = law('[sweep]\n"law.x" = [1, 2]\nkeep = ["y"]\n')
    data = swept(path, tmp_path / "out").designs["sweep"]
    np.testing.assert_allclose(data["y"].sel(run="power"), [[2, 4, 6], [3, 6, 9]])
    assert np.isnan(data["y"].sel(run="shared").values[:, 1:]).all()
    with pytest.raises(InputError, match="no run has the history z"):
        swept(law('[sweep]\n"law.x" = [1, 2]\nkeep = ["z"]\n'), tmp_path / "other")


def test_companions_may_have_axes(law, tmp_path):
    law('[sweep]\n"law.x" = [1, 2]\n', name="inner")
    path = tmp_path / "main.toml"
    path.write_text('companions = ["inner.toml"]\n')
    results = run_study(load_study(path), tmp_path / "out", 1)
    assert results.companions[0].swept and (tmp_path / "out/inner/sweep.csv").is_file()
    shutil.rmtree(tmp_path / "out")


def test_a_key_is_not_set_and_swept_at_once(law):
    path = law('[sweep]\n"law.order" = [1, 2]\n')
    with pytest.raises(InputError) as caught:
        load_study(path, ["law.x=2 m"], sweep=["law.x=[1, 3]"])
    (problem,) = caught.value.problems
    assert problem.startswith("law.x: is set (2 m) and swept ([1, 3]) at once")
    with pytest.raises(InputError, match=r"set .* and swept"):
        load_study(path, {"law.x": 2.0}, sweep={"law.x": [1, 3]})


def test_a_history_to_keep_is_looked_for_before_anything_runs():
    """Names of point runs, of surface contact, and of smooth twins; those of no run are refused."""
    values = {"runs.point.k_r": "1e9 N/m"}
    series = {"irregularity.seed": [1, 2]}

    def refused(name, study):
        with pytest.raises(InputError) as caught:
            load_study(study, values, sweep=series | {"keep": [name]})
        return " ".join(caught.value.problems)

    for name in ("contact_force", "rail_acceleration", "contact_area", "contact_force_smooth"):
        assert load_study("samples", values, sweep=series | {"keep": [name]}).keep == (name,)
    said = refused("contact_forces", "samples")
    assert 'sweep.keep = "contact_forces"' in said and "did you mean 'contact_force'" in said
    assert "rail_roll" not in refused("rail_roll", "samples").partition("there are")[2]


def test_the_histories_of_positions_are_known():
    series = {"positions.load": ["9 kN", "10 kN"], "keep": ["approach"]}
    assert load_study("manchester", sweep=series).keep == ("approach",)
    with pytest.raises(InputError, match="no run has this history"):
        load_study("manchester", sweep=series | {"keep": ["contact_force"]})


def test_what_a_refinement_says_of_its_keys(law, tmp_path):
    """An expected order, and why there is one or none; gone with a key that is set."""
    text = '[refine]\n"law.x" = [0.8, 0.4, 0.2]\n"law.scale" = [3, 2, 1]\n'
    text += 'expected = { "law.x" = 2 }\nwhy = { "law.scale" = "a\\n factor" }\n'
    path = law(text)
    x, scale = load_study(path).designs
    assert (x.expected, x.why, scale.expected, scale.why) == (2.0, "", None, "a factor")
    results = swept(path, tmp_path / "out")
    of_x, of_scale = (str(p["blocks"][0]) for p in parts(results))
    assert "Expected order 2." in of_x and "No order is expected: a factor." in of_scale
    (left,) = load_study(path, {"law.x": 1.0}).designs
    assert left.refined == "law.scale"
    wrong = text.replace('"law.scale" = "a', '"law.word" = "a').replace("= 2 }", '= "two" }')
    with pytest.raises(InputError) as caught:
        load_study(law(wrong))
    said = " ".join(caught.value.problems)
    assert "refine.why.law.word: unknown key" in said and "refine.expected.law.x" in said


@pytest.mark.parametrize("values", ['["0.05 ms", "0.1 ms"]', '"0.05 ms to 0.2 ms x 2"'])
def test_steps_of_time_are_refined_downwards(tmp_path, values):
    path = tmp_path / "steps.toml"
    text = f'[runs.point]\nsolver = "point"\n[refine]\n"journey.time_step" = {values}\n'
    path.write_text(text)
    with pytest.raises(InputError, match=r"refine\.journey\.time_step = .* that is decreasing"):
        load_study(path)

"""Two results beside each other: a known change is found, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from contactstudy import cli
from contactstudy.study.differences import differences
from contactstudy.study.results import StudyResults, write_results


def results(force=(1.0, -4.0, 2.0), **changes):
    run = xr.Dataset(
        {"contact_force": ("time", np.array(force)), "name": ("time", ["a", "b", "c"])},
        {"time": ("time", [0.0, 1.0, 2.0])},
    )
    made = StudyResults(
        name="mine",
        title="Mine",
        description="",
        config={"journey": {"speed": 50.0}, "runs": {"point": {"law": "linear"}}},
        units={"journey.speed": "m/s"},
        runs={"point": run},
        reference=None,
        metrics={"runs": {"point": {"seconds": {"setup": 1.0}, "dofs": 3}}, "comparisons": {}},
        provenance={"versions": {"numpy": "2.0"}},
    )
    return replace(made, **changes)


def test_equal_results_have_none():
    slower = {"runs": {"point": {"seconds": {"setup": 9.0}, "dofs": 3}}, "comparisons": {}}
    assert differences(results(), results(metrics=slower)) == []
    with_gaps = results((np.nan, 1.0, 2.0))
    assert differences(with_gaps, results((np.nan, 1.0, 2.0))) == []


def test_a_signal_differs_by_its_largest_difference():
    (found,) = differences(results(), results((1.0, -4.1, 2.0)))
    assert (found.what, found.name) == ("signal", "point.contact_force")
    assert found.relative == pytest.approx(0.1 / 4.0)
    assert found.beyond(0.024) and not found.beyond(0.026)


def test_a_key_and_a_norm_differ_by_their_values():
    other = {"journey": {"speed": 60.0}, "runs": {"point": {"law": "hertz", "k": [1, 2]}}}
    metrics = {"runs": {"point": {"dofs": 4}}, "comparisons": {}}
    found = {d.name: d for d in differences(results(), results(config=other, metrics=metrics))}
    assert found.keys() == {"journey.speed", "runs.point.law", "runs.point.k", "runs.point.dofs"}
    assert found["journey.speed"].relative == pytest.approx(10 / 60)
    assert (found["runs.point.law"].first, found["runs.point.law"].second) == ("linear", "hertz")
    assert found["runs.point.k"].first is None
    assert all(found[name].beyond(1e9) for name in ("runs.point.law", "runs.point.k"))


def test_what_only_one_has_and_other_shapes_are_told():
    other = {"other": results().runs["point"]}
    names = [(d.name, d.first, d.second) for d in differences(results(), results(runs=other))]
    assert ("point", "there", None) in names and ("other", None, "there") in names
    short = {"point": results().runs["point"].isel(time=slice(2))}
    assert any("shape (3,)" in str(d.first) for d in differences(results(), results(runs=short)))
    with_one = results(companions=(results(name="smooth"),))
    assert [(d.what, d.name) for d in differences(with_one, results())] == [("companion", "smooth")]
    changed = results(companions=(results((1.0, -4.1, 2.0), name="smooth"),))
    assert [d.name for d in differences(with_one, changed)] == ["smooth: point.contact_force"]


def test_the_command_ends_with_1_when_they_differ(tmp_path, capfd):
    for name, force in (("a", -4.0), ("b", -4.1)):
        (tmp_path / name).mkdir()
        write_results(results((1.0, force, 2.0)), tmp_path / name)
    a, b = str(tmp_path / "a"), str(tmp_path / "b")
    assert cli.main(["diff", a, a]) == 0
    assert "no difference" in capfd.readouterr().out
    assert cli.main(["diff", a, b]) == 1
    assert "point.contact_force" in "".join(capfd.readouterr().out.split())
    assert cli.main(["diff", a, b, "--tolerance", "0.03"]) == 0
    assert cli.main(["diff", a, str(tmp_path / "none")]) == 2
    assert cli.main(["diff", a, b, "--tolerance", "-1"]) == 2
    assert "must be at least 0" in capfd.readouterr().err

"""Results survive the disk, and the same results are the same bytes."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.exceptions import InputError
from contactstudy.irregularity.shown import (
    IrregularityInfo,
    Level,
    SpectrumCurve,
    from_dataset,
    to_dataset,
)
from contactstudy.study.results import (
    StudyResults,
    open_results,
    read_results,
    write_results,
)


def a_run(scale: float = 1.0) -> xr.Dataset:
    time = np.linspace(0.0, 0.1, 11)
    data = xr.Dataset(
        {"contact_force": ("time", scale * np.cos(time), {"units": "N", "long_name": "force"})},
        coords={"time": ("time", time, {"units": "s"}), "position": ("time", 6 + 80 * time)},
    )
    data.attrs = {"solver": "point", "dofs": 3, "seconds_setup": 0.1, "symmetric": True, "x": None}
    return data


def results(**changes: object) -> StudyResults:
    k = np.linspace(0.1, 20, 7)
    info = IrregularityInfo(
        spectrum=SpectrumCurve("eq. (3)", k, 1 / k**2, (0.08, 20.0)),
        profile=Level("seed 1", np.arange(5.0), np.arange(5.0) * 1e-3),
    )
    parts: dict = {
        "name": "demo",
        "title": "Demonstration – µ",
        "description": "",
        "config": {"track": {"length": 36.0}},
        "units": {"track.length": "m"},
        "runs": {"surface": a_run(), "point": a_run(1.05)},
        "reference": "surface",
        "metrics": {"runs": {"point": {"dofs": 3}}},
        "groups": {"irregularity": to_dataset(info)},
        "provenance": {"seed": 1},
    }
    return StudyResults(**(parts | changes))


def test_round_trip_with_a_companion(tmp_path):
    inner = results(name="smooth", runs={}, reference=None, groups={})
    outer = results(companions=(inner,))
    write_results(outer, tmp_path)
    write_results(inner, tmp_path / "smooth")
    back = read_results(tmp_path)
    for key in ("name", "title", "config", "units", "reference", "metrics", "provenance"):
        assert getattr(back, key) == getattr(outer, key)
    assert list(back.runs) == ["surface", "point"]
    np.testing.assert_array_equal(back.runs["point"].contact_force, a_run(1.05).contact_force)
    assert back.runs["point"].contact_force.attrs == {"units": "N", "long_name": "force"}
    assert "position" in back.runs["point"].coords
    info = from_dataset(back.groups["irregularity"])
    assert info.spectrum.band == (0.08, 20.0)
    np.testing.assert_array_equal(info.profile.level, np.arange(5) * 1e-3)
    assert info.measured is None
    assert back.companions[0].name == "smooth" and back.companions[0].reference is None


def test_results_open_as_one_tree_that_shows_its_runs(tmp_path):
    write_results(results(), tmp_path)
    tree = open_results(tmp_path)
    assert list(tree.children) == ["irregularity", "surface", "point"]
    assert tree["point/contact_force"].attrs["units"] == "N" and tree.attrs["title"]
    assert open_results(tmp_path / "result.nc").identical(tree)
    assert read_results(tmp_path / "result.nc").metrics == read_results(tmp_path).metrics
    for shown in (repr(tree), repr(results()), results()._repr_html_()):
        assert "surface" in shown and "contact_force" in shown


def test_runs_of_variants_are_groups_of_groups(tmp_path):
    runs = {f"{variant}/{run}": a_run() for variant in ("a", "b") for run in ("one", "two")}
    write_results(results(runs=runs, reference=None), tmp_path)
    back = read_results(tmp_path)
    assert list(back.runs) == list(runs) and list(back.groups) == ["irregularity"]
    assert list(open_results(tmp_path)["a"].children) == ["one", "two"]


def test_times_stay_out_of_the_result_file_and_bytes_repeat(tmp_path):
    slow = a_run()
    slow.attrs["seconds_setup"] = 99.0
    write_results(results(), tmp_path / "a")
    write_results(results(runs={"surface": slow, "point": a_run(1.05)}), tmp_path / "b")
    assert (tmp_path / "a/result.nc").read_bytes() == (tmp_path / "b/result.nc").read_bytes()


def test_histories_of_many_wheels_are_compressed_without_loss(tmp_path):
    """Also in the group of a variant; what other programs read is the same."""
    history = np.random.default_rng(1).normal(scale=1e3, size=(4, 20_000)).cumsum(axis=1)
    history = np.repeat(history, 2, axis=0)  # both wheels of each wheelset
    run = a_run().assign(wheel_acceleration=(("wheel", "instant"), history))
    write_results(results(runs={"small": a_run(), "one/large": run}), tmp_path)
    assert (tmp_path / "result.nc").stat().st_size < 0.55 * history.nbytes
    np.testing.assert_array_equal(
        read_results(tmp_path).runs["one/large"].wheel_acceleration, history
    )
    with xr.open_datatree(tmp_path / "result.nc") as tree:
        np.testing.assert_array_equal(tree["one/large"].wheel_acceleration, history)


def test_nothing_but_the_two_files_is_left(tmp_path):
    write_results(results(), tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["metrics.json", "result.nc"]


@pytest.mark.parametrize("content", [b"", b"not a netCDF file", None])
def test_damaged_results_are_one_clear_error(tmp_path, content):
    write_results(results(), tmp_path)
    path = tmp_path / "result.nc"
    path.write_bytes(path.read_bytes()[:3000] if content is None else content)
    with pytest.raises(InputError, match="run the study again"):
        read_results(tmp_path)

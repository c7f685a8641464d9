"""Signals that a user chooses: the numbers of the results, and files that can be read."""

import csv
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from matplotlib.image import imread

from contactstudy import cli
from contactstudy.exceptions import InputError
from contactstudy.figures.chosen import _figure, traces, within, write_traces
from contactstudy.plot.style import figure_style
from contactstudy.study.results import StudyResults, write_results

T = np.linspace(0.0, 1.0, 11)


def a_run(factor):
    return xr.Dataset(
        {
            "contact_force": ("time", factor * T, {"units": "N", "long_name": "contact force"}),
            "station_displacement": (("station", "time"), np.outer([1, 2], T), {"units": "m"}),
            "text": ("time", [str(t) for t in T]),
            "pressure": (("instant", "point"), np.ones((2, 3)), {"units": "Pa"}),
        },
        {
            "time": ("time", T, {"units": "s"}),
            "position": ("time", 10.0 + 50.0 * T, {"units": "m"}),
            "station": [12.0, 18.0],
        },
    )


@pytest.fixture
def results():
    return StudyResults(
        name="mine", title="", description="", config={}, units={}, reference="surface",
        runs={"surface": a_run(1.0), "point": a_run(2.0)}, metrics={},
    )  # fmt: skip


def test_numbers_are_those_of_the_results(results):
    surface, point = traces(results, ["contact_force"], [])
    assert (surface.abscissa, surface.abscissa_unit) == ("position", "m")
    np.testing.assert_array_equal(point.x, 10.0 + 50.0 * T)
    np.testing.assert_array_equal(point.values, 2.0 * T)
    first, second = traces(results, ["station_displacement"], ["point"], over="time")
    assert (first.label, second.label) == ("point, station 12", "point, station 18")
    np.testing.assert_array_equal(second.values, 2.0 * T)
    np.testing.assert_array_equal(second.x, T)


def test_what_a_sweep_measured_is_drawn_over_its_key(results, tmp_path):
    """Dimensions of texts (run, signal, part) tell curves apart."""
    speed = ("journey.speed", [20.0, 40.0, 80.0], {"units": "m/s"})
    data = xr.Dataset(
        {"relative_l2": (("journey.speed", "run", "part"), np.arange(12.0).reshape(3, 2, 2))},
        {"journey.speed": speed, "run": ["a", "b"], "part": ["total", "dynamic"]},
    )
    swept = StudyResults(**{**vars(results), "runs": {}, "groups": {"sweep": data}})
    found = traces(swept, ["relative_l2"], [])
    assert [t.label for t in found][1] == "sweep, a, dynamic"
    np.testing.assert_array_equal(found[1].x, speed[1])
    np.testing.assert_array_equal(found[1].values, [1.0, 5.0, 9.0])
    write_traces(found, None, tmp_path / "a.csv")
    head, first, *_ = list(csv.reader((tmp_path / "a.csv").open()))
    assert head == ["group", "run", "part", "journey.speed (m/s)", "relative_l2 ()"]
    assert first == ["sweep", "a", "total", "20.0", "0.0"]


def test_too_many_curves_are_refused(results, tmp_path):
    run = results.runs["point"]
    run["field"] = (("instant", "time"), np.ones((2, 11)))
    many = traces(results, ["contact_force"], []) * 20
    for k, one in enumerate(many):
        many[k] = replace(one, run=f"run {k}")
    with pytest.raises(InputError, match="40 curves, more than the 36 that a picture"):
        write_traces(many, None, tmp_path / "a.png")
    long = run.isel(time=np.zeros(2000, dtype=int)).assign_coords(instant=[1.0, 2.0])
    results.runs["point"] = long.assign_coords(time=np.arange(2000.0))
    assert len(traces(results, ["field"], ["point"], over="time")) == 2
    with pytest.raises(InputError, match="field of point has 2000 curves, more than 1000"):
        traces(results, ["field"], ["point"], over="instant")


def test_signals_over_different_abscissae_are_not_mixed(results):
    run = results.runs["point"]
    run["level"] = ("band", np.arange(3.0), {"units": "dB"})
    results.runs["point"] = run.assign_coords(band=("band", [4.0, 5.0, 6.3], {"units": "Hz"}))
    told = r"contact_force is over position, level is over band; --over chooses one"
    with pytest.raises(InputError, match=told):
        traces(results, ["contact_force", "level"], ["point"])
    assert traces(results, ["level"], ["point"])[0].abscissa == "band"


def test_the_legend_names_the_curves_of_all_panels(results):
    found = traces(results, ["contact_force", "station_displacement"], ["point"], over="time")
    with figure_style():
        (legend,) = _figure(found, None).legends
    names = [text.get_text() for text in legend.get_texts()]
    assert names == ["point", "point, station 12", "point, station 18"]


@pytest.mark.parametrize(
    ("signal", "attrs", "label", "scale"),
    [
        ("contact_force", {"units": "N"}, "Force (kN)", 1e-3),
        ("deck_displacement", {"units": "m"}, "Displacement (mm)", 1e3),
        (
            "pier_displacement",
            {"units": "m", "long_name": "displacement of the pier's top, up"},
            "Displacement (mm)",
            1e3,
        ),
        ("deck_strain", {"units": "1", "long_name": "strain of the deck"}, "Strain", 1.0),
        ("heave", {"units": "m/s^2"}, "Heave (m/s²)", 1.0),
    ],
)
def test_an_axis_has_its_quantity_and_unit(results, signal, attrs, label, scale):
    values = xr.Variable("time", T, attrs)
    results = replace(results, runs={"point": a_run(1.0).assign({signal: values})})
    with figure_style():
        (axes,) = _figure(traces(results, [signal], []), None).axes
        assert axes.get_ylabel() == label
        np.testing.assert_allclose(axes.lines[0].get_ydata(), scale * T)


def test_a_part_is_cut_out(results):
    for trace in within(traces(results, ["contact_force"], []), 20.0, 30.0):
        np.testing.assert_allclose(trace.x, [20.0, 25.0, 30.0])
    with pytest.raises(InputError, match="reach from 10 to 60 m"):
        within(traces(results, ["contact_force"], []), 70.0, 80.0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((["contact_forc"], []), "did you mean 'contact_force'"),
        ((["contact_force"], ["points"]), "did you mean 'point'"),
        ((["text"], []), "signal text: not in surface, point"),
        ((["pressure"], []), "there are contact_force, station_displacement"),
        ((["contact_force"], [], "angle"), "is over position, time"),
    ],
)
def test_what_is_not_there_is_named(results, arguments, message):
    with pytest.raises(InputError, match=message):
        traces(results, *arguments)


def test_a_table_holds_every_number(results, tmp_path):
    found = traces(results, ["contact_force", "station_displacement"], [])
    write_traces(found, "surface", tmp_path / "a.csv")
    with (tmp_path / "a.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    assert list(rows[0]) == [
        "run", "station", "position (m)", "contact_force (N)", "station_displacement (m)",
    ]  # fmt: skip
    forces = [r for r in rows if r["run"] == "point" and r["station"] == ""]
    assert [float(r["contact_force (N)"]) for r in forces] == list(2.0 * T)
    at = [r for r in rows if r["run"] == "point" and r["station"] == "18.0"]
    assert [float(r["station_displacement (m)"]) for r in at] == list(2.0 * T)
    assert [float(r["position (m)"]) for r in at] == list(10.0 + 50.0 * T)


@pytest.mark.parametrize("ending", ["png", "pdf", "svg", "csv"])
def test_the_command_writes_equal_files_twice(results, tmp_path, ending):
    write_results(results, tmp_path)
    files = [tmp_path / f"{k}.{ending}" for k in range(2)]
    for file in files:
        arguments = ["--signal", "contact_force,station_displacement", "--x", "2000 cm..30"]
        assert cli.main(["plot", str(tmp_path), *arguments, "--out", str(file)]) == 0
    assert files[0].read_bytes() == files[1].read_bytes()
    if ending == "png":
        assert imread(files[0]).ndim == 3


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--out", "a.jpg"], "must end in .csv, .pdf, .png or .svg"),
        (["--out", "a.png", "--x", "10"], "FROM..TO"),
        (["--out", "a.png", "--x", "20..10"], "smaller to a larger"),
        (["--out", "a.png", "--x", "10 kg..20 kg"], "wrong unit 'kg'"),
    ],
)
def test_wrong_options_are_one_message(results, tmp_path, capfd, monkeypatch, arguments, message):
    write_results(results, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert cli.main(["plot", ".", "--signal", "contact_force", *arguments]) == 2
    assert message in capfd.readouterr().err
    assert sorted(p.name for p in tmp_path.iterdir()) == ["metrics.json", "result.nc"]

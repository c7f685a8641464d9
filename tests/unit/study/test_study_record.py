"""Passages held against a measured record: read, refused, laid over each other, drawn."""

import re

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.figures import measured as figure
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.held_against import (
    held_against,
    reversed_sentences,
    to_dataset,
)
from contactstudy.study.kinds.passage.inputs import read_inputs, work
from contactstudy.study.kinds.passage.record import MeasuredRecord
from contactstudy.study.kinds.passage.report.measured_table import (
    measured_sentences,
    measured_tables,
)
from contactstudy.study.loading import load_study
from contactstudy.study.results import StudyResults

FILE = """
[irregularity]
spectrum = "smooth"
[track]
length = "12 m"
[journey]
from = "3 m"
to = "9 m"
speed = "40 m/s"
fade_in = "0.1 m"
time_step = "0.5 ms"
stations = ["5.7 m", "6 m"]
[measured]
file = "record.csv"
channels = ["pad = station_displacement at 6 m", "bay = station_displacement at 5.7 m"]
unit = "um"
{keys}
[runs.one]
solver = "point"
k_r = "hertz_tangent"
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plain")
    path = folder / "plain.toml"
    text = FILE.format(keys="")
    path.write_text(text[: text.index("[measured]")] + text[text.index("[runs.one]") :])
    return execute_run(load_study(path), "one")


def written(folder, run, shift=0.2, scale=0.8, name="record.csv", unit=1e6, head="t"):
    """The run's own signals as a record: later by the shift, scaled, at another rate."""
    t = np.arange(0.0, 0.5, 1 / 1024)
    rows = [
        scale * unit * np.interp(t - shift, run.time, run.station_displacement.sel(station=x))
        for x in (6.0, 5.7)
    ]
    lines = [f"{head},pad,bay", *(f"{a:.9g},{b:.9g},{c:.9g}" for a, b, c in zip(t, *rows,
             strict=True))]  # fmt: skip
    (folder / name).write_text("\n".join(lines))


def study(folder, keys=""):
    path = folder / "record.toml"
    path.write_text(FILE.format(keys=keys))
    return load_study(path)


def test_a_record_of_the_run_itself_is_found_again(tmp_path, run):
    written(tmp_path, run)
    made = study(tmp_path, 'scale = "fitted"')
    found = held_against(made.measured, {"one": run})["runs"]["one"]
    assert found["shift"] == pytest.approx(-0.2, abs=1e-4)
    assert found["scale"] == pytest.approx(0.8, rel=1e-3)
    assert set(found["channels"]) == {"pad", "bay"}
    for one in found["channels"].values():
        assert one["correlation"] > 0.9999 and one["normalised_error"] < 0.01
        assert one["peak_ratio"] == pytest.approx(1.0, abs=2e-3) and abs(one["timing"]) < 1e-4


@pytest.mark.parametrize("keys", ['scale = "fitted"', "shift = -0.2", 'zero = "fitted"'])
def test_a_gauge_that_counts_the_other_way_is_named(tmp_path, run, keys):
    written(tmp_path, run)
    lines = [line.split(",") for line in (tmp_path / "record.csv").read_text().splitlines()]
    turned = [",".join([t, str(-float(a)), b]) for t, a, b in lines[1:]]
    (tmp_path / "record.csv").write_text("\n".join(["t,pad,bay", *turned]))
    found = held_against(study(tmp_path, keys).measured, {"one": run})["runs"]
    (told,) = reversed_sentences(found)
    assert told.startswith("pad agrees better with the opposite sign")
    (instead,) = re.findall('"(.*)"', told)
    assert instead == "pad = -station_displacement at 6 m"
    path = tmp_path / "record.toml"
    path.write_text(path.read_text().replace("pad = station_displacement at 6 m", instead))
    mended = held_against(load_study(path).measured, {"one": run})["runs"]
    assert reversed_sentences(mended) == []
    assert mended["one"]["channels"]["pad"]["correlation"] > 0.9999


def test_units_rates_and_given_values(tmp_path, run):
    written(tmp_path, run, unit=1e3, head="ms")
    text = (tmp_path / "record.csv").read_text().splitlines()
    table = MeasuredRecord(
        file=str(tmp_path / "record.csv"), unit="mm", time_column="", rate=1024.0,
        channels=("pad = station_displacement at 600 cm",), shift=-0.2, scale=0.5,
    )  # fmt: skip
    assert len(text) == 513
    record = table.read()
    np.testing.assert_allclose(record.time, np.arange(512) / 1024)
    assert record.values.min() == pytest.approx(0.8 * float(run.station_displacement[1].min()),
                                                rel=2e-3)  # fmt: skip
    found = held_against(table, {"one": run})
    one = found["runs"]["one"]
    assert (one["shift"], one["scale"]) == (-0.2, 0.5)
    assert one["channels"]["pad"]["peak_ratio"] == pytest.approx(0.5 / 0.8, rel=2e-3)
    assert found["method"] == "shift as given"


def test_another_record_computes_nothing_again_but_the_norms(tmp_path, run):
    keys = []
    for scale in (0.8, 0.7):
        written(tmp_path, run, scale=scale)
        made = study(tmp_path)
        inputs = read_inputs(made)
        assert inputs.config["measured"]["file"] == "record.csv"
        assert inputs.files["record.csv"]
        keys.append(work(made, inputs)[0].inputs)
        group = inputs.groups()["measured"]
        assert set(group.data_vars) == {"pad", "bay"} and group["pad"].attrs["units"] == "m"
    assert keys[0] == keys[1]


def results_of(tmp_path, run):
    written(tmp_path, run)
    made = study(tmp_path, 'scale = "fitted"')
    return StudyResults(
        "record", "Record", "", made.config(), made.units(), {"one": run}, None,
        {"runs": {}, "comparisons": {}, "measured": held_against(made.measured, {"one": run})},
        groups={"measured": to_dataset(made.measured)},
    )  # fmt: skip


def test_record_and_run_are_drawn_over_each_other(tmp_path, run):
    results = results_of(tmp_path, run)
    (drawing,) = figure.drawings(results)
    assert "pad: station displacement at 6 m" in drawing.caption
    assert "record shifted by −0.2000 s" in drawing.caption and "scale 0.8" in drawing.caption
    (told,) = measured_sentences(results)
    assert "with one scale and one shift" in told and "one has a correlation of 1.00" in told
    drawn = drawing.draw()
    panels = drawn.axes
    assert len(panels) == 2
    grey, computed = panels[0].lines
    # both at the same time of the run, within a sample of the record
    at = [line.get_xdata()[np.argmin(line.get_ydata())] for line in (grey, computed)]
    assert at[0] == pytest.approx(at[1], abs=1.1e-3)
    assert np.min(computed.get_ydata()) == pytest.approx(np.min(grey.get_ydata()), rel=5e-3)
    (table,) = measured_tables(results)
    assert [row[:2] for row in table["rows"]] == [["one", "pad"], ["one", "bay"]]


def test_a_run_that_cannot_be_laid_over_is_told(tmp_path, run):
    results = results_of(tmp_path, run)
    results.metrics["measured"]["runs"]["one"] = {"failure": "no common time"}
    assert figure.drawings(results) == []
    (said,) = measured_tables(results)
    assert said["parts"][0]["text"] == "one: no common time."


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("shift = 1.0", r"measured\.shift = 1 s: .* has no common time with the run, 0 to 0\.15 s"),
        ('shift = "-2 s"', r"no common time"),
        ('time_unit = "ms"', r"lasts 0\.000499 s \(measured.time_unit or measured.rate\)"),
        ("scale = 0", r"measured\.scale = 0"),
        ('time_column = "clock"', r"there is no column 'clock'; the file has: t, pad, bay"),
        ('rate = "1 kHz"', r'measured\.rate = 1000.0: applies only with measured.time_column = ""'),
        ('time_column = ""', r"measured\.time_column: is missing; or give measured\.rate"),
    ],
)
def test_impossible_records_name_the_key(tmp_path, run, keys, message):
    written(tmp_path, run)
    with pytest.raises(InputError, match=message):
        study(tmp_path, keys)


@pytest.mark.parametrize(
    ("replaced", "by", "message"),
    [
        ('unit = "um"', 'unit = "kN"', r"has the wrong unit 'kN'; allowed: m and its multiples"),
        ('unit = "um"', 'unit = "parsec?"', r"measured\.channels\.0"),
        ("station_displacement at 6 m", "station_displacment at 6 m",
         r"no signal station_displacment \(did you mean 'station_displacement'"),
        ("station_displacement at 6 m", "station_displacement", r"needs a place"),
        ("station_displacement at 6 m", "contact_force at 6 m", r"contact_force has no place"),
        ("station_displacement at 6 m", "station_displacement at 6.1 m",
         r"needs 6\.1 m among journey\.stations"),
        ('"pad = station_displacement at 6 m"', '"pad"', r'must be like "COLUMN = SIGNAL"'),
        ("pad = ", "rail = ", r"there is no column 'rail'"),
        ("pad = ", "t = ", r"channels\.0 = .* must be another column than measured\.time_column"),
        ("pad = ", "bay = ", r"channels\.1 = .* column 'bay' is named 2 times; allowed: once"),
        ('"record.csv"', '"none.csv"', r"none\.csv: there is no such file"),
    ],
)  # fmt: skip
def test_impossible_channels_name_the_key(tmp_path, run, replaced, by, message):
    written(tmp_path, run)
    path = tmp_path / "record.toml"
    path.write_text(FILE.format(keys="").replace(replaced, by))
    with pytest.raises(InputError, match=message):
        load_study(path)


def test_gaps_and_placeholders_are_refused_by_line(tmp_path, run):
    written(tmp_path, run)
    head, *rows = (tmp_path / "record.csv").read_text().splitlines()
    for k in (200, 201):
        t, _, bay = rows[k].split(",")
        rows[k] = f"{t},-999,{bay}"
    (tmp_path / "record.csv").write_text("\n".join([head, *rows[:300], *rows[330:]]))
    with pytest.raises(InputError) as error:
        study(tmp_path)
    gap, first, last = error.value.problems
    assert "lines 301 to 302: 0.03027 s without a row; allowed: at most 0.009766 s" in gap
    for line, told in ((202, first), (203, last)):
        assert f"line {line}, column 'pad' is -999, which looks like a placeholder" in told


def test_times_that_fall_and_records_that_are_too_short(tmp_path, run):
    for rows, message in (
        ("0,1,1\n2,1,1\n1,1,1\n3,1,1", "line 4: the time does not increase"),
        ("0,1,1\n1,1,1", "2 rows of numbers; allowed: 3 or more"),
        ("0,1,1\n1,x,1\n2,1,1", "line 3, column 'pad' is 'x'"),
        ("0,1,1\n.1,1,2\n.2,1,3", "column 'pad' is 1 throughout; there is nothing to lay over"),
        ("0,1,1\n10,2,2\n20,3,3", "samples are 10 s apart .* the run of 0.15 s needs 3 of them"),
    ):
        (tmp_path / "record.csv").write_text("t,pad,bay\n" + rows)
        with pytest.raises(InputError, match=message):
            study(tmp_path)


def test_without_a_file_nothing_is_compared(tmp_path):
    path = tmp_path / "record.toml"
    path.write_text(FILE.format(keys="").replace('file = "record.csv"', ""))
    made = load_study(path)
    assert not made.measured.used and "measured" not in made.config()
    with pytest.raises(InputError, match="a run cannot be called 'measured'"):
        path.write_text(FILE.format(keys="").replace("[runs.one]", "[runs.measured]"))
        load_study(path)


BRIDGE = """
[track]
structure = "bridge"
spans = "2 x 8 m"
approach_before = "12 m"
approach_behind = "12 m"
{track}
[vehicle]
type = "axle_loads"
[journey]
stations = ["16 m"]
[measured]
file = "record.csv"
channels = ["pad = {channel}"]
[runs.one]
solver = "point"
law = "moving_force"
"""


@pytest.mark.parametrize(
    ("channel", "track", "message"),
    [
        ("deck_lateral at 16 m", "", "needs a run in space"),
        ("pier_velocity at 20 m", "", r'needs track\.piers = "column"'),
        ("pier_velocity at 12 m", 'piers = "column"', "needs the X of a support, 20 m"),
        ("bearing_force at 21 m", "", "needs the X of a support, 12, 20, 28 m"),
        ("deck_velocity at 17 m", "", r"needs 17 m among journey\.stations"),
        ("station_strain at 16 m", 'structure = "ground"', r'needs track\.structure = "bridge"'),
        ("bearing_force at 20 m", "", ""),
        ("pier_lateral at 20 m", 'piers = "column"\nmotion = "space"', ""),
    ],
)
def test_channels_on_bridges_need_what_they_measure(tmp_path, run, channel, track, message):
    written(tmp_path, run)
    path = tmp_path / "bridge.toml"
    text = BRIDGE.format(channel=channel, track=track)
    if "ground" in track:
        text = text.replace('structure = "bridge"\nspans', "# spans").replace("approach", "# a")
    path.write_text(text)
    if not message:
        (only,) = load_study(path).measured.parsed
        assert only.at == 20.0
        return
    with pytest.raises(InputError, match=message):
        load_study(path)

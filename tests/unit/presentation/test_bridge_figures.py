"""Figures and tables of the results of a bridge: vibration, supports, strains, wheel forces."""

import json

import numpy as np
import pytest
import xarray as xr

from contactstudy.compare.running_safety import wheel_force_limit
from contactstudy.figures import supports, vibration, wheel_forces
from contactstudy.figures.train import repeat_length
from contactstudy.plot.style import figure_style
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.metrics import metrics
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.report import report
from contactstudy.study.kinds.passage.report.deck_table import deck_table
from contactstudy.study.kinds.passage.report.safety_table import safety_table
from contactstudy.study.kinds.passage.report.support_table import support_table
from contactstudy.study.kinds.passage.safety import safety_of
from contactstudy.study.results import StudyResults
from contactstudy.vehicle import Train

STATION = 17.3
SPEED = 60.0


@pytest.fixture(scope="module")
def results():
    made = parse_study(
        "figures",
        {
            "track": {"structure": "bridge", "spans": ["9 m", "9 m"], "approach_before": 12.0,
                      "approach_behind": 12.0, "piers": "column", "animation_frames": 4},
            "vehicle": {"type": "train", "cars": ["2 x high_speed_trailer"],
                        "model": "three_dimensional"},
            "journey": {"speed": SPEED, "time_step": 2e-3, "stations": [STATION], "to": 60.0},
            "irregularity": {"spectrum": "german_low"},
            "runs": {"one": {"solver": "point", "k_r": 1e9},
                     "forces": {"solver": "point", "law": "moving_force"}},
        },
    )  # fmt: skip
    runs = {name: execute_run(made, name) for name in made.runs}
    costs = {name: {"seconds": {}, "peak_memory_mb": None} for name in runs}
    return StudyResults(
        "figures", "F", "", made.config(), made.units(), runs, "one", metrics(made, runs, costs)
    )


def test_levels_of_rail_deck_and_pier_in_three_directions(results):
    levels, _ = vibration.drawings(results)
    with figure_style():
        axes = levels.draw().axes
    assert len(axes) == 9
    run = results.runs["one"]
    shown = axes[7].lines[0].get_ydata()  # Z of the deck
    np.testing.assert_array_equal(shown, run.deck_velocity_level.sel(station=STATION))
    # n v/L_c, cars of 25 m and more behind each other
    pitch = Train(cars=("2 x high_speed_trailer",)).repeat_length
    upright = [line.get_xdata()[0] for line in axes[7].lines[2:]]
    np.testing.assert_allclose(upright, SPEED / pitch * np.arange(1, 9), rtol=1e-3)
    assert "10⁻⁹ m/s (ISO 1683)" in levels.caption


def test_lines_of_the_spectrum_are_amplitudes(results):
    run = results.runs["one"].copy()
    x = np.atleast_2d(run.position.values)
    near = np.flatnonzero((np.abs(x - STATION) <= 10.0).any(axis=0))
    n, k = near[-1] - near[0] + 1, 7
    wave = 0.3 * np.cos(2 * np.pi * k * (np.arange(x.shape[1]) - near[0]) / n)
    run["deck_acceleration"] = (("station", "time"), wave[None])
    f, amplitude = vibration.spectrum(run, STATION)
    assert f[k] == pytest.approx(k / (n * run.attrs["dt"]))
    expected = np.where(np.arange(len(f)) == k, 0.3, 0.0)
    np.testing.assert_allclose(amplitude, expected, atol=1e-12)


def test_the_spectrum_has_a_second_axis_in_n(results):
    _, made = vibration.drawings(results)
    with figure_style():
        figure = made.draw()
    (axes,) = figure.axes
    (second,) = axes.child_axes
    base = SPEED / Train(cars=("2 x high_speed_trailer",)).repeat_length
    figure.draw_without_rendering()
    np.testing.assert_allclose(
        second.get_xlim(), np.array(axes.get_xlim()) / base, rtol=1e-3, atol=1e-12
    )


def test_lengths_that_repeat_are_those_of_the_run_if_it_has_outlines():
    run = xr.Dataset({"car_outline": (("car", "end"), [[3.0, 0, 0, 0], [-21.0, 0, 0, 0]])})
    assert repeat_length({"type": "train", "cars": ["gone.toml"]}, run) == 24.0
    assert repeat_length({"type": "train", "cars": ["gone.toml"]}) is None


def test_supports_and_strains(results):
    forces, strains = supports.drawings(results)
    with figure_style():
        assert len(forces.draw().axes) == 6
        axes = strains.draw().axes
    run = results.runs["one"]
    np.testing.assert_allclose(
        axes[1].lines[0].get_ydata(), 1e6 * run.deck_strain.sel(station=STATION)
    )
    assert supports.loaded_support(results) == 1  # the one with a pier
    most = 1e-3 * float(np.abs(run.bearing_force[1]).max())
    assert f"Z {most:.3g}"[:5] in forces.caption
    (table,) = support_table(results)
    assert [c["title"] for c in table["columns"]][1:3] == ["Force X (kN)", "Force Y (kN)"]
    assert all("(21.0" in row[-1] for row in table["rows"])  # only there is a pier


def test_twist_of_the_track_by_brute_force(results):
    (table,) = deck_table(results)
    assert table["columns"][-1]["title"] == "Twist (mm)"
    run, most = results.runs["one"], 0.0
    rail, x = run.node_part.values == 0, run.node_x.values
    up = run.frame_displacement.sel(axis="Z").values
    for k in range(len(up)):
        cross = {}
        for node in np.flatnonzero(rail & (x >= 12.0) & (x <= 30.0)):
            side = 1.0 if run.node_chain.values[node] else -1.0
            cross[round(x[node], 6)] = cross.get(round(x[node], 6), 0.0) + side * up[k, node]
        # seats are 0.6 m apart, 3 m is five bays
        most = max(most, *(abs(cross[round(a + 3.0, 6)] - cross[a]) for a in cross if a < 26.9))
    assert float(table["rows"][0][-1]) == pytest.approx(1e3 * most, rel=0.05)
    # 32 m box over 9 m with rails and sleepers: f = pi/(2 L^2) sqrt(E I_z/m)
    mass = 34e3 + 2 * (60.21 + 125.5 / 0.6)
    expected = np.pi / (2 * 81) * np.sqrt(34.5e9 * 86.2 / mass)
    assert f"here {expected:.0f} Hz simply supported" in table["note"]


def test_wheel_forces_against_brute_force(results):
    found = results.metrics["wheel_forces"]
    assert list(found) == ["one"]  # moving forces do not feel the rail
    run, one = results.runs["one"], found["one"]
    np.testing.assert_allclose(one["largest_q"], run.contact_force.values.max(axis=1))
    np.testing.assert_allclose(one["largest_y"], np.abs(run.lateral_force.values).max(axis=1))
    assert len(one["track_shift"]) == 8 and len(one["quotient"]) == 16
    # a mean over 2 m of what is slower than 20 Hz is less than the largest value
    assert np.all(np.array(one["quotient"]) < run.derailment_quotient.values.max(axis=1) + 0.02)
    assert np.all(np.array(one["unloading"]) < 1.0 - np.array(one["smallest_q"]) / 60e3)
    json.dumps(found, allow_nan=False)


def test_a_slow_lateral_force_is_found_as_it_is(results):
    """With Y = 30 kN outwards on Q = 60 kN, Y/Q is 0.5 and both wheels of a set cancel."""
    run = results.runs["one"].copy()
    outwards = np.where(run.rail.values == 1, 1.0, -1.0)[:, None] * np.ones(run.sizes["time"])
    run["contact_force"] = (("wheel", "time"), 60e3 * np.abs(outwards))
    run["lateral_force"] = (("wheel", "time"), 30e3 * outwards)
    one = safety_of({"one": run})["one"]
    np.testing.assert_allclose(one["quotient"], 0.5, rtol=1e-9)
    np.testing.assert_allclose(one["track_shift"], 0.0, atol=1e-6)


def test_wheel_forces_in_figure_and_table(results):
    (made,) = wheel_forces.drawings(results)
    with figure_style():
        upper, lower = made.draw().axes
    assert lower.get_ylabel() == "Y/Q"
    one = results.metrics["wheel_forces"]["one"]
    np.testing.assert_allclose(upper.lines[0].get_ydata(), 100 * np.array(one["unloading"]))
    (table,) = safety_table(results)
    worst = int(np.argmax(one["unloading"])) // 2 + 1
    assert table["rows"][0][4].endswith(f"({worst})")
    static = min(results.runs["one"].attrs["static_load"])
    assert f"at most {1e-3 * wheel_force_limit(static, SPEED):.0f} kN" in table["note"]
    assert "EN 14363" in table["note"]


def test_the_report_has_them(results):
    parts = {part["title"]: part for part in report(results).parts}
    files = [b.get("file", "") for b in parts["Motion of the bridge"]["blocks"]]
    for name in ("bridge_passage", "velocity_levels", "deck_spectrum", "support_forces", "strains"):
        assert f"figures/{name}.pdf" in files
    assert parts["Wheel forces"]["blocks"]

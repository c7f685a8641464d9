"""Ladders, journeys over sinusoids, companions of companions."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.exceptions import InputError
from contactstudy.figures.ladder import ladder
from contactstudy.figures.stiffness import Curve
from contactstudy.solvers.journey import Journey
from contactstudy.study.kinds.passage.metrics import compare_runs, rungs
from contactstudy.study.kinds.passage.report.rungs import rung_tables, sentences
from contactstudy.study.loading import base_of, load_companions, load_study
from contactstudy.study.results import StudyResults


def run_of(force):
    x = np.linspace(0.0, 10.0, len(force))
    data = {"contact_force": ("time", force), "position": ("time", x)}
    return xr.Dataset(data, {"time": x / 50.0})


def made_ladder(amplitudes):
    """Runs whose dynamic part is a sine of an amplitude, so that all norms are known."""
    wave = np.sin(2 * np.pi * np.linspace(0.0, 5.0, 2001))
    return {name: run_of(1000.0 + a * wave) for name, a in amplitudes.items()}


def test_each_rung_is_compared_with_the_run_above_it():
    runs = made_ladder({"top": 10.0, "middle": 11.0, "low": 22.0})
    found = rungs(runs, 0.0)
    assert [one["above"] for one in found.values()] == ["top", "middle"]
    steps = [one["contact_force"]["relative_l2_dynamic"] for one in found.values()]
    np.testing.assert_allclose(steps, [0.1, 1.0], rtol=1e-12)


def test_decks_are_compared_over_all_their_stations():
    """A gain of 10 % at one station and none at another of twice its size; one beside the deck."""
    wave = np.sin(2 * np.pi * np.linspace(0.0, 5.0, 2001))
    nothing = np.full_like(wave, np.nan)
    made = {
        name: run_of(wave + 5.0).assign(
            deck_displacement=(("station", "time"), [nothing, gain * wave, 2.0 * wave]),
            deck_displacement_smooth=(("station", "time"), [nothing, 0.0 * wave, 2.0 * wave]),
        )
        for name, gain in (("top", 1.0), ("low", 1.1))
    }
    found = rungs(made, 0.0)["low"]["deck_displacement"]
    assert found["relative_l2"] == pytest.approx(0.1 / np.sqrt(5.0))
    assert found["relative_l2_irregularity"] == pytest.approx(0.1)


def test_sentences_of_a_ladder_follow_from_its_numbers():
    runs = made_ladder({"top": 10.0, "near": 10.1, "far": 15.0, "back": 12.0})
    top = {
        name: {"contact_force": {"relative_l2": 0.0, "relative_l2_dynamic": abs(a / 10.0 - 1.0)}}
        for name, a in (("near", 10.1), ("far", 15.0), ("back", 12.0))
    }
    results = results_of(runs, {"rungs": rungs(runs, 0.0), "comparisons": top})
    (text,) = sentences(results)
    assert "largest step, 48.5 %, is that from near to far" in text
    assert "All rungs above far are within 1.00 % of the top" in text
    assert "back (20.0 %): errors that cancel" in text
    assert [r.above for r in ladder(results)] == ["top", "near", "far"]


def test_tables_of_a_ladder_hold_all_signals_from_the_top_and_from_above():
    runs = made_ladder({"top": 10.0, "near": 11.0, "far": 22.0})
    for run in runs.values():
        run["rail_acceleration"] = 2.0 * (run["contact_force"] - 1000.0)
        run["contact_force_smooth"] = 0.0 * run["contact_force"] + 1000.0
    top = {name: compare_runs(runs[name], runs["top"], 0.0, bands=False) for name in runs}
    results = results_of(runs, {"rungs": rungs(runs, 0.0), "comparisons": top})
    tables = rung_tables(results)
    columns = ["Rung", "Force, total", "Force, dynamic part", "Force, part of the irregularity"]
    columns.append("Rail acceleration under the wheel")
    assert all([c["title"] for c in t["columns"]] == columns for t in tables)
    (near, far), (near_above, far_above) = (t["rows"] for t in tables)
    assert (near[2:], far[2:]) == (["10.0"] * 3, ["120"] * 3)
    assert (near_above[2:], far_above[2:]) == (["10.0"] * 3, ["100"] * 3)


def results_of(runs, metrics):
    return StudyResults(
        name="l", title="l", description="", config={}, units={}, runs=runs,
        reference="top", metrics=metrics,
    )  # fmt: skip


def test_a_journey_fits_a_sinusoid_and_keeps_what_is_given():
    short, long = Journey(start=3.0).fitting(0.02, 0.6), Journey(start=3.0).fitting(3.0, 0.6)
    # a bay of fade-in and two bays; three waves behind a wave of fade-in
    assert (short.fade_in, short.end) == pytest.approx((0.6, 4.8), rel=1e-14)
    assert (long.fade_in, long.end) == pytest.approx((3.0, 15.0), rel=1e-14)
    assert short.speed * short.time_step == pytest.approx(0.02 / 40, rel=1e-14)
    assert long.time_step == 1e-4
    kept = Journey(end=12.5, time_step=1e-5).fitting(0.02, 0.6)
    assert (kept.end, kept.time_step, kept.fade_in) == (12.5, 1e-5, 0.6)


def test_a_study_over_a_sinusoid_has_the_journey_that_fits():
    values = {"irregularity.wavelength": "0.1 m", "journey.speed": "100 m/s"}
    journey = base_of(load_study("trust_reference", values)).journey
    assert journey.time_step == pytest.approx(0.1 / 40 / 100.0, rel=1e-12)
    given = base_of(load_study("trust_reference", values | {"journey.time_step": "10 us"})).journey
    assert given.time_step == 1e-5


def test_a_run_may_have_a_multiple_of_the_journeys_time_step():
    values = {"irregularity.wavelength": "0.1 m", "journey.speed": "100 m/s"}
    half = values | {"runs.modal_surface.time_step": "0.5 x journey"}
    found = [base_of(load_study("trust_reference", v)) for v in (values, half)]
    run, journeys = "modal_surface", [s.journey.time_step for s in found]
    assert journeys[0] == journeys[1] == found[0].time_step(run)
    assert found[1].time_step(run) == pytest.approx(0.5 * journeys[0], rel=1e-15)
    assert found[1].config()["runs"][run]["time_step"] == found[1].time_step(run)
    for wrong in ("0 x journey", "2 x tangent", "-1 x journey", "1e9 x journey"):
        with pytest.raises(InputError, match=r"runs\.modal_surface\.time_step"):
            load_study("trust_reference", values | {"runs.modal_surface.time_step": wrong})


def test_companions_of_a_companion_are_planned_and_theirs_are_not():
    (reference,) = load_companions(load_study("trust_map"), last=True)
    assert reference.name == "trust_reference" and reference.companions == ()
    inner = next(c for c in load_companions(load_study("error_study")) if c.name == "trust_map")
    assert inner.companions == ("trust_reference",)


def test_the_best_stiffness_is_that_of_a_parabola_of_logarithms():
    k_r = np.geomspace(0.25, 16.0, 9)
    error = np.exp(1.0 + 0.4 * np.log(k_r / 1.3) ** 2)
    at, least = Curve("", "", k_r, error).best
    assert (at, least) == pytest.approx((1.3, np.e), rel=1e-10)
    assert Curve("", "", k_r, k_r).best == (0.25, 0.25)  # none inside

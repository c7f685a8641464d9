"""Speeds of resonance and cancellation along the axis of a sweep; what is measured of decks."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from scipy.sparse.linalg import eigsh

from contactstudy.figures.axes import lines
from contactstudy.plot.text import number
from contactstudy.study.axes.shown import Shown
from contactstudy.study.kind import Marks, Quantity
from contactstudy.study.kinds.passage import measures
from contactstudy.study.kinds.passage.bridge_speeds import marks, speed_marks
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.report.deck_table import deck_sentences, deck_table
from contactstudy.study.loading import load_study
from contactstudy.track.bridge import Bridge
from contactstudy.track.model import GivenRail, Track
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import AxleLoads, FreightWagons, HighSpeedLoadModel, Train

# of the box with two rails 60E1 and their sleepers
MASS = 34e3 + 2 * (60.21 + 125.5 / 0.6)
F1 = math.pi / (2 * 32.0**2) * math.sqrt(34.5e9 * 10.947 / MASS)
BRIDGE = {"structure": "bridge", "spans": [32.0, 20.0], "deck": "box_32m"}


def test_resonance_and_cancellation_of_the_longest_span():
    vehicle = {"type": "train", "cars": ["s300_end", "3 x s300"], "model": "planar", "gaps": [0.0]}
    resonance, cancellation = speed_marks({"track": BRIDGE, "vehicle": vehicle})
    np.testing.assert_allclose(resonance.at[:3], F1 * 25.0 / np.array([1, 2, 3]))
    np.testing.assert_allclose(cancellation.at[:2], 64.0 * F1 / np.array([3, 5]))
    assert "L_c = 25.0 m" in resonance.caption


@pytest.mark.parametrize("vehicle", [{"type": "wheel_column"}, {"type": "train", "cars": ["s300"]},
                                     {"type": "train", "cars": ["gone.toml"]}])  # fmt: skip
def test_no_resonance_where_nothing_repeats(vehicle):
    (only,) = speed_marks({"track": BRIDGE, "vehicle": vehicle})
    assert only.name == "cancellation"


def test_the_first_frequency_is_that_of_the_whole_track():
    """Its eigenvalue, where rails hardly hold the deck's ends and bearings hardly give way."""
    bridge = Bridge(
        spans=(32.0,), bearing_stiffness=1e13, approach_before=12.0, approach_behind=12.0
    )
    track = Track(rail=GivenRail(EI=1e4, mass=60.21), structure=bridge)
    whole = StructureTrack(track)
    (square,) = eigsh(whole.stiffness, 1, whole.mass, sigma=0.0, return_eigenvectors=False)
    first = math.sqrt(square) / (2 * math.pi)
    (marked, _) = speed_marks({"track": track.resolved(), "vehicle": {"type": "hslm"}})
    f1 = marked.at[0] / HighSpeedLoadModel().repeat_length
    assert f1 == pytest.approx(first, rel=1e-3)
    assert bridge.deck.frequency(32.0) > 1.005 * first


def test_no_marks_without_a_bridge_or_with_one_that_varies():
    config = {"track": {"structure": "ground"}, "vehicle": {}}
    assert speed_marks(config) == []
    results = SimpleNamespace(config={"track": BRIDGE}, designs={})
    assert len(marks(results, "journey.speed")) == 1
    assert marks(results, "journey.time_step") == []
    both = xr.Dataset(
        {"variant": (("journey.speed", "track.spans"), [[0]])},
        {"journey.speed": [80.0], "track.spans": ["32 m"]},
    )
    results.designs = {"sweep": both}
    assert marks(results, "journey.speed") == []


def test_repeat_lengths():
    assert HighSpeedLoadModel(hslm="A4").repeat_length == 21.0
    assert FreightWagons(wagons=3).repeat_length == 11.25
    assert FreightWagons(wagons=1).repeat_length is None
    assert AxleLoads().repeat_length is None
    assert Train(cars=("s300_end", "3 x s300"), gaps=(0.5,)).repeat_length == 25.5


def test_marks_within_the_figure_are_drawn_in_its_unit():
    speeds = ("journey.speed", np.array([50.0, 60.0, 70.0]), {"units": "m/s"})
    data = xr.Dataset(
        {
            "variant": ("journey.speed", [0, 1, 2]),
            "value": ("journey.speed", [1.0, 2.0, 3.0]),
            "failure": ("journey.speed", ["", "", ""]),
        },
        {"journey.speed": speeds},
        {"design": "sweep", "refined": 0},
    )
    quantity = Shown("value", data, data["value"], "Value (mm)", Quantity("value", "Value"), {})
    given = [Marks("none", [10.0], "far"), Marks("resonance", [55.0, 65.0, 75.0], "resonance")]
    (made,) = lines.drawings(quantity, ["journey.speed"], lambda key: given)
    assert made.caption.endswith("Dashed: resonance: 198, 234.")
    (axes,) = made.draw().axes
    upright = [line.get_xdata()[0] for line in axes.lines[1:]]
    np.testing.assert_allclose(upright, [198.0, 234.0])


def test_dynamic_factor_at_the_station_that_moves_most():
    dynamic = [[np.nan] * 3, [0.0, -3.0, 1.0], [0.0, 0.5, 1.5]]
    static = [[np.nan] * 3, [0.0, -2.0, 0.5], [0.0, 0.1, 0.1]]
    run = xr.Dataset(
        {
            "deck_displacement": (("station", "time"), dynamic),
            "deck_static": (("station", "time"), static),
        }
    )
    assert measures._amplification(run) == 1.5
    assert measures._amplification(run.isel(station=[0])) is None
    assert measures._amplification(xr.Dataset()) is None


def test_the_shipped_sweep_is_louder_at_resonance_than_at_cancellation():
    study = load_study("train_speeds", quick=True).study
    resonance, cancellation = speed_marks(study.config())
    factors = []
    for speed in (resonance.at[0], cancellation.at[0]):
        at = replace(study, journey=study.journey.changed(speed=float(speed), time_step=2e-3))
        factors.append(measures._amplification(execute_run(at, "moving_force")))
    assert factors[0] > 1.5 * factors[1]


def test_largest_size_over_the_stations_of_decks():
    time = np.arange(0.0, 2.0, 1e-3)
    wave = np.sin(2 * np.pi * 10 * time) + 5.0 * np.sin(2 * np.pi * 400 * time)
    there = np.array([[np.nan], [2.0], [1.0]])  # the first station is beside the decks
    signals = {"deck_displacement": there * time, "deck_acceleration": there * wave}
    run = xr.Dataset(
        {name: (("station", "time"), values) for name, values in signals.items()},
        {"station": [5.0, 66.0, 90.0], "time": time},
    )
    found = measures.largest_of_deck(run, Track(structure=Bridge(spans=(32.0, 20.0))))
    # EN 1990 counts up to 9 f1 = 46 and 118 Hz here
    assert found["deck_acceleration"] == pytest.approx(2.0, rel=0.05)
    assert found["deck_displacement"] == pytest.approx(2.0 * time[-1])
    assert measures.largest_of_deck(run.isel(station=[0]), Track(structure=Bridge())) == {}
    few = measures.largest_of_deck(run.isel(time=slice(None, None, 100)), Track(structure=Bridge()))
    assert list(few) == ["deck_displacement"]  # samples too few for the filter


def test_a_sweep_has_the_acceleration_of_the_report_of_a_run():
    """Both as EN 1990 counts it, of a signal with louder high frequencies."""
    study = load_study("train_speeds", quick=True).study
    study = replace(
        study,
        journey=study.journey.changed(speed=90.0, time_step=2e-3),
        runs={"moving_force": study.runs["moving_force"]},
        reference=None,
    )
    run = execute_run(study, "moving_force")
    run["deck_acceleration"] = run["deck_acceleration"] + np.sin(2 * np.pi * 200 * run["time"])
    measured = measures.measure(study, {"moving_force": run})
    assert "contact_force" not in measured["largest"]["values"]["moving_force"]  # it is given
    swept = measured["largest_of_deck"]["values"]
    report = SimpleNamespace(runs={"moving_force": run}, config=study.config())
    (table,) = deck_table(report)
    cells = dict(zip((c["title"] for c in table["columns"]), table["rows"][0], strict=True))
    counted = swept["moving_force"]["deck_acceleration"]
    assert number(counted, 2) == cells["up to 45.7 Hz"]
    assert f"up to 45.7 Hz at most {number(counted, 2)} m/s²" in deck_sentences(report)[0]
    assert counted < 0.5 < float(np.abs(run["deck_acceleration"]).max())

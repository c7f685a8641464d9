"""The deck in figures and tables of a passage."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.figures import deck_damping
from contactstudy.figures.deck import drawings, largest_station
from contactstudy.study.kinds.passage.report.deck_table import deck_table


class Results:
    """What figures and tables take of the results of a study."""

    reference = "one"

    def __init__(self, **decks):
        time = np.linspace(0.0, 1.0, 5)
        self.runs = {
            name: xr.Dataset(
                {
                    key: (("station", "time"), np.outer(factors, [0.0, 1.0, 2.0, 1.0, 0.0]))
                    for key, factors in deck.items()
                },
                {"station": [5.0, 66.0, 90.0], "time": time},
            )
            for name, deck in decks.items()
        }
        self.config = {
            "track": {"structure": "bridge", "layer": "ballast", "spans": [32.0, 20.0],
                      "approach_before": 50.0, "deck": "antoing"},
            "journey": {"speed": 60.0},
        }  # fmt: skip


def deck(displacement, static=-1e-3, rate=0.5):
    return {
        "deck_displacement": [np.nan, displacement, 0.5 * displacement],
        "deck_static": [np.nan, static, 0.5 * static],
        "deck_acceleration": [np.nan, rate, rate],
    }


def test_the_station_that_moves_most_beside_the_codes():
    results = Results(one=deck(-1.2e-3), two=deck(-1.5e-3))
    assert largest_station(results) == 66.0
    (made,) = deck_table(results)
    rows = [row[1:] for row in made["rows"]]
    # samples four times a second are too few for a filter
    assert rows == [["2.40", "2.00", "1.20", "1.0", "–"], ["3.00", "2.00", "1.50", "1.0", "–"]]
    # the third frequency of a beam, 9 times the first
    assert made["columns"][-1]["title"] == "up to 70.2 Hz"
    assert "3.5 m/s²" in made["note"]
    # Antoing's section over 32 m: f = pi/(2 L^2) sqrt(EI/m) = 3.205 Hz (50/32)^2, with the mass of
    # two rails and sleepers sqrt(69000/69539) of it
    assert "span of 32.0 m with the track on it, 7.79 Hz" in made["note"]


def test_only_frequencies_count_that_en_1990_counts():
    results = Results(one=deck(-1.2e-3))
    run = results.runs["one"].interp(time=np.arange(0.0, 1.0, 1e-3))
    wave = (
        2.0 * np.sin(2 * np.pi * 10 * run.time) + 5.0 * np.sin(2 * np.pi * 400 * run.time)
    ).values
    run["deck_acceleration"] = (("station", "time"), np.outer([np.nan, 1.0, 1.0], wave))
    results.runs["one"] = run
    (made,) = deck_table(results)
    assert float(made["rows"][0][4]) > 6.0  # all frequencies
    assert float(made["rows"][0][5]) == pytest.approx(2.0, abs=0.1)


def test_drawn_with_the_largest_values_in_the_caption():
    (made,) = drawings(Results(one=deck(-1.2e-3)))
    assert made.name == "deck_motion"
    assert "one 2.40 mm and 1.0 m/s²" in made.caption
    assert len(made.draw().axes) == 2


def test_realised_damping_of_the_longest_span():
    results = Results(one=deck(-1.2e-3))
    (made,) = deck_damping.drawings(results)
    # 1 % at f and 4 f; between x f and 4 x f: (x + 4/x)/5, at 9 f
    assert "1.00 % at 7.83 Hz; 1.00 % at 31.3 Hz; 1.89 % at 70.4 Hz" in made.caption
    (axes,) = made.draw().axes
    curve, squares = axes.lines[0], axes.lines[1]
    np.testing.assert_allclose(squares.get_ydata(), [1.0, 1.0, (9.0 + 4.0 / 9.0) / 5.0])
    lowest = np.argmin(curve.get_ydata())
    # least at sqrt(f 4 f) = 2 f: 4/5 of it
    np.testing.assert_allclose(curve.get_xdata()[lowest], 2 * squares.get_xdata()[0], rtol=0.02)
    np.testing.assert_allclose(curve.get_ydata()[lowest], 0.8, rtol=1e-3)


def test_realised_damping_of_modes():
    results = Results(one=deck(-1.2e-3))
    results.config["track"] = dict(results.config["track"], deck_damping="modal")
    results.config["track"].pop("damping_frequencies", None)
    results.config["track"] |= {"modal_damping_up_to": 50.0, "bearing_stiffness": 1e13}
    (made,) = deck_damping.drawings(results)
    (axes,) = made.draw().axes
    squares = axes.lines[0]
    # bending at f, 4 f, 9 f and 16 f; 50 Hz lets two of them in
    frequencies = squares.get_xdata()
    np.testing.assert_allclose(frequencies, 7.83 * np.array([1, 4, 9, 16]), rtol=2e-3)
    np.testing.assert_allclose(squares.get_ydata(), [1.0, 1.0, 0.0, 0.0], atol=1e-12)
    assert "to 50.0 Hz has the ratio that was asked for, 1.00 %" in made.caption


def test_nothing_without_a_deck():
    nowhere = {key: [np.nan] * 3 for key in deck(1.0)}
    assert deck_table(Results(one=nowhere)) == []
    assert drawings(Results(one=nowhere)) == []
    assert deck_damping.drawings(Results(one=nowhere)) == []
    results = Results()
    results.runs = {"one": xr.Dataset()}
    assert drawings(results) == []
    assert deck_table(results) == []

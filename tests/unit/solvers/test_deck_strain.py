"""Strain of a deck against differences of its deflection, and against statics."""

import numpy as np
import pytest

from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.reading import parse_study

H = 0.05
SECOND_MOMENT = 0.2  # m^4; soft beside its bearings, which then are rigid


def run(track=None, stations=(), journey=None):
    made = parse_study(
        "strain",
        {
            "track": {
                "structure": "bridge", "spans": [10.0, 10.0], "deck": "given",
                "deck_second_moment": SECOND_MOMENT,
                "approach_before": 12.0, "approach_behind": 12.0, "gauge_depth": 0.4,
                "rail": "given", "bending_stiffness": 1e4, "ballast_stiffness": 1e9,
                "ballast_damping": 1e5, **(track or {}),
            },
            "vehicle": {"type": "axle_loads", "axle_loads": [200e3]},
            "journey": {
                "speed": 5.0, "time_step": 5e-3, "stations": list(stations), "fade_in": 0.1,
                **(journey or {}),
            },
            "irregularity": {"spectrum": "smooth"},
            "runs": {"one": {"solver": "point", "law": "moving_force"}},
        },
    )  # fmt: skip
    return execute_run(made, "one")


def test_strain_is_depth_times_the_second_difference_of_the_deflection():
    places = (16.83, 25.31)
    stations = sorted(x + d for x in places for d in (-H, 0.0, H))
    data = run(stations=stations)
    for x in places:
        w = [data.deck_displacement.sel(station=x + d, method="nearest").values
             for d in (-H, 0.0, H)]  # fmt: skip
        bend = 0.4 * (w[0] - 2 * w[1] + w[2]) / H**2
        strain = data.deck_strain.sel(station=x, method="nearest").values
        # a parabola's difference is exact, and a cubic deflection's within an element too
        np.testing.assert_allclose(strain, bend, atol=2e-3 * np.abs(bend).max())
        assert strain.max() > 5 * -strain.min()  # tension below where the axle is


def test_strain_in_the_middle_of_a_span_is_that_of_its_moment():
    data = run(stations=(17.0,))
    E, load = 34.5e9, 200e3
    # P L/4, spread over the seats of two bays of 0.6 m or so: a little less
    expected = 0.4 * load * 10.0 / 4 / (E * SECOND_MOMENT)
    assert float(data.deck_strain.max()) == pytest.approx(expected, rel=0.04)
    # on the other span it is at rest, as on the approaches
    far = data.deck_strain.isel(station=0, time=data.position[0] > 24.0)
    assert np.abs(far).max() < 0.02 * expected


def test_a_continuous_deck_is_in_compression_below_while_the_other_span_is_loaded():
    data = run({"spans_per_deck": 2}, stations=(17.0,))
    strain, x = data.deck_strain.isel(station=0), data.position[0]
    # two equal spans, load in the middle of the other: M = -3/64 P L; under it 13/64 P L
    bend = 0.4 * 200e3 * 10.0 / (34.5e9 * SECOND_MOMENT)
    here = float(strain[int(np.argmin(np.abs(x.values - 17.0)))])
    there = float(strain[int(np.argmin(np.abs(x.values - 27.0)))])
    assert here == pytest.approx(13 / 64 * bend, rel=0.05)
    assert there == pytest.approx(-3 / 64 * bend, rel=0.05)


def test_stations_on_the_approach_have_no_strain():
    data = run(stations=(5.0, 17.0))
    assert np.isnan(data.deck_strain.sel(station=5.0)).all()

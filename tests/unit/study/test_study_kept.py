"""Histories of several wheels and of stations that a sweep keeps."""

import numpy as np

from contactstudy.driver import compute_study
from contactstudy.study.loading import load_study

STUDY = """
[irregularity]
band = ["0.6 rad/m", "12 rad/m"]
[track]
length = "9.6 m"
[vehicle]
type = "VEHICLE"
[journey]
from = "4 m"
to = "4.6 m"
fade_in = "0 m"
time_step = "200 us"
stations = ["4.5 m", "5 m"]
[runs.point]
solver = "point"
"""
SWEEP = {
    "vehicle.type": ["bogie", "wheel_column"],
    "journey.speed": ["200 km/h", "300 km/h"],
    "keep": ["contact_force", "station_displacement"],
}


def test_histories_of_several_wheels_are_those_of_the_runs(tmp_path):
    file = tmp_path / "wheels.toml"
    file.write_text(STUDY.replace("VEHICLE", "bogie"))
    swept = compute_study(load_study(file, sweep=SWEEP), tmp_path / "all", 1, here=True)
    data = swept.designs["sweep"]
    assert data["contact_force"].dims[2:] == ("run", "wheel", "sample")
    assert data["time"].dims[2:] == ("run", "sample")
    for k, vehicle in enumerate(SWEEP["vehicle.type"]):
        given = {"vehicle.type": vehicle, "journey.speed": "300 km/h"}
        one = compute_study(load_study(file, given), tmp_path / vehicle, 1, here=True)
        run, place = one.runs["point"], {"vehicle.type": k, "journey.speed": 1, "run": 0}
        for name in ("contact_force", "position", "station_displacement"):
            expected, kept = np.atleast_2d(run[name].values), data[name].isel(place).values
            rows, steps = expected.shape
            np.testing.assert_array_equal(kept[:rows, :steps], expected)
            # fewer wheels and fewer steps than others end in nan
            assert np.isnan(kept[rows:]).all() and np.isnan(kept[:, steps:]).all()

"""Third-octave levels of a passage: of a sinusoid its amplitude, of the passage alone."""

import numpy as np
import pytest
import xarray as xr

from contactstudy.solvers.bridge_levels import REACH, velocity_levels

STEP, SPEED = 1e-3, 20.0


def levels(velocity, stations, offsets=(0.0, -40.0)):
    time = STEP * np.arange(velocity.shape[1])
    data = xr.Dataset(
        {"deck_velocity": (("station", "time"), velocity, {"long_name": "velocity"})},
        {"station": list(stations), "time": time},
        {"dt": STEP},
    )
    return velocity_levels(data, SPEED * time[:, None] + np.array(offsets))


def test_the_level_of_a_sinusoid_is_that_of_its_root_mean_square():
    t = STEP * np.arange(8000)
    amplitude = 2e-4
    made = levels(amplitude * np.sin(2 * np.pi * 20.0 * t)[None], [60.0])
    level = made.deck_velocity_level.sel(band=20.0).item()
    # ISO 1683: 0 dB at 1e-9 m/s
    assert level == pytest.approx(20 * np.log10(amplitude / np.sqrt(2) / 1e-9), abs=0.1)
    assert made.deck_velocity_level.sel(band=50.0).item() < level - 60.0
    assert made.deck_velocity_level.attrs["units"] == "dB"


def test_only_the_passage_counts():
    t = STEP * np.arange(8000)
    quiet = 1e-5 * np.sin(2 * np.pi * 20.0 * t)
    # from 10 m before the first wheel comes until 10 m behind the last one, 40 m behind
    passing = (SPEED * t >= 60.0 - REACH) & (SPEED * t <= 100.0 + REACH)
    loud = np.where(passing, quiet, 1.0)
    a, b = (levels(v[None], [60.0]).deck_velocity_level for v in (quiet, loud))
    np.testing.assert_array_equal(a, b)


def test_no_level_where_the_train_does_not_come_and_none_beyond_ten_steps_a_period():
    values = np.random.default_rng(1).normal(size=(2, 2000))
    made = levels(values, [20.0, 500.0])
    assert np.isnan(made.deck_velocity_level[1]).all()
    assert np.isfinite(made.deck_velocity_level[0]).all()
    assert made.band.values.max() == 100.0

"""Third-octave levels of a passage: of a sinusoid its amplitude, of the passage alone."""

import numpy as np
import pytest
import xarray as xr
from scipy.signal import butter, sosfilt

from contactstudy.solvers.bridge_levels import REFERENCE, velocity_levels

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


def burst(t, frequency, middle, width=0.1):
    return np.sin(2 * np.pi * frequency * t) * np.exp(-(((t - middle) / width) ** 2))


def total(made):
    return 10 * np.log10(np.nansum(10 ** (made.deck_velocity_level.values / 10)))


# from 10 m before the first wheel comes until 10 m behind the last one, 40 m behind
PASSING = (2.5, 5.5)


def test_only_the_passage_counts():
    t = STEP * np.arange(8000)
    inside = 1e-4 * burst(t, 20.0, 4.0)
    outside = 1e-4 * (burst(t, 20.0, PASSING[0] - 1.0) + burst(t, 20.0, PASSING[1] + 1.0))
    own, more, other = (
        levels(v[None], [60.0]).deck_velocity_level.sel(band=20.0).item()
        for v in (inside, inside + outside, outside)
    )
    assert more == pytest.approx(own, abs=0.1)
    assert other < own - 20.0  # an ideal filter of 4.6 Hz still hears what was a second ago


@pytest.mark.parametrize("middle", [2.8, 4.0, 5.2])
def test_the_bands_together_have_the_mean_square_of_the_passage(middle):
    """Parseval, wherever in the passage it shakes: also where a train comes and goes.

    But for what a filter spreads beyond the ends of the passage.
    """
    t = STEP * np.arange(8000)
    values = 1e-4 * (burst(t, 12.0, middle) + burst(t, 30.0, middle))
    part = values[(t >= PASSING[0]) & (t <= PASSING[1])]
    expected = 10 * np.log10(np.mean(part**2) / REFERENCE**2)
    assert total(levels(values[None], [60.0])) == pytest.approx(expected, abs=0.25)


def test_levels_are_those_of_an_instruments_filters():
    """Filters of IEC 61260 (Butterworth, order three) over a vibration that goes on."""
    t = STEP * np.arange(8000)
    ringing = np.exp(-0.3 * (t - 3.0)) * np.sin(2 * np.pi * 5.0 * (t - 3.0)) * (t > 3.0)
    values = 1e-2 * ringing + 1e-5 * burst(t, 40.0, 4.5)
    made = levels(values[None], [60.0]).deck_velocity_level[0]
    part = (t >= PASSING[0]) & (t <= PASSING[1])
    for nominal, centre in ((5.0, 10**0.7), (40.0, 10**1.6)):
        edges = [centre * 10**-0.05, centre * 10**0.05]
        sos = butter(3, edges, "bandpass", fs=1 / STEP, output="sos")
        heard = sosfilt(sos, values)[part]
        expected = 10 * np.log10(np.mean(heard**2) / REFERENCE**2)
        assert made.sel(band=nominal).item() == pytest.approx(expected, abs=1.5)


def test_no_level_where_the_train_does_not_come_and_none_beyond_ten_steps_a_period():
    values = np.random.default_rng(1).normal(size=(2, 2000))
    made = levels(values, [20.0, 500.0])
    assert np.isnan(made.deck_velocity_level[1]).all()
    assert np.isfinite(made.deck_velocity_level[0]).all()
    assert made.band.values.max() == 100.0

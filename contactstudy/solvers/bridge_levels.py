"""Third-octave levels of the vibration of rails, decks and piers while a train passes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.estimate import nominal_centre, third_octaves

if TYPE_CHECKING:
    import xarray as xr

REFERENCE = 1e-9
"""0 dB of a velocity, ISO 1683 [m/s]."""
REACH = 10.0
"""m: a train passes a place from where its first wheel is as near, until its last one is."""
STEPS_A_PERIOD = 10
"""Fewest time steps of a period: average acceleration makes it (2 pi/n)^2/12 = 3 % too long."""
_FEWEST = 8  # samples of a passage
_SMALLEST = 1e-30  # (m/s)^2: of a place that nothing moves
_NOTE = f"level re {1e9 * REFERENCE:g} nm/s, wheels within {REACH:g} m"


def velocity_levels(data: xr.Dataset, positions: Array) -> xr.Dataset:
    """Levels of every velocity of a run (place, time) by bands.

    Of each place the mean square of the velocity behind ideal filters while the train, its wheels
    at X `positions` (n_times, n_wheels), passes it, in bands up to `STEPS_A_PERIOD` time steps a
    period. "deck_velocity" (station, time) becomes "deck_velocity_level" (station, band) [dB]; NaN
    where the train does not pass.
    """
    import xarray as xr

    names = [str(name) for name in data.data_vars if str(name).endswith("_velocity")]
    step = float(data.attrs["dt"])
    found = {name: _levels(data[name], positions, step) for name in names}
    bands = sorted({f for rows in found.values() for row in rows for f in row})
    if not bands:
        return xr.Dataset()
    made = {}
    for name, rows in found.items():
        level = np.array([[row.get(f, np.nan) for f in bands] for row in rows])
        text = f"{data[name].attrs['long_name']}: {_NOTE}"
        attrs = {"units": "dB", "long_name": text}
        made[f"{name}_level"] = xr.Variable((data[name].dims[0], "band"), level, attrs)
    attrs = {"units": "Hz", "long_name": "nominal centre of the third-octave band"}
    return xr.Dataset(made, {"band": xr.Variable(("band",), bands, attrs)})


def passing(positions: Array, x: float) -> slice:
    """Time steps while the train, its wheels at X `positions` (n_times, n_wheels), passes x [m]."""
    near = np.flatnonzero((np.abs(positions - x) <= REACH).any(axis=1))
    return slice(near[0], near[-1] + 1) if len(near) else slice(0)


def _levels(velocity: xr.DataArray, positions: Array, step: float) -> list[dict[float, float]]:
    """Of each place nominal centre [Hz] -> level [dB]."""
    rows = list[dict[float, float]]()
    for x, values in zip(velocity[velocity.dims[0]].values, velocity.values, strict=True):
        part = passing(positions, x)
        if part.stop - (part.start or 0) < _FEWEST or not np.isfinite(values).all():
            rows.append({})
            continue
        centre, mean_square = third_octaves_of_part(values, part, step)
        level = 10.0 * np.log10(np.maximum(mean_square, _SMALLEST) / REFERENCE**2)
        rows.append(dict(zip(nominal_centre(centre).tolist(), level.tolist(), strict=True)))
    return rows


def third_octaves_of_part(values: Array, part: slice, step: float) -> tuple[Array, Array]:
    """Centres [Hz], and the mean square over a part of a signal (n,) behind a filter of each band.

    The filters are ideal, and see the whole signal: cut to the part, a vibration that goes on
    there would have lines in all bands, and a window that hides the cut would hide how the train
    comes and goes. Behind the part the signal fades away to the record's end. Bands are at least
    as wide as the inverse of the part's duration.
    """
    n, left = len(values), len(values) - part.stop
    faded = np.array(values, dtype=float)
    faded[part.stop :] *= np.cos(0.5 * np.pi * np.arange(1, left + 1) / max(left, 1)) ** 2
    spectrum, frequency = np.fft.rfft(faded, 2 * n), np.fft.rfftfreq(2 * n, step)
    line, highest = 1.0 / ((part.stop - part.start) * step), 1.0 / (STEPS_A_PERIOD * step)
    centre, lower, upper = third_octaves(line, highest)
    kept = (upper - lower >= line) & (centre <= highest * 1.01)
    found = list[float]()
    for low, high in zip(lower[kept], upper[kept], strict=True):
        band = np.where((frequency >= low) & (frequency < high), spectrum, 0.0)
        found.append(float(np.mean(np.fft.irfft(band, 2 * n)[part] ** 2)))
    return centre[kept], np.array(found)

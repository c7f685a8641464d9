"""Third-octave levels of the vibration of rails, decks and piers while a train passes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.estimate import third_octave_levels

if TYPE_CHECKING:
    import xarray as xr

REFERENCE = 1e-9
"""0 dB of a velocity, ISO 1683 [m/s]."""
REACH = 10.0
"""m: a train passes a place from where its first wheel is as near, until its last one is."""
STEPS_A_PERIOD = 10
"""Fewest time steps of a period: average acceleration makes it (2 pi/n)^2/12 = 3 % too long."""
_FEWEST = 8  # samples of a spectral estimate
_NOTE = f"level re {1e9 * REFERENCE:g} nm/s, wheels within {REACH:g} m"


def velocity_levels(data: xr.Dataset, positions: Array) -> xr.Dataset:
    """Levels of every velocity of a run (place, time) by bands.

    Of each place the velocity while the train, its wheels at X `positions` (n_times, n_wheels),
    passes it, less its mean, as `third_octave_levels` takes it: in one segment, in bands up to
    `STEPS_A_PERIOD` time steps a period. "deck_velocity" (station, time) becomes
    "deck_velocity_level" (station, band) [dB]; NaN where the train does not pass.
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
    highest, rows = 1.0 / (STEPS_A_PERIOD * step), list[dict[float, float]]()
    for x, values in zip(velocity[velocity.dims[0]].values, velocity.values, strict=True):
        part = values[passing(positions, x)]
        if len(part) < _FEWEST or not np.isfinite(part).all():
            rows.append({})
            continue
        lowest = min(1.0 / (len(part) * step), highest)
        levels = third_octave_levels(part, step, REFERENCE, band=(lowest, highest))
        rows.append(dict(zip(levels.nominal.tolist(), levels.level.tolist(), strict=True)))
    return rows

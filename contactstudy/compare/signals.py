"""Signals of a labelled run as they are compared and drawn: those of the leading wheel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array

if TYPE_CHECKING:
    import xarray as xr


def values(run: xr.Dataset, name: str) -> Array:
    """Variable `name` (time,) in SI units."""
    data = run[name]
    return np.asarray(data.isel(wheel=0) if "wheel" in data.dims else data, dtype=np.float64)


def position(run: xr.Dataset) -> Array:
    """Position (time,) along the track in m."""
    return values(run, "position")


def speed(run: xr.Dataset) -> float:
    """Speed of the run in m/s."""
    x, t = position(run), run["time"].values
    return float((x[-1] - x[0]) / (t[-1] - t[0]))

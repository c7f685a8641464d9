"""Signals of a labelled run as they are compared and drawn: those of the leading wheel."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare import norms

if TYPE_CHECKING:
    import xarray as xr


def values(run: xr.Dataset, name: str) -> Array:
    """Variable `name` (time,) in SI units."""
    data = run[name]
    return np.asarray(data.isel(wheel=0) if "wheel" in data.dims else data, dtype=np.float64)


WITHOUT_STATIC = ("wheel_displacement",)
"""Signals that are compared from their values at rest on.

Eq. (5) puts the static load on the rail. So a linear spring carries the dynamic part alone, and its
wheel stands higher than that of a nonlinear law by the static approach: that is where the count
starts, and no difference between the models.
"""


_OF_WHEEL = ("wheel_displacement", "wheel_acceleration")


def carries(run: xr.Dataset, name: str) -> bool:
    """Whether a run has a signal; a moving force has no wheel that could move."""
    return name in run and not (name in _OF_WHEEL and is_moving_force(run))


def is_moving_force(run: xr.Dataset) -> bool:
    """Whether a run's wheels are constant forces."""
    return bool(run.attrs.get("law") == "moving force")


def at_rest(run: xr.Dataset, name: str) -> Array:
    """Value (...,) in SI units in the static start, of each wheel."""
    return np.asarray(run[name].values, dtype=np.float64)[..., 0]


def at_station(run: xr.Dataset, name: str, at: float | None) -> Array:
    """Variable `name` (time,) at the station or support X [m], or of the leading wheel for None."""
    if at is None:
        return values(run, name)
    place = run[name].dims[0]
    nearest = int(np.argmin(np.abs(run[place].values - at)))
    return np.asarray(run[name].isel({place: nearest}), dtype=np.float64)


def position(run: xr.Dataset) -> Array:
    """Position (time,) along the track in m; of a run backward from where the train enters."""
    x = values(run, "position")
    return x if way(run) > 0.0 else run.attrs["start"] + x[0] - x


def way(run: xr.Dataset) -> float:
    """1 if the vehicle travels along +X, -1 if it comes back."""
    return -1.0 if run.attrs.get("travel") == "backward" else 1.0


def side_by_side(
    run: xr.Dataset, reference: xr.Dataset, of: Callable[[xr.Dataset], Array], start: float
) -> tuple[Array, Array, Array]:
    """Common positions (k,) of two runs from `start` [m] on, and a signal (time,) of both there."""
    x_run, x_reference = position(run), position(reference)
    x = norms.common_positions(x_run, x_reference, start)
    there = norms.at_positions(of(reference), x_reference, x)
    return x, norms.at_positions(of(run), x_run, x), there


def dynamic(run: xr.Dataset, name: str) -> Array:
    """Variable `name` (time,) less its value at rest."""
    found = values(run, name)
    return found - found[0]


def same_way(run: xr.Dataset, other: xr.Dataset) -> bool:
    """Whether both pass in the same direction; if not, equal positions are not equal places."""
    ways = {way(one) for one in (run, other)}
    return len(ways) == 1


def speed(run: xr.Dataset) -> float:
    """Speed of the run in m/s."""
    x, t = position(run), run["time"].values
    return float((x[-1] - x[0]) / (t[-1] - t[0]))

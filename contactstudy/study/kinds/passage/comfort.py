"""Ride comfort in the cars of a passage, for ``metrics.json`` and the report."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.compare import comfort

if TYPE_CHECKING:
    import xarray as xr

SHORTEST = 2.0
"""s, of a record that a comfort value is given for."""


def comfort_of(runs: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Of each run with car bodies, once the irregularity is faded in.

    ``duration`` [s], of each car ``sperling`` (vertical, and lateral if there is any), ``n_mv`` of
    EN 12299 (planar: of the vertical acceleration alone) and ``largest`` vertical acceleration
    [m/s^2]; indices are null where the record is shorter than `SHORTEST`.
    """
    # a moving force does not feel the rail, so that the cars above it stay at rest
    felt = {name: run for name, run in runs.items() if run.attrs.get("law") != "moving force"}
    return {name: _of_run(run) for name, run in felt.items() if "car_acceleration" in run}


def _of_run(run: xr.Dataset) -> dict[str, Any]:
    time = run["time"].values
    keep = time >= run.attrs["fade_in"] / run.attrs["speed"]
    time = time[keep]
    step, duration = float(run.attrs["dt"]), float(time[-1] - time[0])
    up = run["car_acceleration"].values[:, keep]
    lateral = run.get("car_lateral_acceleration")
    across = None if lateral is None else lateral.values[:, keep]
    cars = []
    for k, a in enumerate(up):
        one: dict[str, Any] = {"sperling": {"Z": None}, "n_mv": None}
        if len(a) * step >= SHORTEST:
            side = np.zeros_like(a) if across is None else across[k]
            one["sperling"] = {"Z": comfort.sperling(a, step)}
            if across is not None:
                one["sperling"]["Y"] = comfort.sperling(side, step, "Y")
            one["n_mv"] = comfort.mean_comfort(a, side, step)
        cars.append(one | {"largest": float(np.abs(a).max())})
    return {"duration": duration, "cars": cars}

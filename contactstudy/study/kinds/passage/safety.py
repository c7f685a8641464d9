"""Wheel forces of a train beside the limits of EN 14363, for ``metrics.json``, figures and report.

::

    largest_q, smallest_q   of each wheel's vertical force Q, as computed [N]
    filtered_q, unloading   largest Q [N], and largest (Q_0 - Q)/Q_0, behind a low-pass of 20 Hz
    largest_y               largest size of the lateral force, as computed [N]
    quotient                largest Y/Q outwards, mean over 2 m behind the low-pass
    track_shift             of each wheelset, largest size of the sum of Y, likewise [N]
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.low_pass import low_pass, passes
from contactstudy.compare.running_safety import CUT_OFF, sliding_mean
from contactstudy.compare.signals import speed
from contactstudy.track.structure import LEFT

if TYPE_CHECKING:
    import xarray as xr


def safety_of(runs: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Of each run on a bridge whose wheels feel the rail: lists with a value a wheel."""
    return {
        name: _of_run(run)
        for name, run in runs.items()
        if "wheel_unloading" in run
        and run.attrs.get("law") != "moving force"
        and passes(run.attrs["dt"], CUT_OFF)
    }


def _of_run(run: xr.Dataset) -> dict[str, Any]:
    step, forces = float(run.attrs["dt"]), np.atleast_2d(run["contact_force"].values)
    static = np.asarray(run.attrs["static_load"], dtype=float)[:, None]
    slow = low_pass(forces, step, CUT_OFF)
    x = np.atleast_2d(run["position"].values)[:, 0]
    found = {
        "behind": np.abs(x - x[0]),
        "largest_q": forces.max(axis=1),
        "smallest_q": forces.min(axis=1),
        "filtered_q": slow.max(axis=1),
        "unloading": (1.0 - slow / static).max(axis=1),
    }
    if "lateral_force" in run:
        found |= _lateral(run, slow, step)
    return {name: values.tolist() for name, values in found.items()}


def _lateral(run: xr.Dataset, slow: Array, step: float) -> dict[str, Array]:
    across, spacing = run["lateral_force"].values, speed(run) * step
    beside = low_pass(across, step, CUT_OFF)
    outwards = np.where(run["rail"].values == LEFT, 1.0, -1.0)[:, None]
    mean = sliding_mean(outwards * beside / np.maximum(slow, 1.0), spacing)
    shift = sliding_mean(beside[::2] + beside[1::2], spacing)
    return {
        "largest_y": np.abs(across).max(axis=1),
        "quotient": mean.max(axis=1),
        "track_shift": np.abs(shift).max(axis=1),
    }

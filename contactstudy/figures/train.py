"""What figures need to know of a train."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from contactstudy.exceptions import InputError
from contactstudy.validation import entries, read
from contactstudy.vehicle import VEHICLES


def repeat_length(vehicle: Mapping[str, Any], run: xr.Dataset | None = None) -> float | None:
    """L_c at which cars or groups of axles repeat [m], of a resolved vehicle; None without one.

    Of a run that kept the outlines of its cars it is theirs: a file of a car may be elsewhere.
    """
    if run is not None and "car_outline" in run:
        pitches = np.round(-np.diff(run["car_outline"].values[:, 0]), 6).tolist()
        return max(pitches, key=pitches.count) if pitches else None
    kind = VEHICLES.classes.get(str(vehicle.get("type")))
    if kind is None or not hasattr(kind, "repeat_length"):
        return None
    try:
        made, problems = read(
            kind, {k: vehicle[k] for k in entries(kind) if k in vehicle}, "vehicle"
        )
        return None if problems else made.repeat_length
    except InputError:  # a car's file that is no longer there
        return None

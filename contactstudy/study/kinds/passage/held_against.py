"""Runs of a passage held against a measured record: what goes into ``metrics.json`` and figures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.compare import records
from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage.record import MeasuredRecord, Record

if TYPE_CHECKING:
    import xarray as xr


def held_against(table: MeasuredRecord, runs: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Of each run the shift and scale of the record, and how each channel agrees.

    ``method``; ``runs.<name>``: shift [s], scale, and of ``channels.<column>`` signal, correlation,
    peak_ratio, normalised_error, sprague_geers {M, P, C}, timing [s], and the zero if it is fitted.
    """
    record = table.read()
    made = dict[str, Any]()
    for name, run in runs.items():
        try:
            made[name] = _of_run(table, record, run)
        except InputError as error:
            made[name] = {"failure": "; ".join(error.problems)}
    fitted = table.shift == "fitted"
    return {"method": records.METHOD if fitted else "shift as given", "runs": made}


def _of_run(table: MeasuredRecord, record: Record, run: xr.Dataset) -> dict[str, Any]:
    computed = run["time"].values, np.array([channel.of(run) for channel in table.parsed])
    measured = record.time, record.values
    found = records.aligned(
        computed,
        measured,
        None if table.shift == "fitted" else float(table.shift),
        None if table.scale == "fitted" else float(table.scale),
        table.zero == "fitted",
    )
    over = records.overlaid(computed, measured, found)
    channels = {}
    for k, channel in enumerate(table.parsed):
        one = records.agreement(over, k)
        channels[channel.column] = {
            "signal": channel.label,
            "correlation": one.correlation,
            "peak_ratio": one.peak_ratio,
            "normalised_error": one.normalised_error,
            "sprague_geers": {
                "M": one.sprague_geers.magnitude,
                "P": one.sprague_geers.phase,
                "C": one.sprague_geers.combined,
            },
            "timing": one.timing,
        }
        if found.zero:
            channels[channel.column]["zero"] = found.zero[k]
    return {"shift": found.shift, "scale": found.scale, "channels": channels}


def to_dataset(table: MeasuredRecord) -> xr.Dataset:
    """The record as a group of the results, a variable a channel over ``record_time``."""
    import xarray as xr

    record = table.read()
    data = xr.Dataset(
        coords={"record_time": ("record_time", record.time, {"units": "s", "long_name": "time"})}
    )
    for channel, values in zip(table.parsed, record.values, strict=True):
        attrs: dict[str, Any] = {"units": channel.unit, "long_name": f"measured {channel.label}"}
        attrs |= {"signal": channel.signal, "label": channel.label}
        if channel.at is not None:
            attrs["at"] = channel.at
        data[channel.column] = ("record_time", values, attrs)
    return data

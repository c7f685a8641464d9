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
    peak_ratio, normalised_error, sprague_geers {M, P, C}, timing [s], and the zero if it is fitted;
    ``reversed`` of channels that agree clearly better with the opposite sign: how to write them.
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
    fitted = table.shift == "fitted"
    found = records.aligned(
        computed,
        measured,
        None if fitted else float(table.shift),
        None if table.scale == "fitted" else float(table.scale),
        table.zero == "fitted",
    )
    over = records.overlaid(computed, measured, found)
    # a scale that is given may reverse all; one that is fitted must not
    meant = 1.0 if table.scale == "fitted" else np.sign(float(table.scale))
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
        ours, theirs = meant * computed[1][k : k + 1], measured[1][k : k + 1]
        pair = (computed[0], ours), (measured[0], theirs)
        if records.is_reversed(*pair, found.shift, fitted):
            channels[channel.column]["reversed"] = channel.reversed
    return {"shift": found.shift, "scale": found.scale, "channels": channels}


def reversed_sentences(runs: Mapping[str, Any]) -> list[str]:
    """Which channels have the opposite sign, and what to write instead."""
    told = dict[str, str]()
    for one in runs.values():
        for column, channel in one.get("channels", {}).items():
            if "reversed" in channel:
                told[column] = channel["reversed"]
    return [
        f"{column} agrees better with the opposite sign, as of a gauge that counts the other way: "
        f'if so, write "{instead}" in measured.channels.'
        for column, instead in told.items()
    ]


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

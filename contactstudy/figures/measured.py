"""Computed signals over a measured record, channel by channel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.compare.signals import at_station
from contactstudy.figures.signals import styles
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import GREY, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

GROUP = "measured"
"""Group of the results with the record."""
# SI unit -> how it is shown, and the factor
_SHOWN = {"m": ("mm", 1e3), "N": ("kN", 1e-3), "1": ("µm/m", 1e6)}
_QUIET = 0.02  # of the largest computed value: beside it nothing is shown
_MARGIN = 0.05  # of the time shown, at both ends


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure with a panel a channel, of runs that could be laid over the record."""
    record, found = results.groups.get(GROUP), fitted(results)
    if record is None or not found:
        return []
    return [
        Drawing("measured", _caption(results, record, found), lambda: _draw(results, record, found))
    ]


def fitted(results: StudyResults) -> dict[str, dict[str, Any]]:
    """Run -> shift, scale and agreement of its channels, without runs that have none."""
    runs = results.metrics.get(GROUP, {}).get("runs", {})
    return {name: one for name, one in runs.items() if "channels" in one}


def _draw(results: StudyResults, record: xr.Dataset, found: dict[str, dict[str, Any]]) -> Figure:
    names = [str(name) for name in record.data_vars]
    figure = new_figure(1.0 + 1.5 * len(names))
    panels = figure.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    first = next(iter(found))
    low, high = _window(results, record, found)
    for axes, name in zip(panels, names, strict=True):
        channel = record[name]
        unit, factor = _SHOWN.get(channel.attrs["units"], (channel.attrs["units"], 1.0))
        time = record["record_time"].values + found[first]["shift"]
        # without what the first run's fit takes for the gauge's zero
        loaded = channel.values - found[first]["channels"][name].get("zero", 0.0)
        axes.plot(time, factor * loaded, color=GREY, lw=0.9, label="measured")
        for run, one in found.items():
            data = results.runs[run]
            values = at_station(data, channel.attrs["signal"], channel.attrs.get("at"))
            # the record is drawn by the first run's clock
            at = data["time"].values + found[first]["shift"] - one["shift"]
            style = styles(results)[run]
            axes.plot(at, factor * one["scale"] * values, label=label(run), **style.line)
        axes.set(ylabel=f"{name}\n({unit})", xlim=(low, high))
        axes.margins(x=0)
    panels[-1].set_xlabel("Time of the run (s)")
    figure.align_ylabels()
    figure_legend(figure, panels[0])
    return figure


def _window(
    results: StudyResults, record: xr.Dataset, found: dict[str, dict[str, Any]]
) -> tuple[float, float]:
    """Time in which something is computed, with a margin [s]."""
    first = next(iter(found))
    data = results.runs[first]
    loud = np.zeros(data.sizes["time"], dtype=bool)
    for channel in record.data_vars.values():
        values = np.abs(at_station(data, channel.attrs["signal"], channel.attrs.get("at")))
        loud |= values > _QUIET * values.max()
    time = data["time"].values[loud]
    margin = _MARGIN * float(time[-1] - time[0])
    return float(time[0]) - margin, float(time[-1]) + margin


def _caption(results: StudyResults, record: xr.Dataset, found: dict[str, dict[str, Any]]) -> str:
    told = []
    for run, one in found.items():
        values = [c["correlation"] for c in one["channels"].values()]
        errors = [c["normalised_error"] for c in one["channels"].values()]
        text = (
            f"{label(run)}: correlation {spread(values, 4)}, normalised error "
            f"{spread([100 * e for e in errors])} %"
        )
        if results.config.get(GROUP, {}).get("scale") == "fitted":
            text += f", scale {number(one['scale'], 4)}"
        if results.config.get(GROUP, {}).get("zero") == "fitted":
            text += f", zeros {_zeros(record, one)}"
        told.append(f"{text}, record shifted by {number(one['shift'], 4)} s")
    places = "; ".join(f"{name}: {channel.attrs['label']}" for name, channel in record.items())
    return (
        f"Measured record (grey) and computed signals ({places}). {'. '.join(told)}. "
        f"Shift: {results.metrics[GROUP]['method']}."
    )


def _zeros(record: xr.Dataset, one: dict[str, Any]) -> str:
    """Of each channel what was taken off it."""
    told = []
    for name, channel in one["channels"].items():
        unit, factor = _SHOWN.get(si := record[name].attrs["units"], (si, 1.0))
        told.append(f"{name} {number(factor * channel['zero'], 3)} {unit}")
    return ", ".join(told)


def spread(values: list[float], digits: int = 3) -> str:
    """Smallest and largest of some values."""
    low, high = number(min(values), digits), number(max(values), digits)
    return low if low == high else f"{low} to {high}"

"""Vibration of rail, deck and piers while the train passes: levels and spectra."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from contactstudy.arrays import Array
from contactstudy.compare.signals import speed
from contactstudy.figures.deck import largest_station
from contactstudy.figures.resolved_track import bridge_of, loaded_deck_of
from contactstudy.figures.signals import styles
from contactstudy.figures.train import repeat_length
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import GREY, VERMILION, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.solvers.bridge_levels import REACH, REFERENCE, passing
from contactstudy.solvers.bridge_sensors import motion_name
from contactstudy.study.results import StudyResults
from contactstudy.track.space_beam import Axis

_BODIES = {"station": "Rail", "deck": "Deck", "pier": "Pier"}
_AXES: tuple[Axis, ...] = ("X", "Y", "Z")
_MARKED = 8  # n v/L_c
_BANDS = (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 31.5, 63.0, 125.0, 250.0, 500.0)
_HIGHEST = 30.0  # Hz of the spectrum, at least; also 4 f_1


def drawings(results: StudyResults) -> list[Drawing]:
    """Levels and a spectrum where all runs recorded a deck."""
    station = largest_station(results)
    if station is None or not all("deck_velocity_level" in run for run in results.runs.values()):
        return []
    return [
        Drawing("velocity_levels", *_levels(results, station)),
        Drawing("deck_spectrum", *_spectra(results, station)),
    ]


def _levels(results: StudyResults, station: float) -> tuple[str, Any]:
    first = next(iter(results.runs.values()))
    bodies = [b for b in _BODIES if _there(first, motion_name(b, "Z", 1) + "_level")]
    axes = [a for a in _AXES if motion_name("deck", a, 1) in first]
    return _levels_caption(results, station, bodies), partial(
        _draw_levels, results, station, bodies, axes
    )


def _there(run: xr.Dataset, name: str) -> bool:
    return name in run and bool(np.isfinite(run[name].values).any())


def _level(run: xr.Dataset, body: str, axis: Axis, station: float) -> xr.DataArray:
    """Levels (band,) at the station, of piers at the nearest one."""
    data = run[motion_name(body, axis, 1) + "_level"]
    if body == "pier":
        data = data[np.isfinite(data.values).any(axis=1)]
    place = data[data.dims[0]].values
    return data[int(np.argmin(np.abs(place - station)))]


def _draw_levels(
    results: StudyResults, station: float, bodies: list[str], axes: list[Axis]
) -> Figure:
    figure = new_figure(1.1 + 1.35 * len(axes))
    grid = figure.subplots(len(axes), len(bodies), sharex=True, sharey="row", squeeze=False)
    for row, axis in zip(grid, axes, strict=True):
        for panel, body in zip(row, bodies, strict=True):
            for name, style in styles(results).items():
                level = _level(results.runs[name], body, axis, station)
                panel.plot(level["band"], level, marker=style.marker, ms=2.5, mfc="none",
                           label=label(name), **style.line)  # fmt: skip
            _mark(panel, results, upper=row is grid[0])
        row[0].set_ylabel(f"{axis} (dB re {1e9 * REFERENCE:g} nm/s)")
    for panel, body in zip(grid[0], bodies, strict=True):
        panel.set_title(_BODIES[body])
    for panel in grid[-1]:
        panel.set_xlabel("Third octave (Hz)")
    figure_legend(figure, grid[0, 0])
    return figure


def _mark(axes: Axes, results: StudyResults, upper: bool) -> None:
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(FixedLocator(_BANDS))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(lambda f, _: f"{f:g}")
    for f in _multiples(results):
        axes.axvline(f, color=GREY, lw=0.5, ls=(0, (1, 2)), zorder=0)


def _passing(results: StudyResults) -> float | None:
    """v/L_c [Hz]; None where the train does not repeat itself."""
    run = next(iter(results.runs.values()))
    length = repeat_length(results.config.get("vehicle", {}), run)
    return speed(run) / length if length else None


def _multiples(results: StudyResults) -> Array:
    base = _passing(results)
    return np.asarray(np.zeros(0) if base is None else base * np.arange(1, _MARKED + 1))


def _levels_caption(results: StudyResults, station: float, bodies: list[str]) -> str:
    first = next(iter(results.runs.values()))
    places = [f"rail and deck at X = {number(station, 4)} m"]
    if "pier" in bodies:
        nearest = float(_level(first, "pier", "Z", station)["support"])
        places.append(f"the top of the pier at {number(nearest, 4)} m")
    told = []
    for name, run in results.runs.items():
        level = _level(run, "deck", "Z", station)
        k = int(np.nanargmax(level.values))
        told.append(
            f"{label(name)} {number(float(level[k]), 3)} dB at {float(level['band'][k]):g} Hz"
        )
    return (
        f"Velocity levels in third octaves of {' and '.join(places)}, while wheels are within "
        f"{REACH:g} m, re 10⁻⁹ m/s (ISO 1683). Highest of the deck along Z: {'; '.join(told)}."
        + _marked_text(results)
    )


def _marked_text(results: StudyResults) -> str:
    base = _passing(results)
    if base is None:
        return ""
    return (
        f" Dotted: n v/L_c, n = 1 to {_MARKED}, v/L_c = {number(base, 3)} Hz: the lengths at which "
        "cars repeat."
    )


def _spectra(results: StudyResults, station: float) -> tuple[str, Any]:
    found = {name: spectrum(run, station) for name, run in results.runs.items()}
    track = results.config["track"]
    first = loaded_deck_of(track).frequency(bridge_of(track).span_at(station))
    highest = max(_HIGHEST, 4.0 * first)
    told = []
    for name, (f, a) in found.items():
        inside = f <= highest
        k = int(np.argmax(a[inside]))
        told.append(f"{label(name)} {number(float(a[k]), 2)} m/s² at {number(float(f[k]), 3)} Hz")
    text = (
        f"Amplitude spectrum of the deck's acceleration at X = {number(station, 4)} m, of the "
        f"samples while wheels are within {REACH:g} m. Highest lines: {'; '.join(told)}. Dashed: "
        f"the first frequency of its span with the track, simply supported, {number(first, 3)} Hz."
    )
    return text + _marked_text(results), partial(_draw_spectra, results, found, first, highest)


def spectrum(run: xr.Dataset, station: float) -> tuple[Array, Array]:
    """Frequencies (n,) [Hz] and amplitudes (n,) of the deck's acceleration during the passage.

    Of a sinusoid with a whole number of periods the line at its frequency is its amplitude.
    """
    near = passing(np.atleast_2d(run["position"].values).T, station)
    values = run["deck_acceleration"].sel(station=station).values[near]
    lines = np.abs(np.fft.rfft(values - values.mean())) * 2.0 / len(values)
    return np.asarray(np.fft.rfftfreq(len(values), float(run.attrs["dt"]))), lines


def _draw_spectra(
    results: StudyResults, found: dict[str, tuple[Array, Array]], first: float, highest: float
) -> Figure:
    figure = new_figure(2.7)
    axes = figure.subplots()
    for name, style in styles(results).items():
        axes.plot(*found[name], label=label(name), **style.line)
    axes.axvline(first, color=VERMILION, lw=0.9, ls=(0, (4, 2)))
    for f in _multiples(results):
        axes.axvline(f, color=GREY, lw=0.6, ls=(0, (1, 2)), zorder=0)
    axes.set(xlim=(0.0, highest), xlabel="Frequency (Hz)", ylabel="Amplitude (m/s²)")
    shown = max(float(a[f <= highest].max()) for f, a in found.values())
    axes.set_ylim(0.0, 1.08 * shown or 1.0)
    base = _passing(results)
    if base is not None:
        second = axes.secondary_xaxis(
            "top", functions=(lambda f: np.asarray(f) / base, lambda n: np.asarray(n) * base)
        )
        second.set_xlabel("n = f L_c/v")
    figure_legend(figure, axes)
    return figure

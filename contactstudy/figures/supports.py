"""Forces on a support of a bridge, the motion of its pier, and strains beside it."""

from __future__ import annotations

from functools import partial

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from contactstudy.figures.deck import largest_station
from contactstudy.figures.signals import styles
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.solvers.bridge_sensors import force_name, motion_name
from contactstudy.study.results import StudyResults
from contactstudy.track.space_beam import Axis

_AXES: tuple[Axis, ...] = ("X", "Y", "Z")
_STRAINS = {"station_strain": "Rail", "deck_strain": "Deck"}


def drawings(results: StudyResults) -> list[Drawing]:
    """Two figures where all runs recorded a deck and its supports."""
    station = largest_station(results)
    if station is None or not all("bearing_force" in run for run in results.runs.values()):
        return []
    made = [Drawing("support_forces", _caption(results), partial(_draw, results))]
    if all(name in run for run in results.runs.values() for name in _STRAINS):
        strains = partial(_draw_strains, results, station)
        made.append(Drawing("strains", _strain_caption(results, station), strains))
    return made


def axes_of(run: xr.Dataset) -> list[Axis]:
    """Axes along which there are forces on supports."""
    return [axis for axis in _AXES if force_name(axis) in run]


def _loaded_axes(results: StudyResults, support: int) -> list[Axis]:
    """Axes along which a support carries anything, or its pier may move."""
    runs = list(results.runs.values())
    pier = "pier_displacement" in runs[0]
    return [
        axis
        for axis in axes_of(runs[0])
        if pier or any(run[force_name(axis)][support].values.any() for run in runs)
    ]


def loaded_support(results: StudyResults) -> int:
    """Number of the support that carries most in any run, of one with a pier where there are."""
    forces = np.max(
        [np.abs(run["bearing_force"].values).max(axis=1) for run in results.runs.values()], axis=0
    )
    first = next(iter(results.runs.values()))
    if "pier_displacement" in first:
        forces = np.where(np.isfinite(first["pier_displacement"][:, 0]), forces, -1.0)
    return int(np.argmax(forces))


def _draw(results: StudyResults) -> Figure:
    first, k = next(iter(results.runs.values())), loaded_support(results)
    axes = _loaded_axes(results, k)
    columns = 2 if "pier_displacement" in first else 1
    figure = new_figure(1.0 + 1.25 * len(axes))
    grid = figure.subplots(len(axes), columns, sharex=True, squeeze=False)
    for row, axis in zip(grid, axes, strict=True):
        for name, style in styles(results).items():
            run = results.runs[name].isel(support=k)
            time = run["time"].values
            row[0].plot(time, 1e-3 * run[force_name(axis)], label=label(name), **style.line)
            if columns == 2:
                moved = run[motion_name("pier", axis, 0)]
                row[1].plot(time, 1e3 * moved, **style.line)
        row[0].set_ylabel(f"Force {axis} (kN)")
        if columns == 2:
            row[1].set_ylabel(f"Top of the pier {axis} (mm)")
    for panel in grid[-1]:
        panel.set_xlabel("Time (s)")
    for panel in grid.flat:
        panel.margins(x=0)
    figure.align_ylabels()
    figure_legend(figure, grid[0, 0])
    return figure


def _caption(results: StudyResults) -> str:
    first, k = next(iter(results.runs.values())), loaded_support(results)
    told = []
    for name, run in results.runs.items():
        forces = [
            f"{axis} {number(1e-3 * float(np.abs(run[force_name(axis)][k]).max()), 3)}"
            for axis in _loaded_axes(results, k)
        ]
        told.append(f"{label(name)} {', '.join(forces)} kN")
    pier = ", and motion of its pier's top" if "pier_displacement" in first else ""
    return (
        f"Forces of all bearings on the support at X = {number(float(first['support'][k]), 4)} m, "
        f"without dead load{pier}. Largest sizes: {'; '.join(told)}."
    )


def _draw_strains(results: StudyResults, station: float) -> Figure:
    figure = new_figure(3.2)
    rows = figure.subplots(2, 1, sharex=True)
    for axes, (signal, text) in zip(rows, _STRAINS.items(), strict=True):
        for name, style in styles(results).items():
            run = results.runs[name].sel(station=station)
            axes.plot(run["time"], 1e6 * run[signal], label=label(name), **style.line)
        axes.set_ylabel(f"{text}\n(µm/m)")
        axes.margins(x=0)
    rows[-1].set_xlabel("Time (s)")
    figure.align_ylabels()
    figure_legend(figure, rows[0])
    return figure


def _strain_caption(results: StudyResults, station: float) -> str:
    depth = float(results.config["track"]["gauge_depth"])
    told = []
    for name, run in results.runs.items():
        here = run.sel(station=station)
        most = [number(1e6 * float(here[signal].max()), 3) for signal in _STRAINS]
        told.append(f"{label(name)} {' and '.join(most)} µm/m")
    return (
        f"Strain along the track at X = {number(station, 4)} m: of the rail under the middle of "
        f"its foot, of the deck {number(depth, 2)} m below its axis; positive in tension. Largest: "
        f"{'; '.join(told)}."
    )

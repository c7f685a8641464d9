"""Table of the forces on the supports of a bridge and the motion of its piers."""

import numpy as np
import xarray as xr

from contactstudy.figures.deck import largest_station
from contactstudy.figures.supports import axes_of
from contactstudy.plot.text import label, number
from contactstudy.report.blocks import Block, table
from contactstudy.solvers.bridge_sensors import force_name, motion_name
from contactstudy.study.results import StudyResults


def support_table(results: StudyResults) -> list[Block]:
    """Of each run the largest sizes over all supports; nothing without a bridge."""
    if largest_station(results) is None:
        return []
    first = next(iter(results.runs.values()))
    if not all("bearing_force" in run for run in results.runs.values()):
        return []
    axes = axes_of(first)
    columns = ["Run", *(f"Force {axis} (kN)" for axis in axes)]
    shown = [(force_name(axis), 1e-3) for axis in axes]
    if "pier_displacement" in first:
        columns += [f"Pier {axis} (mm)" for axis in axes]
        shown += [(motion_name("pier", axis, 0), 1e3) for axis in axes]
    rows = [
        [label(name), *(_largest(run, signal, factor) for signal, factor in shown)]
        for name, run in results.runs.items()
    ]
    note = (
        "Forces of all bearings of a support, without dead load. In brackets the X of the support "
        "in m."
    )
    return [table(columns, rows, "Supports: largest sizes.", 1, note)]


def _largest(run: xr.Dataset, signal: str, factor: float) -> str:
    sizes = np.abs(run[signal].values).max(axis=1)
    k = int(np.nanargmax(sizes))
    return f"{number(factor * float(sizes[k]), 3)} ({number(float(run['support'][k]), 4)})"

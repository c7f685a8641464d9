"""Table of the largest stresses below the patch at the chosen instants."""

import numpy as np
import xarray as xr

from contactstudy.compare.signals import position, values
from contactstudy.plot.text import exact, label, number
from contactstudy.report.blocks import Block, table
from contactstudy.study.results import StudyResults

_COLUMNS = [
    "Run", "X (m)", "Force (kN)", "Peak p (MPa)", "Von Mises (MPa)", "at depth (mm)",
    "Shear (MPa)", "at depth (mm)",
]  # fmt: skip


def stress_tables(results: StudyResults) -> list[Block]:
    """One table over all runs and instants, or none."""
    rows = [
        row
        for name, run in results.runs.items()
        if "maximum_shear" in run
        for row in _rows(label(name), run)
    ]
    if not rows:
        return []
    caption = (
        "Largest stresses below the patch at the chosen instants, those of an elastic half-space "
        "under the nodal pressure, whose highest is p; – where there is no contact."
    )
    return [table(_COLUMNS, rows, caption) | {"size": 8.5}]


def _rows(name: str, run: xr.Dataset) -> list[list[str]]:
    at = np.asarray(run["instant_position"].values, dtype=float)
    force = np.interp(at, position(run), values(run, "contact_force"))
    peak = np.asarray(run["pressure"].transpose("instant", "point").values).max(axis=1)
    rows = []
    for k, x in enumerate(at):
        row = [name, exact(round(float(x), 4)), number(force[k] * 1e-3), number(peak[k] * 1e-6)]
        for invariant in ("von_mises", "maximum_shear"):
            depth = float(run[f"{invariant}_depth"][k])
            row += [
                number(float(run[invariant][k]) * 1e-6),
                number(depth * 1e3) if np.isfinite(depth) else "–",
            ]
        rows.append(row)
    return rows

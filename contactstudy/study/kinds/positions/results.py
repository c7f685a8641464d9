"""From presses to results: a run a wheel, what ``metrics.json`` holds, and all patches as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.files import write_file
from contactstudy.study.axes.measured import Measured, extremes
from contactstudy.study.kind import Cost
from contactstudy.study.kinds.positions.kind import CSV_FILE
from contactstudy.study.kinds.positions.press import VARIABLES
from contactstudy.study.kinds.positions.table import PositionsStudy
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import xarray as xr


def collect(
    study: PositionsStudy, found: Mapping[str, list[dict[str, Any]]]
) -> dict[str, xr.Dataset]:
    """A dataset a wheel, whose dimension ``row`` holds all its patches in order."""
    return {
        side: _dataset([row for rows in found.values() for row in rows if row["wheel"] == side])
        for side in study.table.wheels
    }


def histories(study: PositionsStudy) -> list[str]:
    """Names of what a wheel's dataset holds of each patch."""
    return ["position", "patch", *VARIABLES]


def _dataset(rows: list[dict[str, Any]]) -> xr.Dataset:
    import xarray as xr

    data = xr.Dataset()
    data["wheel"] = ("row", np.array([row["wheel"] for row in rows], dtype=object))
    for name in ("position", "patch"):
        data[name] = ("row", np.array([row[name] for row in rows], dtype=np.int64))
    for name, (unit, meaning) in VARIABLES.items():
        attrs = {"units": unit, "long_name": meaning}
        data[name] = ("row", np.array([float(row[name]) for row in rows]), attrs)
    return data


def measure(study: PositionsStudy, found: Mapping[str, list[dict[str, Any]]]) -> Measured:
    """Smallest and largest value of each variable among all patches of each wheel."""
    return extremes(study, collect(study, found))


def metrics(
    study: PositionsStudy, runs: Mapping[str, xr.Dataset], costs: Mapping[str, Cost]
) -> dict[str, Any]:
    """Content of ``metrics.json``.

    ::

        runs.<wheel>:  positions, patches, largest {variable: value [SI]}, seconds {setup,
                       stepping} of all presses, peak_memory_mb
    """
    made = {}
    for side, data in runs.items():
        own = [cost for name, cost in costs.items() if name.startswith(side)]
        memory = [c["peak_memory_mb"] for c in own if c["peak_memory_mb"] is not None]
        made[side] = {
            "positions": len(own),
            "patches": data.sizes["row"],
            "largest": {
                name: float(data[name].max()) for name in ("approach", "peak_pressure", "area")
            },
            "seconds": {k: sum(c["seconds"][k] for c in own) for k in ("setup", "stepping")},
            "peak_memory_mb": max(memory, default=None),
        }
    return {"runs": made, "reference": None, "comparisons": {}}


def write_csv(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write all patches, their names with units in the first line."""
    target = out_dir / CSV_FILE
    names = ("wheel", "position", "patch", *VARIABLES)
    units = {name: unit for name, (unit, _) in VARIABLES.items()}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([f"{n} [{units[n]}]" if n in units else n for n in names])
    for run in results.runs.values():
        writer.writerows(zip(*(run[name].values.tolist() for name in names), strict=True))
    write_file(target, text.getvalue())
    return [target]

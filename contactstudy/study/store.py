"""Finished runs on disk, found again by a hash of everything that went into them.

A run is two files in ``<out>/runs/``: ``<name>-<hash>.nc`` and ``<name>-<hash>.json``. The second
holds the first one's SHA-256, the times and the peak memory; it is written last, so that a run is
finished when it is there and the sums agree.
"""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import xarray as xr

import contactstudy
from contactstudy.resources import resource
from contactstudy.study.files import netcdf_attributes, writing

STORE = "runs"
# Packages whose code cannot change a run: they only describe, draw or print.
_NOT_COMPUTING = (
    "figures",
    "report",
    "verification",
    "cli.py",
    "study/kinds/passage/fields.py",
    "study/kinds/passage/forecast.py",
    "study/kinds/passage/metrics.py",
    "study/kinds/positions/terminal.py",
    "study/kinds/positions/report.py",
    "study/results.py",
    "study/terminal.py",
)


@dataclass(frozen=True)
class StoredRun:
    """A finished run.

    Attributes
    ----------
    data : xarray.Dataset
        As the solver gave it.
    cost : mapping
        ``seconds`` {``setup``, ``stepping``} and ``peak_memory_mb``.
    """

    data: xr.Dataset
    cost: Mapping[str, Any]


def digest(value: Any, length: int = 16) -> str:
    """Hexadecimal SHA-256 of plain data, cut to `length` characters."""
    text = json.dumps(value, sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()[:length]


def file_digest(path: Path) -> str:
    """Hexadecimal SHA-256 of a file."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


@functools.cache
def code_digest(everything: bool = False) -> str:
    """Hash of the package's version, sources and profiles, so that other code makes other results.

    Parameters
    ----------
    everything : bool
        Whether drawing and printing count as well.
    """
    root = Path(contactstudy.__file__).parent
    skipped = () if everything else _NOT_COMPUTING
    sums = {
        name: file_digest(path)
        for path in sorted(root.rglob("*.py"))
        if not (name := path.relative_to(root).as_posix()).startswith(skipped)
    }
    if everything:
        sums |= {path.name: file_digest(path) for path in sorted(resource("report").glob("*.*"))}
    for path in sorted(resource("meshes").rglob("*.toml")):
        sums[f"meshes/{path.name}"] = file_digest(path)
    return digest([contactstudy.__version__, sums])


def run_path(out_dir: Path, name: str, key: str) -> Path:
    """File of the run `name` with the input hash `key`."""
    return out_dir / STORE / f"{name}-{key}.nc"


def save_run(path: Path, data: xr.Dataset, peak_memory_mb: float | None) -> None:
    """Write a run; it counts as finished only when this returns."""
    seconds = {k: float(data.attrs.get(f"seconds_{k}", 0.0)) for k in ("setup", "stepping")}
    with writing(path) as temporary:
        netcdf_attributes(data).to_netcdf(temporary, engine="h5netcdf")
        total = file_digest(temporary)
    cost = {"seconds": seconds, "peak_memory_mb": peak_memory_mb}
    with writing(path.with_suffix(".json")) as temporary:
        temporary.write_text(json.dumps({"sha256": total, **cost}) + "\n", "utf-8")


def load_run(path: Path) -> tuple[StoredRun | None, str]:
    """Read a finished run.

    Returns
    -------
    run : StoredRun or None
        None when there is none, or when it is damaged.
    damage : str
        What is wrong with it, for the user; "" otherwise.
    """
    slip = path.with_suffix(".json")
    if not path.exists() or not slip.exists():
        return None, ""
    try:
        entry = json.loads(slip.read_text("utf-8"))
        if entry["sha256"] != file_digest(path):
            return None, f"{path}: is damaged (its content does not match its checksum)"
        data = xr.load_dataset(path, engine="h5netcdf")
        cost = {key: entry[key] for key in ("seconds", "peak_memory_mb")}
    except (OSError, ValueError, KeyError, TypeError, RuntimeError) as error:
        return None, f"{path}: is damaged ({error})"
    return StoredRun(data, cost), ""

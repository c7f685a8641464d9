"""Files that are either whole or not there."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from contactstudy.exceptions import InputError

#: Attributes of a run that depend on the machine; they stay out of ``result.nc``.
MACHINE_ATTRIBUTES = ("seconds_setup", "seconds_stepping", "peak_memory_mb")


@contextlib.contextmanager
def writing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside `path`; rename it to `path` when the block succeeds.

    Parameters
    ----------
    path : Path
        The final file; its directory is made when absent.

    Raises
    ------
    InputError
        When the directory cannot be made or written.
    """
    ensure_writable(path.parent)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)  # mkstemp makes files that only their owner can read
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def ensure_writable(directory: Path) -> None:
    """Make `directory` and try to write in it; `InputError` says why when that fails."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            pass
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"output folder {directory}: cannot be written ({reason}); "
            "give a folder that can be made and written with --out"
        ) from error


def netcdf_attributes(run: xr.Dataset, drop: tuple[str, ...] = MACHINE_ATTRIBUTES) -> xr.Dataset:
    """Copy of `run` whose attributes netCDF can hold: no None, no booleans, none of `drop`."""

    def clean(attrs: dict[Any, Any]) -> dict[str, Any]:
        kept = {str(k): v for k, v in attrs.items() if v is not None and k not in drop}
        return {k: int(v) if isinstance(v, bool | np.bool_) else v for k, v in kept.items()}

    copy = run.copy()
    copy.attrs = clean(run.attrs)
    for variable in copy.variables.values():
        variable.attrs = clean(variable.attrs)
    return copy

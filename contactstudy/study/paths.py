"""Paths inside a study file, which are relative to the file."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any


def resolve_paths(table: Any, keys: Iterable[str], base: Path, *, or_name: bool = False) -> None:
    """Make paths in a table of a study file, which are relative to the file, relative to here.

    Parameters
    ----------
    table : object
        Changed in place; what is no table is left to the check of its values.
    keys : iterable of str
        Keys that hold paths; empty ones are left alone.
    base : Path
        Folder of the study file.
    or_name : bool
        The keys may hold the name of something shipped, which has no suffix.
    """
    if not isinstance(table, dict):
        return
    for key in keys:
        name = table.get(key)
        if isinstance(name, str) and (Path(name).suffix if or_name else name):
            table[key] = str(base / name)

"""Where a result comes from: program and package versions, seed, hash of the inputs, mesh."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import contactstudy

#: Packages that compute or write what is in the results.
PACKAGES = (
    "numpy",
    "scipy",
    "numba",
    "trimesh",
    "python-fcl",
    "xarray",
    "h5netcdf",
    "h5py",
    "meshio",
    "matplotlib",
    "typst",
)


def versions() -> dict[str, str]:
    """Package -> version, the program and Python first; packages that are absent are left out."""
    found = {"contactstudy": contactstudy.__version__, "Python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:  # cannot make a result then either
            continue
    return found


def provenance(
    seed: int | None, inputs_hash: str, mesh: dict[str, Any] | None, files: dict[str, str]
) -> dict[str, Any]:
    """Content of ``StudyResults.provenance``.

    Parameters
    ----------
    seed : int or None
        Of the irregularity's phases; None when nothing is random.
    inputs_hash : str
        Hash of all resolved parameters, input files and the program's code.
    mesh : dict or None
        Recipe of the solid rail's cell.
    files : dict of str to str
        Name of each input file -> SHA-256 of its content.
    """
    return {
        "seed": seed,
        "hash": inputs_hash,
        "versions": versions(),
        "mesh": mesh,
        "files": files,
        "sources": [f"{name}, SHA-256 {content}" for name, content in files.items()],
    }

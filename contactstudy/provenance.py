"""Where a result comes from: program and package versions, seed, hash of the inputs, mesh."""

from __future__ import annotations

import functools
import platform
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from contactstudy.code import code_digest
from contactstudy.version import __version__

#: Packages whose code decides the numbers; `WRITING` ones only keep, draw or print them.
COMPUTING = ("numpy", "scipy", "numba", "trimesh", "python-fcl")
WRITING = ("xarray", "h5netcdf", "h5py", "meshio", "matplotlib", "typst")


@functools.cache
def versions(packages: tuple[str, ...] = COMPUTING + WRITING) -> Mapping[str, str]:
    """Package -> version, the program and Python first; packages that are absent are left out."""
    found = {"contactstudy": __version__, "Python": platform.python_version()}
    for package in packages:
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
    seed
        Of the irregularity's phases; None when nothing is random.
    inputs_hash
        Hash of all resolved parameters, input files and the program's code.
    mesh
        Recipe of the solid rail's cell.
    files
        Name of each input file -> SHA-256 of its content.
    """
    return {
        "seed": seed,
        "hash": inputs_hash,
        "versions": dict(versions()),
        "code": code_digest()[:16],
        "mesh": mesh,
        "files": files,
        "sources": [f"{name}, SHA-256 {content}" for name, content in files.items()],
    }

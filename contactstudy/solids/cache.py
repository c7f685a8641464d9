"""Condensed bodies on disk, under a hash of all that they are made from.

An entry is written to a temporary file and renamed, carries a checksum of its arrays, and is
rebuilt when it does not pass it.
"""

import hashlib
import os
import tempfile
import warnings
from collections.abc import Callable
from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import platformdirs

from contactstudy.resources import resource

Body = TypeVar("Body")
_CHECKSUM = "checksum"


class CacheWarning(UserWarning):
    """A cache entry was damaged and rebuilt, or could not be written."""


def cache_directory() -> Path:
    """Where condensed bodies are kept: ``CONTACTSTUDY_CACHE`` or the user's cache folder."""
    named = os.environ.get("CONTACTSTUDY_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("contactstudy"))


@cache
def _sources() -> bytes:
    """Digest of the code and the profiles that condensed bodies depend on."""
    package = Path(__file__).parent
    files = sorted(package.glob("*.py")) + sorted((package.parent / "profiles").glob("*.py"))
    files += sorted(resource("meshes").rglob("*.toml"))
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.digest()


def entry_path(recipe: Any, directory: Path | None = None) -> Path:
    """File of the body that a recipe makes."""
    key = hashlib.sha256(repr(recipe).encode() + _sources()).hexdigest()[:32]
    return (directory or cache_directory()) / f"{type(recipe).__name__}-{key}.npz"


def cached(
    build: Callable[[Any], Body],
    body: Callable[..., Body],
    recipe: Any,
    directory: Path | None = None,
) -> Body:
    """The body that ``build(recipe)`` makes, from disk if it is there and whole.

    Parameters
    ----------
    build : callable
        Makes the body from its recipe.
    body : type
        Frozen dataclass with the field ``recipe``; all other fields are arrays.
    recipe : object
        Frozen dataclass; equal recipes have equal ``repr``.
    directory : Path, optional
        Folder of the entries; by default `cache_directory`.

    Returns
    -------
    Body

    Warns
    -----
    CacheWarning
        If an entry is damaged (it is rebuilt), or cannot be written (the body is used all the
        same and will have to be made again).
    """
    path = entry_path(recipe, directory)
    names = [f.name for f in fields(body) if f.name != "recipe"]  # type: ignore[arg-type]
    if path.exists():
        try:
            return body(recipe=recipe, **_read(path, names))
        except (OSError, ValueError, KeyError, EOFError, ArithmeticError) as error:
            message = f"cache entry {path} is damaged ({error}); it is made again"
            warnings.warn(message, CacheWarning, stacklevel=2)
    made = build(recipe)
    try:
        _write(path, {name: np.asarray(getattr(made, name)) for name in names})
    except OSError as error:
        message = f"cache entry {path} cannot be written ({error}); the result is used uncached"
        warnings.warn(message, CacheWarning, stacklevel=2)
    return made


def _digest(arrays: dict[str, np.ndarray]) -> str:
    digest = hashlib.sha256()
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        digest.update(f"{name} {array.dtype} {array.shape} ".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()


def _read(path: Path, names: list[str]) -> dict[str, np.ndarray]:
    # zipfile reports a damaged archive by several exceptions of its own; all mean the same
    try:
        with np.load(path, allow_pickle=False) as data:
            arrays = {name: data[name] for name in names}
            checksum = str(data[_CHECKSUM])
    except OSError:
        raise
    except Exception as error:
        raise ValueError(f"not a readable archive: {error}") from error
    if checksum != _digest(arrays):
        raise ValueError("its checksum does not fit its content")
    return arrays


def _write(path: Path, arrays: dict[str, np.ndarray]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.stem, suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as file:
            entries: dict[str, Any] = {**arrays, _CHECKSUM: np.array(_digest(arrays))}
            np.savez(file, allow_pickle=False, **entries)
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise

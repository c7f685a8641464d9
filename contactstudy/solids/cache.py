"""Condensed bodies: made once, and then taken from the store in the user's cache folder."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

from contactstudy.exceptions import InputError, StorageError, reason
from contactstudy.files import alone
from contactstudy.store import ARRAYS, Store, StoreWarning, store_key

Made = TypeVar("Made")


@dataclass(frozen=True)
class CachedBody(Generic[Made]):
    """A body to condense.

    Attributes
    ----------
    name : str
        For the user: "rail".
    recipe : object
        Frozen dataclass of plain values; what the body is made from.
    build : callable
        Makes the body from its recipe.
    made : type
        What `build` returns: a frozen dataclass with the field ``recipe``; all other fields are
        arrays.
    """

    name: str
    recipe: Any
    build: Callable[[Any], Made]
    made: Callable[..., Made]

    @property
    def key(self) -> str:
        """Hash of the recipe and of the code that makes the body."""
        return store_key(repr(self.recipe), self.build)


def cache_directory() -> Path:
    """Where condensed bodies are kept: ``CONTACTSTUDY_CACHE`` or the user's cache folder."""
    import platformdirs

    named = os.environ.get("CONTACTSTUDY_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("contactstudy"))


def cache_store(directory: Path | None = None) -> Store:
    """The store of condensed bodies, by default in `cache_directory`."""
    return Store(directory or cache_directory(), ARRAYS)


def is_cached(body: CachedBody[Any]) -> bool:
    """Whether a body is in the user's cache."""
    return cache_store().has(_name(body), body.key)


def cached(body: CachedBody[Made], store: Store | None = None) -> Made:
    """A body, from the store if it is there and whole; condensed and kept otherwise.

    Parameters
    ----------
    store : Store, optional
        By default `cache_store`.

    Warns
    -----
    StoreWarning
        If an entry is damaged (it is made again), or cannot be written (the body is used all the
        same and will have to be made again).
    """
    store = store or cache_store()
    kept = store.load(_name(body), body.key)
    if kept.value is None:
        with alone(store.path(_name(body), body.key)):
            return _made(body, store)
    return body.made(recipe=body.recipe, **kept.value)


def _made(body: CachedBody[Made], store: Store) -> Made:
    """A body that was not in the store, unless another process has made it meanwhile."""
    name, key = _name(body), body.key
    kept = store.load(name, key)
    if kept.value is not None:
        return body.made(recipe=body.recipe, **kept.value)
    if kept.damage:
        warnings.warn(f"{kept.damage}; it is made again", StoreWarning, stacklevel=3)
    made = body.build(body.recipe)
    names = [f.name for f in fields(body.made) if f.name != "recipe"]  # type: ignore[arg-type]
    try:
        store.save(name, key, {field: np.asarray(getattr(made, field)) for field in names})
    except (InputError, StorageError) as error:
        why = reason(error.__cause__)
        message = f"cache entry {store.path(name, key)} cannot be written ({why})"
        warnings.warn(f"{message}; the result is used uncached", StoreWarning, stacklevel=3)
    return made


def entry_path(body: CachedBody[Any], store: Store | None = None) -> Path:
    """File of a body in the store."""
    return (store or cache_store()).path(_name(body), body.key)


def _name(body: CachedBody[Any]) -> str:
    return type(body.recipe).__name__

"""Functions that numba compiles, without loading numba before the first of them is called."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import inspect
import pickle
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any


class Compiled:
    """A function that numba compiles at its first call, or takes from its cache on disk.

    It may call other compiled functions, of other modules too, and use their constants; the
    options are those of ``numba.njit``.
    """

    def __init__(self, function: Callable[..., Any], **options: Any) -> None:
        functools.update_wrapper(self, function)
        self.py_func, self._options = function, options

    def __call__(self, *arguments: Any) -> Any:
        """Call it with positional arguments only."""
        return self.compiled(*arguments)

    @functools.cached_property
    def compiled(self) -> Callable[..., Any]:
        """The function as numba makes it."""
        from numba import config, njit

        # sums for several lanes that are written out side by side become one instruction
        setattr(config, "SLP_VECTORIZE", 1)  # noqa: B010 - unknown to type checkers
        function = self.py_func
        known = function.__globals__
        # numba looks at a function's own file only to see whether what it kept is still valid;
        # what is kept stands under the qualified name
        if elsewhere := _modules(function) - {function.__module__}:
            function.__qualname__ += f"-{_digest(elsewhere)}"
        for name in function.__code__.co_names:
            if isinstance(known.get(name), Compiled):  # numba must find its own there
                known[name] = known[name].compiled
        found: Any
        try:
            found = njit(cache=True, **self._options)(function)
            for name in ("load_overload", "save_overload"):
                setattr(found._cache, name, _if_possible(getattr(found._cache, name)))
        except RuntimeError:  # no folder to keep it in, neither beside the code nor the user's
            found = njit(**self._options)(function)
        if known.get(function.__name__) is self:  # its own module need not ask again
            known[function.__name__] = found
        return found


def _if_possible(access: Callable[..., Any]) -> Callable[..., Any]:
    """Access to what numba keeps on disk; without it, as when the disk is full, it compiles."""

    def tried(*arguments: Any) -> Any:
        with contextlib.suppress(OSError, EOFError, pickle.UnpicklingError):
            return access(*arguments)

    return tried


def compiled(function: Callable[..., Any]) -> Compiled:
    """Compile with numba; a decorator."""
    return Compiled(function)


def compiled_in_any_order(function: Callable[..., Any]) -> Compiled:
    """Compile a sum whose terms may be added in any order; a decorator."""
    return Compiled(function, fastmath={"reassoc", "contract"})


def _modules(function: Callable[..., Any]) -> set[str]:
    """Modules of the functions that are compiled into one, its own included."""
    found, waiting = set[Callable[..., Any]](), [function]
    while waiting:
        one = waiting.pop()
        if one not in found:
            found.add(one)
            waiting += _called(one)
    return {one.__module__ for one in found}


def _called(function: Callable[..., Any]) -> Iterator[Callable[..., Any]]:
    """Compiled functions that are named in one, whether numba has them already or not."""
    for name in function.__code__.co_names:
        named = function.__globals__.get(name)
        if (callee := getattr(named, "py_func", None)) is not None:
            yield callee


def _digest(modules: set[str]) -> str:
    """Short hash of the source of modules."""
    import sys

    total = hashlib.sha256()
    for module in sorted(modules):
        total.update(Path(inspect.getfile(sys.modules[module])).read_bytes())
    return total.hexdigest()[:12]

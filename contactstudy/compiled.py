"""Functions that numba compiles, without loading numba before the first of them is called."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any


class Compiled:
    """A function that numba compiles at its first call, or takes from its cache on disk.

    It may call other compiled functions of its module; the options are those of ``numba.njit``.
    """

    def __init__(self, function: Callable[..., Any], **options: Any) -> None:
        functools.update_wrapper(self, function)
        self._function, self._options = function, options

    def __call__(self, *arguments: Any) -> Any:
        """Call it with positional arguments only."""
        return self.compiled(*arguments)

    @functools.cached_property
    def compiled(self) -> Callable[..., Any]:
        """The function as numba makes it."""
        from numba import njit

        known = self._function.__globals__
        for name in self._function.__code__.co_names:
            if isinstance(known.get(name), Compiled):  # numba must find its own there
                known[name] = known[name].compiled
        found: Callable[..., Any]
        try:
            found = njit(cache=True, **self._options)(self._function)
        except RuntimeError:  # no folder to keep it in, neither beside the code nor the user's
            found = njit(**self._options)(self._function)
        if known.get(self._function.__name__) is self:  # its own module need not ask again
            known[self._function.__name__] = found
        return found


def compiled(function: Callable[..., Any]) -> Compiled:
    """Compile with numba; a decorator."""
    return Compiled(function)


def compiled_in_any_order(function: Callable[..., Any]) -> Compiled:
    """Compile a sum whose terms may be added in any order; a decorator."""
    return Compiled(function, fastmath={"reassoc", "contract"})

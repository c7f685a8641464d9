"""A named case: where its function is and what it needs."""

from __future__ import annotations

import contextlib
import importlib
import io
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from contactstudy.exceptions import InputError
from contactstudy.verification.check import CaseResult


@dataclass(frozen=True)
class Case:
    """Where a named case is found, and what it needs.

    Attributes
    ----------
    function : str
        "module:function"; takes nothing, returns a `CaseResult` of the same name. Imported when
        called, so that listing the cases is quick.
    slow : bool
        Takes more than about 20 s; left out by ``--quick`` and by the quick tests.
    needs : tuple of str
        "program:ccx" or "package:tamaas": what must be installed.
    """

    name: str
    function: str
    slow: bool = False
    needs: tuple[str, ...] = ()

    @property
    def about(self) -> str:
        """What a user must know before calling it, e.g. "slow, needs the program ccx"."""
        needed = [f"the {need.replace(':', ' ')}" for need in self.needs]
        parts = ["slow"] * self.slow + [f"needs {' and '.join(needed)}"] * bool(needed)
        return ", ".join(parts)

    def load(self) -> Callable[[], CaseResult]:
        """The function itself."""
        module, _, function = self.function.partition(":")
        found: Callable[[], CaseResult] = getattr(importlib.import_module(module), function)
        return found

    def missing(self) -> tuple[str, ...]:
        """What is needed and not installed, or cannot be imported, e.g. "the program ccx"."""
        absent = []
        for need in self.needs:
            kind, _, name = need.partition(":")
            if not (shutil.which(name) if kind == "program" else _imports(name)):
                absent.append(f"the {kind} {name}")
        return tuple(absent)


def _imports(name: str) -> bool:
    """Whether a package is there; one may be without its compiled part, for another Python."""
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            importlib.import_module(name)
        except ImportError:
            return False
    return True


def select(cases: Sequence[Case], names: tuple[str, ...] = ()) -> tuple[Case, ...]:
    """Cases by name, in the order of `cases`; all without names.

    Raises
    ------
    InputError
        For each name that is not there, with those that are.
    """
    known = {case.name: case for case in cases}
    problems = [
        f"case {name!r}: unknown; the cases are {', '.join(known) or 'none'}"
        for name in names
        if name not in known
    ]
    if problems:
        raise InputError(problems)
    return tuple(case for case in cases if not names or case.name in names)

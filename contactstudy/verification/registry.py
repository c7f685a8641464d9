"""The named cases, in the order of the verification document."""

from __future__ import annotations

import importlib
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec

from contactstudy.exceptions import InputError
from contactstudy.verification.check import CaseResult


@dataclass(frozen=True)
class Case:
    """Where a named case is found, and what it needs.

    Attributes
    ----------
    name : str
    function : str
        "module:function" below ``contactstudy.verification.cases``; takes nothing, returns a
        `CaseResult` of the same name. Imported when called, so that listing the cases is quick.
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
        found: Callable[[], CaseResult] = getattr(
            importlib.import_module(f"contactstudy.verification.cases.{module}"), function
        )
        return found

    def missing(self) -> tuple[str, ...]:
        """What is needed and not installed, e.g. "the program ccx"."""
        absent = []
        for need in self.needs:
            kind, _, name = need.partition(":")
            present = shutil.which(name) if kind == "program" else find_spec(name)
            if present is None:
                absent.append(f"the {kind} {name}")
        return tuple(absent)


#: All cases. To add one: a function in a module of this package, and a line here.
CASES: tuple[Case, ...] = (
    Case("hertz_line", "hertz_line:line"),
    Case("hertz_sphere", "hertz:sphere"),
    Case("hertz_ellipses", "hertz:ellipses", slow=True),
    Case("ssnv104", "hertz:ssnv104"),
    Case("reduction", "reduction:passage", slow=True),
    Case("subsurface_line", "subsurface:line_case"),
    Case("subsurface_sphere", "subsurface:sphere_case", slow=True),
    Case("subsurface_ellipse", "subsurface:ellipse_case"),
    Case("scanned_profiles", "scans:scanned_profiles"),
    Case("tamaas_codes", "halfspace_codes:tamaas_codes", needs=("package:tamaas",)),
    Case("manchester_published", "manchester_case:manchester_published"),
    Case("manchester", "manchester_case:manchester", slow=True),
    Case("s1002_solid", "s1002:solid_press", slow=True),
    Case("patch_filter", "patch_filter:patch_filter", slow=True),
    Case("convergence", "convergence:summary", slow=True),
    Case("convergence_mesh", "convergence:mesh", slow=True),
    Case("convergence_penalty", "convergence:penalty", slow=True),
    Case("convergence_modes", "convergence:modes", slow=True),
    Case("convergence_time_step", "convergence:time_step", slow=True),
    Case("wheel_disc", "wheel:disc"),
    Case("wheel_modes", "wheel:brute_force", slow=True),
    Case("wheel_statics", "wheel_statics:statics", slow=True),
    Case("calculix_coarse", "calculix:press_on_coarse_mesh", needs=("program:ccx",)),
    Case("calculix", "calculix:press_on_default_mesh", slow=True, needs=("program:ccx",)),
    Case(
        "calculix_whole",
        "calculix_whole:press_with_yaw",
        slow=True,
        needs=("program:ccx",),
    ),
    Case(
        "calculix_corner",
        "calculix_whole:press_on_gauge_corner",
        slow=True,
        needs=("program:ccx",),
    ),
)


def select(names: tuple[str, ...] = ()) -> tuple[Case, ...]:
    """Cases by name in the order of `CASES`; all without names.

    Raises
    ------
    InputError
        For each name that is not there, with those that are.
    """
    known = {case.name: case for case in CASES}
    problems = [
        f"case {name!r}: unknown; the cases are {', '.join(known) or 'none'}"
        for name in names
        if name not in known
    ]
    if problems:
        raise InputError(problems)
    return tuple(case for case in CASES if not names or case.name in names)

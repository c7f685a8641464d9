"""The smooth twin of a run: the same run on a rail without irregularity.

What the irregularity causes is the signal minus that of the twin. Variants that differ in their
irregularity only share their twins.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from contactstudy.solvers.dataset import POINT_SIGNALS, SECTION_SIGNALS
from contactstudy.solvers.dataset import SIGNALS as RUN_SIGNALS
from contactstudy.study.kinds.passage.runs import SurfaceRun
from contactstudy.study.kinds.passage.schema import Study

if TYPE_CHECKING:
    import xarray as xr

SIGNALS = (
    "contact_force", "wheel_displacement", "wheel_acceleration", "rail_displacement",
    "rail_acceleration",
)  # fmt: skip
"""Histories that are compared."""
SMOOTH = "_smooth"
"""What the name of a twin's history ends with."""
_TWIN = ".smooth"  # no run's name has a dot


def twins(study: Study) -> dict[str, str]:
    """Run -> name of its twin's piece of work, where the study asks for twins."""
    if not study.smooth:
        return {}
    return {n: n + _TWIN for n, run in study.runs.items() if run.irregularity != "smooth"}


def histories(study: Study) -> list[str]:
    """Names of what the runs hold over time, and of surface contact along its static press.

    Of several wheels there is only the time: the others have a dimension more.
    """
    if study.vehicle.vehicle().n_wheels > 1:
        return ["time"]
    surface = [r for r in study.runs.values() if isinstance(r, SurfaceRun)]
    found = ["time", "position", *(POINT_SIGNALS if len(surface) < len(study.runs) else ())]
    if surface:
        section = SECTION_SIGNALS if study.solid.half else ()
        found += [name for name in RUN_SIGNALS if name not in section]
        found += ["press_force", "press_approach", "press_penetration"]
    if twins(study):
        found += [name + SMOOTH for name in SIGNALS]
    return list(dict.fromkeys(found))


def untwinned(study: Study, name: str) -> tuple[Study, str]:
    """The study and run behind a piece of work; of a twin the study with that run smooth."""
    if not name.endswith(_TWIN):
        return study, name
    run = name.removesuffix(_TWIN)
    smooth = replace(study.runs[run], irregularity="smooth")
    return replace(study, runs=study.runs | {run: smooth}), run


def with_twins(study: Study, found: Mapping[str, xr.Dataset]) -> dict[str, xr.Dataset]:
    """Runs of the finished pieces of work, with the histories of their twins beside their own."""
    own = twins(study)
    return {
        name: found[name].assign(
            {
                s + SMOOTH: found[own[name]][s].assign_attrs(
                    long_name=f"{found[name][s].attrs.get('long_name', s)}, on a smooth rail"
                )
                for s in SIGNALS
                if name in own and s in found[name]
            }
        )
        for name in study.runs
    }

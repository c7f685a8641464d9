"""Twins of a run, which differ from it in one thing: on a smooth rail, or with a softer spring.

What the irregularity causes is the signal minus that of the smooth twin. Variants that differ in
their irregularity only share their smooth twins. What the error owes to the choice of k_r is that
of the softer twin.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from contactstudy.solvers.bridge_sensors import VARIABLES
from contactstudy.solvers.dataset import POINT_SIGNALS, SECTION_SIGNALS, SURFACE_SIGNALS
from contactstudy.solvers.whole_patch import with_maps
from contactstudy.study.kinds.passage.runs import PointRun, SurfaceRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.validation import multiple

if TYPE_CHECKING:
    import xarray as xr

SIGNALS = (
    "contact_force", "wheel_displacement", "wheel_acceleration", "rail_displacement",
    "rail_acceleration",
)  # fmt: skip
"""Histories that are compared."""
OF_DECK = ("deck_displacement", "deck_acceleration")
"""Compared too, over all stations on decks together."""
SMOOTH, SOFTER = "_smooth", "_softer"
"""What the names of a twin's histories end with."""
_SMOOTH_TWIN, _SOFTER_TWIN = ".smooth", ".softer"  # no run's name has a dot


def twins(study: Study) -> dict[str, str]:
    """Run -> name of its smooth twin's piece of work, where the study asks for twins."""
    if not study.smooth:
        return {}
    return {n: n + _SMOOTH_TWIN for n, run in study.runs.items() if run.irregularity != "smooth"}


def softer_twins(study: Study) -> dict[str, str]:
    """Linear run -> name of its softer twin's piece of work, where the study asks for them."""
    if not study.softer:
        return {}
    return {n: n + _SOFTER_TWIN for n, run in study.runs.items() if _linear(run)}


def _linear(run: PointRun | SurfaceRun) -> bool:
    return isinstance(run, PointRun) and run.law == "linear" and not run.rigid


def all_pieces(study: Study) -> list[str]:
    """Names of all runs and twins."""
    return [*study.runs, *twins(study).values(), *softer_twins(study).values()]


def histories(study: Study) -> list[str]:
    """Names of what the runs hold over time, and of surface contact along its static press.

    Of several wheels and stations they have a dimension more.
    """
    found = ["time", "position", *POINT_SIGNALS]
    if study.track.structure is not None:
        found += list(VARIABLES)
    elif study.journey.stations:
        found.append("station_displacement")
    if any(isinstance(run, SurfaceRun) for run in study.runs.values()):
        found += [*SURFACE_SIGNALS, *(() if study.solid.half else SECTION_SIGNALS)]
        found += ["press_force", "press_approach", "press_penetration"]
    if twins(study):
        found += [name + SMOOTH for name in SIGNALS]
    return found


def run_of(name: str) -> str:
    """The run behind a piece of work."""
    return name.partition(".")[0]


def changes(study: Study, name: str) -> dict[str, Any]:
    """Values of a run that are others in a piece of work, its twin; none in its own."""
    own = study.runs[run_of(name)]
    if name.endswith(_SMOOTH_TWIN):
        return {"irregularity": "smooth"}
    if name.endswith(_SOFTER_TWIN):
        assert isinstance(own, PointRun)
        return {"k_r": _softer(own.k_r, 1.0 - study.softer)}
    return {}


def untwinned(study: Study, name: str) -> tuple[Study, str]:
    """The study and run behind a piece of work; of a twin the study with that run changed."""
    run, changed = run_of(name), changes(study, name)
    if not changed:
        return study, run
    return replace(study, runs=study.runs | {run: replace(study.runs[run], **changed)}), run


def _softer(k_r: float | str, part: float) -> Any:
    if isinstance(k_r, int | float):
        return part * k_r
    factor, name = multiple(k_r)
    return f"{part * factor!r} x {name}"


def collect(study: Study, found: Mapping[str, xr.Dataset]) -> dict[str, xr.Dataset]:
    """Runs as they are shown: with their twins' histories, fields of the patch also as maps."""
    return {name: with_maps(run) for name, run in with_twins(study, found).items()}


def with_twins(study: Study, found: Mapping[str, xr.Dataset]) -> dict[str, xr.Dataset]:
    """Runs of the finished pieces of work, with the histories of their twins beside their own."""
    own, softer = twins(study), softer_twins(study)
    made, named = {}, (*SIGNALS, *OF_DECK)
    for name in study.runs:
        run = found[name]
        if name in own:
            run = run.assign(_histories(run, found[own[name]], named, SMOOTH, "on a smooth rail"))
        if name in softer:
            part = 1.0 - study.softer
            text = f"with {part:g} of its k_r"
            force = _histories(run, found[softer[name]], SIGNALS[:1], SOFTER, text)
            run = run.assign(
                {key: history.assign_attrs(part_of_k_r=part) for key, history in force.items()}
            )
        made[name] = run
    return made


def _histories(
    run: xr.Dataset, twin: xr.Dataset, names: tuple[str, ...], ending: str, text: str
) -> dict[str, xr.DataArray]:
    return {
        s + ending: twin[s].assign_attrs(long_name=f"{run[s].attrs.get('long_name', s)}, {text}")
        for s in names
        if s in run
    }

"""What a study will need, without running it: sizes, steps and the expected time."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from rich.table import Table

from contactstudy.exceptions import InputError
from contactstudy.reporter import Reporter
from contactstudy.solids.cache import is_cached
from contactstudy.study.kinds.passage import build, contact
from contactstudy.study.kinds.passage.level import deviations
from contactstudy.study.kinds.passage.roughness import irregularity_of
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.twins import untwinned
from contactstudy.track.beam import BeamTrack, RailTheory
from contactstudy.track.model import Direction, DiscreteSupports, Slab, Track

# Rough costs on a core of 2020 or later, measured with the shipped studies; for a forecast only.
START = 4.0  # s, a process with its imports
# s, at 2 mm
CONDENSATION = {"rail": 20.0, "wheel": 20.0, "wheel modes": 3.0, "press": 2.0, "bay": 2.0}
WHOLE = 5.0  # how much dearer the rail's whole section is to condense
POINT_STEP, POINT_STEP_PER_DOF = 20e-6, 0.05e-6  # s
SOLID_STEP, SOLID_STEP_PER_DOF = 300e-6, 0.2e-6  # s


def _forecast(study: Study, run: str, track: Track) -> tuple[int, int, float]:
    """Dofs and steps of one run of a study on its `track`, and the seconds it will take, about."""
    table = study.runs[run]
    steps = build.journey(study, run).n_steps
    wheels = study.vehicle.vehicle().n_dofs
    if isinstance(table, PointRun) and not table.needs_solid:
        theory = "timoshenko" if table.rail == "timoshenko" else "euler"
        beam = theory, table.elements_per_bay, table.local_compliance, table.direction
        dofs = _beam_dofs(track, *beam) + wheels
        return dofs, steps, START + steps * (POINT_STEP + POINT_STEP_PER_DOF * dofs)
    dofs = solid_dofs(study, track) + wheels
    return dofs, steps, START + steps * (SOLID_STEP + SOLID_STEP_PER_DOF * dofs)


@lru_cache(maxsize=32)
def _beam_dofs(
    track: Track,
    theory: RailTheory,
    elements_per_bay: int,
    element_compliance: bool,
    direction: Direction,
) -> int:
    return BeamTrack(track, theory, elements_per_bay, element_compliance, direction).n_dofs


def solid_dofs(study: Study, track: Track) -> int:
    """Number of dofs of the chain of cells on its supports, without condensing a cell."""
    solid = study.solid
    cells = round(track.length / solid.cell_length)
    # ends that let the rail slide along X are held there by one dof
    whole = not solid.half
    pinned = 7 if whole else 3
    held = {"clamped": 2 * solid.interface_modes, "pinned": pinned, "free": 1}[track.ends]
    below = 0
    if isinstance(track.support, DiscreteSupports):
        # a half sleeper moves vertically; a node of the slab turns as well
        below = (2 if isinstance(track.support.layer, Slab) else 1) * (track.n_bays + 1)
        below *= 1 + whole  # vertical, and of a whole section also lateral
    planes = (cells + 1) * solid.interface_modes
    return planes + cells * solid.internal_modes + below - held


def seconds(study: Study, name: str) -> float:
    """Time that a run, or its smooth twin, will take in a process that runs already."""
    owner, run = untwinned(study, name)
    return _forecast(owner, run, build.track(owner))[2] - START


def needs(study: Study, companions: Sequence[Any], reporter: Reporter) -> list[str | Table]:
    """Static contact, sizes of the runs of a study and its companions, and the expected time.

    Raises
    ------
    InputError
        When a profile or a scan cannot be used.
    """
    studies = [study, *(c for c in companions if isinstance(c, Study))]
    found: list[str | Table] = [_contact(study)] if study.runs else []
    if told := deviations(study.irregularity, irregularity_of(study)):
        found.append(f"standard deviation of the irregularity: {told}")
    sizes, times = Table("run", "dofs", "steps", "expected time (s)"), [0.0]
    for one in studies:
        for name in one.runs:
            dofs, steps, seconds = _forecast(one, name, build.track(one))
            label = name if one is study else f"{one.name}: {name}"
            times.append(seconds)
            sizes.add_row(label, str(dofs), str(steps), f"{seconds:.0f}")
    if len(times) == 1:
        return [*found, "no runs: figures of the irregularity only"]
    seconds = max(*times, sum(times) / 2) + _condensation(studies)
    told = f"about {seconds:.0f} s with two runs at a time, figures and report not counted"
    return [*found, sizes, told]


def _contact(study: Study) -> str:
    """Static load and Hertz's contact, which conformal profiles do not have."""
    load = study.vehicle.static_load
    text = f"static wheel load {load / 1e3:.2f} kN; "
    try:
        hertz = contact.hertz(study)
    except InputError as error:
        points = [run for run in study.runs.values() if isinstance(run, PointRun)]
        if any(run.law_of_hertz for run in points):
            raise
        return f"{text}{error}"
    return (
        f"{text}Hertz: approach {hertz.approach * 1e6:.1f} µm, "
        f"tangent stiffness {hertz.tangent_stiffness / 1e9:.3f} GN/m"
    )


def _condensation(studies: Sequence[Study]) -> float:
    """Seconds of condensing what the cache does not have; rail and wheel at the same time."""
    needed = [
        CONDENSATION[b.name] * (WHOLE if b.name == "rail" and not one.solid.half else 1)
        for one in studies
        for run in one.runs
        for b in contact.bodies(one, run)
        if not is_cached(b)
    ]
    return max(needed, default=0.0)

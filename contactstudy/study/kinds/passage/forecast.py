"""What a study will need, without running it: sizes, steps and the expected time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from rich.table import Table

from contactstudy.exceptions import InputError
from contactstudy.process import machine_memory
from contactstudy.reporter import Reporter
from contactstudy.solids.cache import CachedBody, is_cached
from contactstudy.solids.cell import section_mesh_of
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.study.kinds.passage import build, contact
from contactstudy.study.kinds.passage.level import deviations
from contactstudy.study.kinds.passage.on_bridge import planar_on
from contactstudy.study.kinds.passage.roughness import irregularity_of
from contactstudy.study.kinds.passage.runs import PointRun
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.twins import run_of
from contactstudy.track.beam import BeamTrack, RailTheory
from contactstudy.track.model import DiscreteSupports, Slab, Track
from contactstudy.track.structure import StructureTrack
from contactstudy.validation import raise_if
from contactstudy.vehicle import Vehicle

_HEAD = "run", "dofs", "steps", "expected time (s)", "memory (GB)"
# Rough costs on a core of 2020 or later, measured with the shipped studies; for a forecast only.
START = 4.0  # s, a process with its imports
MADE = {"wheel modes": 3.0, "press": 2.0, "bay": 2.0}  # s, at 2 mm
POINT_STEP, POINT_STEP_PER_DOF = 20e-6, 0.05e-6  # s
SOLID_STEP, SOLID_STEP_PER_DOF = 300e-6, 0.2e-6  # s
TERM = 2e-9  # s, a term of the irregularity in a step
ASSEMBLY = 0.1e-3  # s a dof of a beam
# bytes of a process, a dof of a beam, and a value that is kept of a step
PROCESS, DOF, KEPT = 0.3e9, 2500, 24
CHANNELS = 12  # of a run's histories, beside stations


@dataclass(frozen=True)
class Needs:
    """What a run or a body will need, about: dofs, steps, time [s] and memory [bytes]."""

    dofs: int
    steps: int
    seconds: float
    memory: float


def _forecast(study: Study, run: str, track: Track, vehicle: Vehicle) -> Needs:
    """What one run of a study, with its `vehicle` on its `track`, will need."""
    table = study.runs[run]
    steps = build.journey(study, run).n_steps
    terms = study.irregularity.terms if study.irregularity.generated else 1
    seconds = START + steps * terms * TERM
    memory = PROCESS + steps * (CHANNELS + len(study.journey.stations)) * KEPT
    if isinstance(table, PointRun) and not table.needs_solid:
        theory: RailTheory = "timoshenko" if table.rail == "timoshenko" else "euler"
        dofs = vehicle.n_dofs
        if track.structure is not None:
            planar = planar_on(track, vehicle)
            dofs += StructureTrack(track, theory, table.elements_per_bay, planar).n_dofs_forecast
            steps_dear = 1.0 + 0.5 * vehicle.n_contacts / 10
            seconds += steps * POINT_STEP * steps_dear
        else:
            beam = theory, table.elements_per_bay, table.local_compliance, table.direction
            dofs += BeamTrack(track, *beam).n_dofs_forecast
        seconds += dofs * ASSEMBLY + steps * (POINT_STEP + POINT_STEP_PER_DOF * dofs)
        return Needs(dofs, steps, seconds, memory + dofs * DOF)
    dofs = solid_dofs(study, track) + vehicle.n_dofs
    seconds += steps * (SOLID_STEP + SOLID_STEP_PER_DOF * dofs)
    return Needs(dofs, steps, seconds, memory + dofs * DOF)


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


def size(study: Study, run: str) -> tuple[int, int, float]:
    """Dofs and steps of a run, and the seconds it takes, about, in a process that runs already."""
    found = _forecast(study, run, build.track(study), build.vehicle(study))
    return found.dofs, found.steps, found.seconds - START


def seconds(study: Study, name: str) -> float:
    """Time that a run, or its smooth twin, will take in a process that runs already."""
    return size(study, run_of(name))[2]


def admit(study: Study, names: Sequence[str], reporter: Reporter) -> None:
    """Refuse runs, named as work is, that this machine's memory cannot hold."""
    _runs(study, dict.fromkeys(map(run_of, names)))


def _runs(study: Study, runs: Iterable[str]) -> tuple[dict[str, Needs], list[Needs]]:
    """Needs of runs, and of the bodies that the cache does not have, if the machine holds them."""
    track, vehicle = build.track(study), build.vehicle(study)
    own = {run: _forecast(study, run, track, vehicle) for run in runs}
    bodies = {b.name: _made(b) for r in own for b in contact.bodies(study, r) if not is_cached(b)}
    needed = {f"runs.{run}": need for run, need in own.items()} | {
        f"solid.mesh_size = {study.solid.mesh_size:g} m: condensing the {name}": need
        for name, need in bodies.items()
    }
    most = machine_memory()
    raise_if(
        f"{what} needs about {need.memory / 1e9:.3g} GB of memory; this machine has "
        f"{most / 1e9:.3g} GB"
        for what, need in needed.items()
        if need.memory > most
    )
    return own, list(bodies.values())


def needs(study: Study, companions: Sequence[Any], reporter: Reporter) -> list[str | Table]:
    """Static contact, sizes of the runs of a study and its companions, and the expected time.

    Raises
    ------
    InputError
        When a profile or a scan cannot be used.
    """
    studies = [study, *(c for c in companions if isinstance(c, Study))]
    found: list[str | Table] = [_contact(study)] if study.runs else []
    found += _deck(study)
    rough = study.irregularity
    if rough.generated and (told := deviations(rough, irregularity_of(study))):
        found.append(f"standard deviation of the irregularity: {told}")
    sizes, times, made = Table(*_HEAD), [0.0], list[Needs]()
    for one in studies:
        runs, bodies = _runs(one, one.runs)
        made += bodies
        for name, need in runs.items():
            label = name if one is study else f"{one.name}: {name}"
            times.append(need.seconds)
            numbers = str(need.dofs), str(need.steps), f"{need.seconds:.0f}"
            sizes.add_row(label, *numbers, f"{need.memory / 1e9:.1f}")
    if len(times) == 1:
        return [*found, "no runs: figures of the irregularity only"]
    # rail and wheel are condensed at the same time
    seconds = max(*times, sum(times) / 2) + max((n.seconds for n in made), default=0.0)
    told = f"about {seconds:.0f} s with two runs at a time, figures and report not counted"
    if memory := max((n.memory for n in made), default=0.0):
        told += f"; condensing rail and wheel takes up to {memory / 1e9:.1f} GB"
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


def _deck(study: Study) -> list[str]:
    """First bending of the longest span, for a look at stiffness and mass of the deck."""
    bridge, loaded = study.track.structure, study.track.loaded_deck
    if bridge is None or loaded is None:
        return []
    span, more = max(bridge.spans), study.track.mass_on_structure
    return [
        f"deck: first bending of {span:g} m, simply supported, at "
        f"{bridge.deck.frequency(span):.3g} Hz, "
        f"with rails and sleepers ({more:.3g} kg/m) at {loaded.frequency(span):.3g} Hz"
    ]


def _made(body: CachedBody[Any]) -> Needs:
    """Needs of making a body, or what is made of bodies."""
    if isinstance(body.recipe, CellRecipe | WheelRecipe):
        return _condensed(body.recipe)
    return Needs(0, 0, MADE[body.name], 0.0)


@lru_cache(maxsize=64)
def _condensed(recipe: CellRecipe | WheelRecipe) -> Needs:
    """Needs of a body: blocks of n dofs, one a slice or plane, are factored in n^3, held in n^2."""
    if isinstance(recipe, CellRecipe):
        n, count = 3 * len(section_mesh_of(recipe).nodes), recipe.n_slices
        return Needs(n * count, 0, 1.0 + 3e-10 * n**3 * count, 16.0 * n**2 * count)
    loaded = len(recipe.x) * len(recipe.y)
    n, count = 3 * len(recipe.section().nodes), len(recipe.angles)
    held = n**2 * count + n * loaded * len(recipe.x) + 2.0 * loaded**2
    return Needs(n * count, 0, 1.0 + 1.1e-10 * n**3 * count, 8.0 * held)

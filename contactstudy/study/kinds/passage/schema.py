"""A study file that has been read: its tables and runs together."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass, field
from typing import Annotated, Any, ClassVar

from contactstudy.files import LONGEST_NAME, is_reserved
from contactstudy.irregularity import Irregularity
from contactstudy.solvers.journey import Journey
from contactstudy.study import study
from contactstudy.study.kinds.passage.checks import combined
from contactstudy.study.kinds.passage.on_bridge import journey_on, vehicle_on
from contactstudy.study.kinds.passage.record import MeasuredRecord
from contactstudy.study.kinds.passage.roughness_table import RoughnessTable
from contactstudy.study.kinds.passage.runs import SOLVERS, PointRun, SurfaceRun
from contactstudy.study.kinds.passage.scan import ScanFiles
from contactstudy.study.kinds.passage.solid import Solid, spacing
from contactstudy.study.kinds.passage.wheelset import WheelsetPosition
from contactstudy.study.study import NORMS
from contactstudy.track.model import Track
from contactstudy.validation import (
    AtLeast,
    AtMost,
    Key,
    Table,
    Variants,
    complaint,
    did_you_mean,
    raise_if,
    resolved,
    units,
)
from contactstudy.validation.base import wrong_type
from contactstudy.vehicle import VEHICLES, VehicleTable, WheelColumn

SECTIONS: dict[str, Table] = {
    "irregularity": Irregularity,
    "track": Track,
    "vehicle": VEHICLES,
    "journey": Journey,
    "solid": Solid,
    "wheelset": WheelsetPosition,
    "scan": ScanFiles,
    "measured": MeasuredRecord,
    "roughness": RoughnessTable,
}
"""Tables of a study file."""
_RUN_NAME = re.compile(rf"[A-Za-z][A-Za-z0-9_]{{,{LONGEST_NAME - 1}}}")
IRREGULARITY = "irregularity"
"""Group of the results with what Fig. 1 shows; so no run may have this name."""
MEASURED = "measured"
"""The same with a measured record."""


@dataclass(frozen=True)
class Study(study.Study):
    """A study file that has been read and found possible: its tables, and its `runs` in order.

    A study of the irregularity alone has no runs.
    """

    kind: ClassVar[str] = "passage"

    irregularity: Irregularity = field(default_factory=Irregularity)
    track: Track = field(default_factory=Track)
    vehicle: VehicleTable = field(default_factory=WheelColumn)
    journey: Journey = field(default_factory=Journey)
    solid: Solid = field(default_factory=Solid)
    wheelset: WheelsetPosition = field(default_factory=WheelsetPosition)
    scan: ScanFiles = field(default_factory=ScanFiles)
    measured: MeasuredRecord = field(default_factory=MeasuredRecord)
    roughness: RoughnessTable = field(default_factory=RoughnessTable)
    runs: dict[str, PointRun | SurfaceRun] = field(default_factory=dict)
    reference: Annotated[
        str | None, Key("compare.reference"),
        "run that the others are compared with; the first of several if left out",
    ] = None  # fmt: skip
    smooth: Annotated[
        bool, Key("compare.smooth"),
        "whether each run is also run on a smooth rail, for the part that the irregularity causes",
    ] = False  # fmt: skip
    rungs: Annotated[
        bool, Key("compare.rungs"), "whether each run is also compared with the one above it"
    ] = False
    softer: Annotated[
        float, Key("compare.softer"), AtLeast(0), AtMost(0.5),
        "part by which k_r of each linear run is also lowered, for what its error owes to k_r",
    ] = 0.0  # fmt: skip

    def __post_init__(self) -> None:
        """Refuse what is impossible in combination, as in a file; cells fit the supports."""
        super().__post_init__()
        runs = self.runs if isinstance(self.runs, dict) else {}
        parts: dict[str, tuple[Table | type, Any]] = {"runs": (dict, self.runs)}
        parts |= {key: (SECTIONS[key], getattr(self, key)) for key in SECTIONS}
        parts |= {f"runs.{name}": (SOLVERS, run) for name, run in runs.items()}
        raise_if(wrong_types(parts) + wrong_runs(runs))
        if not self.solid.given("cell_length"):
            object.__setattr__(self, "solid", self.solid.fitting(self.track))
        fitted = fitted_journey(self.journey, self.irregularity, self.track, self.vehicle)
        object.__setattr__(self, "journey", fitted)
        raise_if(combined(vars(self), self.runs) + wrong_reference(self.reference, self.runs))

    @property
    def needs_solid(self) -> bool:
        """Whether any run is on the meshed rail."""
        return any(run.needs_solid for run in self.runs.values())

    def presses(self, run: str) -> bool:
        """Whether a point run needs the press of the meshed bodies."""
        table = self.runs[run]
        pressed = isinstance(table, PointRun) and table.presses
        return pressed and self.track.rail.profile_name is not None

    def meshes_rail(self, run: str) -> bool:
        """Whether a run needs the meshed rail, as all do that need a meshed wheel."""
        table = self.runs[run]
        bay = isinstance(table, PointRun) and table.bay_compliance
        return table.needs_solid or self.presses(run) or bay

    def meshes_wheel(self, run: str) -> bool:
        """Whether a run needs the elastic wheel."""
        pressed = isinstance(self.runs[run], SurfaceRun) or self.presses(run)
        return pressed and self.wheel(run) != "rigid"

    def needs_wheel_modes(self, run: str) -> bool:
        """Whether a run needs the wheel's elastic modes."""
        return self.wheel(run) == "modal"

    def wheel(self, run: str) -> str:
        """Model of the meshed wheel in a run: its own or the study's."""
        table, given = self.runs[run], self.solid.wheel
        if isinstance(table, PointRun) and given == "modal":
            given = "quasi-static"  # the modes are a choice of the run's
        return table.wheel or given

    @property
    def has_wheel_modes(self) -> bool:
        """Whether any run is with the wheel's elastic modes."""
        return any(self.needs_wheel_modes(run) for run in self.runs)

    def time_step(self, run: str) -> float:
        """Time step of a run in s: its own or the journey's."""
        return self.runs[run].step(self.journey.time_step)

    def config(self) -> dict[str, Any]:
        """All values as nested plain data in SI, without keys that do not apply."""
        tables: dict[str, Any] = {
            key: resolved(SECTIONS[key], getattr(self, key)) for key in self._used()
        }
        if self.runs:
            tables["runs"] = {name: self.resolved_run(name) for name in self.runs}
        if self.reference:
            chosen = {"smooth": self.smooth, "rungs": self.rungs, "softer": self.softer}
            tables["compare"] = {"reference": self.reference, **chosen}
        return tables

    def resolved_run(self, name: str) -> dict[str, Any]:
        """Values of a run, with those that are the study's."""
        run = self.runs[name]
        meshed = isinstance(run, SurfaceRun) or self.presses(name)
        own = {"wheel": self.wheel(name)} if meshed else {}
        return resolved(SOLVERS, run) | {"time_step": self.time_step(name)} | own

    def units(self) -> dict[str, str]:
        """Dotted key of `config` -> SI unit, for keys that have one."""
        config = self.config()
        tables: list[tuple[str, Table, Any]] = [(k, SECTIONS[k], config[k]) for k in self._used()]
        tables += [(f"runs.{n}", SOLVERS, run) for n, run in config.get("runs", {}).items()]
        return {
            f"{path}.{key}": unit
            for path, table, values in tables
            for key, unit in units(table, values).items()
        }

    def _used(self) -> list[str]:
        if not self.runs:
            return ["irregularity", "track"]
        meshed = any(self.meshes_rail(run) for run in self.runs)
        placed = meshed and not self.solid.half
        used = {"solid": meshed, "wheelset": placed, "scan": placed and self.scan.used}
        used["measured"] = self.measured.used
        used["roughness"] = bool(self.roughness.file)
        return [key for key in SECTIONS if used.get(key, True)]


def fitted_journey(
    journey: Journey, irregularity: Irregularity, track: Track, vehicle: VehicleTable
) -> Journey:
    """The journey, over a sinusoid or a bridge with what was left out fitted to it."""
    if track.structure is not None:
        journey = journey_on(track, vehicle_on(track, vehicle), journey)
    if irregularity.spectrum != "sinusoid":
        return journey
    return journey.fitting(irregularity.wavelength, spacing(track))


def wrong_types(tables: dict[str, tuple[Table | type, Any]]) -> list[str]:
    """Complaints about tables that are not what the study is made of."""
    problems = []
    for key, (table, value) in tables.items():
        classes = tuple(table.classes.values()) if isinstance(table, Variants) else (table,)
        if not isinstance(value, classes):
            problems.append(wrong_type(key, value, classes))
    return problems


def wrong_runs(names: Iterable[str]) -> list[str]:
    """Complaints about names that no run can have."""
    problems, taken = list[str](), dict[str, str]()
    for name in names:
        if not isinstance(name, str) or not _RUN_NAME.fullmatch(name):
            problems.append(
                f"runs.{name}: a run's name is letters, digits and _, a letter first, at most "
                f"{LONGEST_NAME} of them"
            )
        elif is_reserved(name):
            problems.append(f"runs.{name}: no file may have this name on Windows; choose another")
        elif name.lower() in taken:
            problems.append(
                f"runs.{name}: differs from the run {taken[name.lower()]} only in capitals, and "
                "some disks do not tell such files apart; choose another name"
            )
        elif name in (IRREGULARITY, MEASURED, NORMS):
            problems.append(
                f"runs.{name}: a run cannot be called '{name}', which names its own group"
            )
        if isinstance(name, str):
            taken.setdefault(name.lower(), name)
    return problems


def wrong_reference(reference: Any, runs: Collection[str]) -> list[str]:
    """Complaint about a reference that is no run."""
    if reference is None or (isinstance(reference, str) and reference in runs):
        return []
    allowed = f"must be a run of the study: {', '.join(runs) or 'it has none'}"
    hint = did_you_mean(str(reference), runs)
    return [complaint("compare.reference", reference, allowed + hint)]

"""A study file that has been read: its tables and runs together."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from contactstudy.study.kinds.passage.runs import PointRun, RunTable, SurfaceRun
from contactstudy.study.kinds.passage.scan import ScanTable
from contactstudy.study.kinds.passage.tables import (
    IrregularityTable,
    JourneyTable,
    SolidTable,
    TrackTable,
    VehicleTable,
)
from contactstudy.study.kinds.passage.wheelset import WheelsetTable
from contactstudy.study.section import Section

SECTIONS: dict[str, type[Section]] = {
    "irregularity": IrregularityTable,
    "track": TrackTable,
    "vehicle": VehicleTable,
    "journey": JourneyTable,
    "solid": SolidTable,
    "wheelset": WheelsetTable,
    "scan": ScanTable,
}
SOLVERS: dict[str, type[RunTable]] = {"point": PointRun, "surface": SurfaceRun}


@dataclass(frozen=True)
class Study:
    """A study file that has been read and found possible.

    Attributes
    ----------
    name : str
        Stem of the file.
    title, description : str
    companions : tuple of str
        Shipped studies (or paths) whose results stand in the same report.
    irregularity, track, vehicle, journey, solid, wheelset, scan : Section
        Tables of the file.
    runs : dict of str to PointRun or SurfaceRun
        In the order of the file; none for a study of the irregularity alone.
    reference : str or None
        Run that the others are compared with.
    """

    name: str
    title: str
    description: str = ""
    companions: tuple[str, ...] = ()
    irregularity: IrregularityTable = field(default_factory=IrregularityTable)
    track: TrackTable = field(default_factory=TrackTable)
    vehicle: VehicleTable = field(default_factory=VehicleTable)
    journey: JourneyTable = field(default_factory=lambda: JourneyTable.model_validate({}))
    solid: SolidTable = field(default_factory=SolidTable)
    wheelset: WheelsetTable = field(default_factory=WheelsetTable)
    scan: ScanTable = field(default_factory=ScanTable)
    runs: dict[str, PointRun | SurfaceRun] = field(default_factory=dict)
    reference: str | None = None

    @property
    def needs_solid(self) -> bool:
        """Whether any run is on the meshed rail."""
        return any(run.needs_solid for run in self.runs.values())

    def presses(self, run: str) -> bool:
        """Whether a run takes its contact stiffness from a press of the meshed bodies."""
        table = self.runs[run]
        pressed = isinstance(table, PointRun) and table.law == "linear" and table.k_r == "tangent"
        return pressed and self.track.rail != "given"

    def bodies(self, run: str) -> tuple[str, ...]:
        """Condensed bodies that a run needs: "rail", "wheel", "wheel modes"."""
        surface = isinstance(self.runs[run], SurfaceRun)
        rail = self.runs[run].needs_solid or self.presses(run)
        wheel = (surface or self.presses(run)) and self.wheel(run) != "rigid"
        modes = surface and self.wheel(run) == "modal"
        return ("rail",) * rail + ("wheel",) * wheel + ("wheel modes",) * modes

    def wheel(self, run: str) -> str:
        """Model of the meshed wheel in a run: its own or the study's."""
        table = self.runs[run]
        own = table.wheel if isinstance(table, SurfaceRun) else None
        return own or self.solid.wheel

    @property
    def has_wheel_modes(self) -> bool:
        """Whether any run is with the wheel's elastic modes."""
        return any("wheel modes" in self.bodies(run) for run in self.runs)

    def time_step(self, run: str) -> float:
        """Time step of a run in s: its own or the journey's."""
        own = self.runs[run].time_step
        return self.journey.time_step if own is None else own

    def config(self) -> dict[str, Any]:
        """All values as nested plain data in SI, without keys that do not apply."""
        tables: dict[str, Any] = {key: getattr(self, key).resolved() for key in self._used()}
        if self.runs:
            tables["runs"] = {
                name: run.resolved()
                | {"time_step": self.time_step(name)}
                | ({"wheel": self.wheel(name)} if isinstance(run, SurfaceRun) else {})
                for name, run in self.runs.items()
            }
        if self.reference:
            tables["compare"] = {"reference": self.reference}
        return tables

    def units(self) -> dict[str, str]:
        """Dotted key of `config` -> SI unit, for keys that have one."""
        found = {f"{t}.{k}": u for t in self._used() for k, u in getattr(self, t).units().items()}
        for name, run in self.runs.items():
            found |= {f"runs.{name}.{key}": unit for key, unit in run.units().items()}
        return found

    def _used(self) -> list[str]:
        if not self.runs:
            return ["irregularity", "track"]
        meshed = any(self.bodies(run) for run in self.runs)
        placed = meshed and self.solid.section == "whole"
        used = {"solid": meshed, "wheelset": placed, "scan": placed and self.scan.used}
        return [key for key in SECTIONS if used.get(key, True)]

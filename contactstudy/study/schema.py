"""The tables of a study file, with their defaults: the paper's case on a 36 m track.

Values are SI once read. The defaults are those of the shipped study ``point_vs_surface``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Field, StrictBool

from contactstudy.study import quantities as q


class Section(BaseModel):
    """A table of a study file: frozen, unknown keys forbidden."""

    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)

    #: key -> (deciding key, its values): the key applies only then.
    applies: ClassVar[dict[str, Condition]] = {}

    def applicable(self, key: str) -> bool:
        """Whether the key (a field's name) means anything with the other values chosen."""
        if key not in self.applies:
            return True
        decider, values = self.applies[key]
        decided = decider not in type(self).model_fields or self.applicable(decider)
        return decided and getattr(self, decider) in values

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, as plain data."""
        dumped = self.model_dump(mode="json")
        fields = type(self).model_fields
        return {f.alias or k: dumped[k] for k, f in fields.items() if self.applicable(k)}

    def units(self) -> dict[str, str]:
        """Key -> SI unit of the keys in `resolved` that have one."""
        fields = {f.alias or name: f for name, f in type(self).model_fields.items()}
        return {key: unit for key in self.resolved() if (unit := q.unit_of(fields[key]))}


# fmt: off
_GENERATED = (
    "paper", "german_low", "german_high", "fra1", "fra2", "fra3", "fra4", "fra5", "fra6", "tbt3352",
)
_CSV = (
    "x_column", "level_column", "level_unit", "origin", "wavelengths", "interpolation",
    "measured_overlay",
)
_SUPPORT_KEYS = (
    "spacing", "pad_stiffness", "pad_damping", "pad_length", "lateral_pad_stiffness",
    "lateral_pad_damping", "sleeper_mass", "layer",
)
_BALLAST_KEYS = (
    "ballast_stiffness", "ballast_damping", "lateral_ballast_stiffness", "lateral_ballast_damping",
)
_SLAB_KEYS = (
    "slab_bending_stiffness", "slab_mass_per_length", "slab_bed_stiffness", "slab_bed_damping",
)
_SUSPENSION_KEYS = (
    "bogie_mass", "car_mass", "primary_stiffness", "primary_damping", "secondary_stiffness",
    "secondary_damping",
)
# fmt: on
Condition = tuple[str, tuple[str, ...]]


class IrregularityTable(Section):
    """``[irregularity]``: the vertical level of the running surface, metres, up positive."""

    spectrum: Literal[
        "paper", "german_low", "german_high", "fra1", "fra2", "fra3", "fra4", "fra5", "fra6",
        "tbt3352", "measured", "smooth",
    ] = "paper"  # fmt: skip
    roughness: q.Roughness = 0.8e-7
    omega_1: q.WavenumberOrZero = 0.0
    omega_2: q.Wavenumber = 1.0
    seed: q.CountOrZero = 1
    terms: q.Count = 1000
    band: tuple[q.Wavenumber, q.Wavenumber] = (0.08, 20.0)
    jitter: StrictBool = False
    file: str = ""
    measured_overlay: str = ""
    x_column: str = "x"
    level_column: str = ""
    level_unit: Literal["mm", "m"] = "mm"
    origin: q.Position = 0.0
    wavelengths: tuple[q.Length, q.Length] = (2.5, 42.0)
    interpolation: Literal["cubic", "linear"] = "cubic"

    applies: ClassVar[dict[str, Condition]] = {
        "roughness": ("spectrum", ("paper",)),
        "omega_1": ("spectrum", ("paper",)),
        "omega_2": ("spectrum", ("paper",)),
        "seed": ("spectrum", _GENERATED),
        "terms": ("spectrum", _GENERATED),
        "band": ("spectrum", _GENERATED),
        "jitter": ("spectrum", _GENERATED),
        "file": ("spectrum", ("measured",)),
        "origin": ("spectrum", ("measured",)),
        "interpolation": ("spectrum", ("measured",)),
        "measured_overlay": ("spectrum", (*_GENERATED, "smooth")),
    }

    @property
    def measured_file(self) -> str:
        """The CSV file in use or to be drawn beside, "" for none."""
        return self.file if self.spectrum == "measured" else self.measured_overlay

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value; how to read a CSV is left out where none is named."""
        values = super().resolved()
        return values if self.measured_file else {k: values[k] for k in values if k not in _CSV}


class TrackTable(Section):
    """``[track]``: one rail on its supports (Zhai et al. 2004, per rail seat)."""

    length: q.Length = 36.0
    ends: Literal["clamped", "pinned", "free"] = "clamped"
    rail: Literal["60E1", "given"] = "60E1"
    youngs_modulus: q.Modulus = 210e9
    poisson_ratio: q.Ratio = 0.3
    density: q.Density = 7850.0
    bending_stiffness: q.BendingStiffness = 6.4155e6
    mass_per_length: q.MassPerLength = 60.367
    area: q.Area = 76.70e-4
    crown_radius: q.Length = 0.3
    shear_coefficient: q.Coefficient = 0.4
    support: Literal["discrete", "winkler", "none"] = "discrete"
    spacing: q.Length = 0.6
    pad_stiffness: q.Stiffness = 65e6
    pad_damping: q.Damping = 75e3
    pad_length: q.LengthOrZero = 0.16
    lateral_pad_stiffness: q.Stiffness = 20e6
    lateral_pad_damping: q.Damping = 50e3
    sleeper_mass: q.MassOrZero = 125.5
    layer: Literal["ballast", "slab"] = "ballast"
    ballast_stiffness: q.Stiffness = 137.75e6
    ballast_damping: q.Damping = 58.8e3
    lateral_ballast_stiffness: q.Stiffness = 50e6
    lateral_ballast_damping: q.Damping = 40e3
    slab_bending_stiffness: q.BendingStiffness = 60e6
    slab_mass_per_length: q.MassPerLength = 730.0
    slab_bed_stiffness: q.BedStiffness = 625e6
    slab_bed_damping: q.BedDamping = 83e3
    foundation_stiffness: q.BedStiffness = 30e6
    foundation_damping: q.BedDamping = 0.0

    applies: ClassVar[dict[str, Condition]] = {
        **dict.fromkeys(
            ("bending_stiffness", "mass_per_length", "area", "shear_coefficient", "crown_radius"),
            ("rail", ("given",)),
        ),
        "density": ("rail", ("60E1",)),
        **dict.fromkeys(_SUPPORT_KEYS, ("support", ("discrete",))),
        **dict.fromkeys(_BALLAST_KEYS, ("layer", ("ballast",))),
        **dict.fromkeys(_SLAB_KEYS, ("layer", ("slab",))),
        **dict.fromkeys(("foundation_stiffness", "foundation_damping"), ("support", ("winkler",))),
    }


class VehicleTable(Section):
    """``[vehicle]``: Shinkansen S300 per wheel (Wu & Yang 2003), or a bare wheel under a load."""

    type: Literal["wheel_column", "bare_wheel"] = "wheel_column"
    wheel_mass: q.Mass = 890.0
    bogie_mass: q.Mass = 760.0
    car_mass: q.Mass = 5219.0
    primary_stiffness: q.Stiffness = 0.59e6
    primary_damping: q.Damping = 19.6e3
    secondary_stiffness: q.Stiffness = 0.1325e6
    secondary_damping: q.Damping = 22.55e3
    static_load: q.Force = 67.4e3
    wheel_radius: q.Length = 0.43

    applies: ClassVar[dict[str, Condition]] = {
        **dict.fromkeys(_SUSPENSION_KEYS, ("type", ("wheel_column",))),
        "static_load": ("type", ("bare_wheel",)),
    }


class JourneyTable(Section):
    """``[journey]``: where the wheel runs, how fast, and the time step."""

    start: q.LengthOrZero = Field(6.0, alias="from")
    end: q.LengthOrZero = Field(30.0, alias="to")
    speed: q.Speed = 300.0 / 3.6
    time_step: q.Duration = 5e-5
    fade_in: q.LengthOrZero = 3.0
    stations: tuple[q.LengthOrZero, ...] = ()


class SolidTable(Section):
    """``[solid]``: the meshed rail and wheel of surface contact."""

    mesh_size: q.MeshSize = 0.002
    cell_length: q.CellLength = 0.1
    interface_modes: q.InterfaceModes = 14
    internal_modes: q.InternalModes = 6
    contact_half_length: q.Length = 0.012
    contact_half_width: q.Length = 0.008
    penalty: q.Penalty = 1e16
    wheel: Literal["elastic", "rigid"] = "elastic"
    pressure_at: tuple[q.Position, ...] = ()


class RunTable(Section):
    """Keys of every ``[runs.NAME]``."""

    time_step: q.Duration | None = None
    irregularity: Literal["study", "smooth"] = "study"
    integrator: Literal["average_acceleration", "generalised_alpha"] | None = None
    rho_inf: q.Fraction = 0.8

    applies: ClassVar[dict[str, Condition]] = {"rho_inf": ("stepper", ("generalised_alpha",))}

    @property
    def stepper(self) -> str:
        """Name of the integrator: the one given, or the one that suits the run."""
        return self.integrator or "average_acceleration"

    def resolved(self) -> dict[str, Any]:
        """Key -> SI value of all keys that apply, the integrator chosen."""
        return super().resolved() | {"integrator": self.stepper}

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return False


class PointRun(RunTable):
    """A run with ``solver = "point"``: the paper's section 3.1, or eq. (7) with ``law``.

    ``k_r`` is a number, "tangent" (of the static press of the very wheel and rail that are
    meshed, at the static load), "hertz_tangent" (of Hertz's closed form) or "rigid".
    """

    solver: Literal["point"] = "point"
    rail: Literal["euler", "timoshenko", "solid"] = "euler"
    elements_per_bay: q.Count = 4
    local_compliance: StrictBool = False
    law: Literal["linear", "hertz"] = "linear"
    k_r: q.ContactStiffness = 1e11
    direction: Literal["Z", "Y"] = "Z"

    applies: ClassVar[dict[str, Condition]] = RunTable.applies | {
        "elements_per_bay": ("rail", ("euler", "timoshenko")),
        "local_compliance": ("rail", ("euler", "timoshenko")),
        "k_r": ("law", ("linear",)),
    }

    @property
    def stepper(self) -> str:
        """As in `RunTable`; a rigid contact needs numerical damping."""
        rigid = self.law == "linear" and self.k_r == "rigid"
        return self.integrator or ("generalised_alpha" if rigid else "average_acceleration")

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return self.rail == "solid"


class SurfaceRun(RunTable):
    """A run with ``solver = "surface"``: meshed wheel on meshed rail."""

    solver: Literal["surface"] = "surface"

    @property
    def needs_solid(self) -> bool:
        """Whether the run is on the meshed rail."""
        return True


SECTIONS: dict[str, type[Section]] = {
    "irregularity": IrregularityTable,
    "track": TrackTable,
    "vehicle": VehicleTable,
    "journey": JourneyTable,
    "solid": SolidTable,
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
    irregularity, track, vehicle, journey, solid : Section
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
        """Condensed bodies that a run needs: "rail", "wheel"."""
        surface = isinstance(self.runs[run], SurfaceRun)
        rail = self.runs[run].needs_solid or self.presses(run)
        wheel = (surface or self.presses(run)) and self.solid.wheel == "elastic"
        return ("rail",) * rail + ("wheel",) * wheel

    def time_step(self, run: str) -> float:
        """Time step of a run in s: its own or the journey's."""
        own = self.runs[run].time_step
        return self.journey.time_step if own is None else own

    def config(self) -> dict[str, Any]:
        """All values as nested plain data in SI, without keys that do not apply."""
        tables: dict[str, Any] = {key: getattr(self, key).resolved() for key in self._used()}
        if self.runs:
            tables["runs"] = {
                name: run.resolved() | {"time_step": self.time_step(name)}
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
            return ["irregularity", "track", "journey"]
        meshed = any(self.bodies(run) for run in self.runs)
        return [key for key in SECTIONS if key != "solid" or meshed]

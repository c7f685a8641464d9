"""The tables of a study file but its runs, with their defaults: the paper's case on 36 m of track.

Values are SI once read. The defaults are those of the shipped study ``point_vs_surface``.
"""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from pydantic import Field, StrictBool

from contactstudy.study import quantities as q
from contactstudy.study.section import Condition, Section

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


WHOLE: dict[str, Any] = {
    "interface_modes": 20,
    "internal_modes": 8,
    "contact_half_length": 0.010,
    "contact_half_width": 0.012,
}
"""Defaults of ``[solid]`` for a whole section."""


class SolidTable(Section):
    """``[solid]``: the meshed rail and wheel of surface contact.

    ``section = "half"``: a tread even in y, centred on an upright rail. ``"whole"``: any position
    of any profile, see ``[wheelset]``; other defaults then hold, `WHOLE`.

    The modes of a modal wheel go up to ``wheel_frequency``; their damping ratio is an assumption,
    see `contactstudy.solvers.surface.WHEEL_DAMPING`. A run may have another ``wheel``.
    """

    section: Literal["half", "whole"] = "half"
    mesh_size: q.MeshSize = 0.002
    coarse_mesh_size: q.CoarseMeshSize = 0.009
    cell_length: q.CellLength = 0.1
    interface_modes: q.InterfaceModes = 14
    internal_modes: q.InternalModes = 8
    contact_half_length: q.Length = 0.012
    contact_half_width: q.Length = 0.008
    contact_points: Literal["gauss", "nodes"] = "gauss"
    penalty: q.Penalty = 1e16
    enforcement: Literal["penalty", "augmented"] = "penalty"
    penetration_tolerance: q.Penetration = 1e-9
    wheel: Literal["rigid", "quasi-static", "modal"] = "quasi-static"
    wheel_section: str = "straight_860"
    wheel_frequency: q.ModeFrequency = 5000.0
    wheel_damping: q.Fraction = 1e-3
    pressure_at: tuple[q.Position, ...] = ()
    animation_frames: q.Frames = 0
    animation_span: tuple[q.Position, ...] = ()

    applies: ClassVar[dict[str, Condition]] = {
        "penetration_tolerance": ("enforcement", ("augmented",))
    }

    @property
    def tolerance(self) -> float | None:
        """Penetration in m that an augmented Lagrangian leaves; None: the penalty alone."""
        return self.penetration_tolerance if self.enforcement == "augmented" else None

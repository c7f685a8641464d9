"""The rail as a beam sees it: material and integrals of the cross-section."""

from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Literal

from contactstudy.profiles.section import SectionProperties
from contactstudy.solids.recipe import CellRecipe
from contactstudy.validation import (
    Above,
    Key,
    Naming,
    Parameters,
    Same,
    Unit,
    Usual,
    Variants,
    positive,
)
from contactstudy.validation import quantities as q

Direction = Literal["Z", "Y"]


def solid_torsion_constant(area: float, polar: float, divisor: float = 40.0) -> float:
    """Saint-Venant's J = A^4 / (40 I_p) of a compact section [m^4], where nothing better is known.

    For the drawn rails the divisor is 41.7 to 45.3.
    """
    return area**4 / (divisor * polar)


def _section(area: float, vertical: float, lateral: float, above_foot: float, height: float,
             torsion: float | None = None) -> SectionProperties:  # fmt: skip
    """From cm^2, cm^4 and mm; the shear coefficients are the usual 0.4 of the literature."""
    if torsion is None:
        torsion = solid_torsion_constant(area, vertical + lateral, divisor=44.0)
    return SectionProperties(
        area=area * 1e-4,
        second_moment_y=vertical * 1e-8,
        second_moment_z=lateral * 1e-8,
        centroid_z=(above_foot - height) * 1e-3,
        shear_coefficient_z=0.4,
        shear_coefficient_y=0.4,
        torsion_constant=torsion * 1e-8,
    )


# as tabulated in EN 13674-1; J of 60E1 as published for UIC 60 (the drawn section has 220.9 cm^4),
# of the others computed by `section_properties` from their drawings
NOMINAL_60E1 = _section(76.70, 3038.3, 512.3, 80.9, 172.0, torsion=209.0)
NOMINAL_54E1 = _section(69.77, 2337.9, 419.2, 75.1, 159.0, torsion=189.5)
NOMINAL_49E1 = _section(62.92, 1816.0, 319.1, 73.4, 149.0, torsion=176.1)
# GB 2585 and JIS E 1101; J as drawn rails have it in the mean
NOMINAL_CHN60 = _section(77.45, 3217.0, 524.0, 81.2, 176.0)
NOMINAL_JIS60 = _section(77.50, 3090.0, 512.0, 77.8, 174.0)


@dataclass(frozen=True)
class Rail(Parameters):
    """A rail: its material and the integrals of its cross-section.

    Parameters
    ----------
    section : SectionProperties
        Integrals of the cross-section; take those of the very mesh that the solid rail uses
        when beam and solid are to share a track.
    profile_name : str, optional
        Name of the profile that the section comes from; the solid rail needs one.
    """

    section: SectionProperties = NOMINAL_60E1
    youngs_modulus: Annotated[float, Same(CellRecipe, "youngs_modulus")] = CellRecipe.youngs_modulus
    poisson_ratio: Annotated[float, Same(CellRecipe, "poisson_ratio")] = CellRecipe.poisson_ratio
    density: Annotated[float, Same(CellRecipe, "density")] = CellRecipe.density
    profile_name: str | None = "60E1"

    def problems(self, key: Naming) -> list[str]:
        """Integrals that no section has."""
        names = ("area", "second_moment_y", "second_moment_z", "shear_coefficient_z",
                 "shear_coefficient_y", "torsion_constant")  # fmt: skip
        return [p for n in names for p in positive(f"rail section {n}", getattr(self.section, n))]

    @property
    def shear_modulus(self) -> float:
        """G = E / 2(1 + nu) [N/m^2]."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def mass_per_length(self) -> float:
        """Rho A [kg/m]."""
        return self.density * self.section.area

    def bending_stiffness(self, direction: Direction = "Z") -> float:
        """EI [N m^2] for a deflection in the direction given."""
        return self.youngs_modulus * self._second_moment(direction)

    def shear_stiffness(self, direction: Direction = "Z") -> float:
        """Kappa G A [N] for a deflection in the direction given."""
        section = self.section
        kappa = section.shear_coefficient_z if direction == "Z" else section.shear_coefficient_y
        return kappa * self.shear_modulus * section.area

    @property
    def torsion_stiffness(self) -> float:
        """GJ [N m^2]."""
        return self.shear_modulus * self.section.torsion_constant

    def rotary_inertia(self, direction: Direction = "Z") -> float:
        """Rho I [kg m], mass moment of inertia per length for a deflection in that direction."""
        return self.density * self._second_moment(direction)

    def _second_moment(self, direction: Direction) -> float:
        section = self.section
        return section.second_moment_y if direction == "Z" else section.second_moment_z


@dataclass(frozen=True)
class Rail54E1(Rail):
    """Rail 54E1 (UIC 54)."""

    section: SectionProperties = NOMINAL_54E1
    profile_name: str | None = "54E1"


@dataclass(frozen=True)
class Rail49E1(Rail):
    """Rail 49E1 (S49)."""

    section: SectionProperties = NOMINAL_49E1
    profile_name: str | None = "49E1"


@dataclass(frozen=True)
class TabulatedRail(Rail):
    """A rail of which the section's integrals are published, and no drawing is at hand."""

    profile_name: str | None = field(init=False, default=None)
    crown_radius: ClassVar[float]


@dataclass(frozen=True)
class RailCHN60(TabulatedRail):
    """Chinese 60 kg/m rail, GB 2585: 77.45 cm^2, 3217 and 524 cm^4, 60.64 kg/m.

    Area, vertical second moment and mass are also those of W. M. Zhai, K. Y. Wang and J. H. Lin, J.
    Sound Vib. 270 (2004) 673.
    """

    section: SectionProperties = NOMINAL_CHN60
    density: Annotated[float, Same(CellRecipe, "density")] = 60.64 / 77.45e-4
    crown_radius: ClassVar[float] = 0.3


@dataclass(frozen=True)
class RailJIS60(TabulatedRail):
    """Japanese 60 kg/m rail of Shinkansen lines, JIS E 1101: 77.5 cm^2, 3090 and 512 cm^4."""

    section: SectionProperties = NOMINAL_JIS60
    crown_radius: ClassVar[float] = 0.6


@dataclass(frozen=True)
class GivenRail(Rail):
    """A rail, or any beam, given by its stiffness and mass; both bending planes get the same EI."""

    section: SectionProperties = field(init=False)
    density: float = field(init=False)
    profile_name: str | None = field(init=False, default=None)
    EI: Annotated[
        q.BendingStiffness,
        Usual(1e4, 1e10),
        Key("bending_stiffness"),
        "bending stiffness of the rail",
    ] = 6.4155e6
    mass: Annotated[
        q.MassPerLength, Usual(5.0, 1e5), Key("mass_per_length"), "mass of the rail per length"
    ] = 60.367
    area: Annotated[
        float, Unit("m^2"), Above(0), Usual(1e-4, 10.0), "area of the rail's section"
    ] = 76.70e-4
    crown_radius: Annotated[q.Length, Usual(0.03, 10.0), "radius of the rail's crown"] = 0.3
    shear_coefficient: Annotated[float, Above(0), "shear coefficient of the section"] = 0.4

    def __post_init__(self) -> None:
        super().__post_init__()
        second_moment = self.EI / self.youngs_modulus
        section = SectionProperties(
            area=self.area,
            second_moment_y=second_moment,
            second_moment_z=second_moment,
            centroid_z=0.0,
            shear_coefficient_z=self.shear_coefficient,
            shear_coefficient_y=self.shear_coefficient,
            torsion_constant=solid_torsion_constant(self.area, 2.0 * second_moment),
        )
        object.__setattr__(self, "section", section)
        object.__setattr__(self, "density", self.mass / self.area)

    def problems(self, key: Naming) -> list[str]:
        """Nothing more: the section is made of the values."""
        return []


RAILS = Variants(
    "rail",
    {
        "60E1": Rail,
        "54E1": Rail54E1,
        "49E1": Rail49E1,
        "CHN60": RailCHN60,
        "JIS60": RailJIS60,
        "given": GivenRail,
    },
    "profile, or given by values; CHN60, JIS60 and given rails are not meshed",
)
"""What the key ``track.rail`` chooses."""

"""The rail as a beam sees it: material and integrals of the cross-section."""

from dataclasses import dataclass
from typing import Literal

from contactstudy.profiles.section import SectionProperties
from contactstudy.validation import positive, raise_if

Direction = Literal["Z", "Y"]

# 60E1 as tabulated in EN 13674-1; the shear coefficients are the usual 0.4 of the literature.
NOMINAL_60E1 = SectionProperties(
    area=76.70e-4,
    second_moment_y=3038.3e-8,
    second_moment_z=512.3e-8,
    centroid_z=-0.0911,
    shear_coefficient_z=0.4,
    shear_coefficient_y=0.4,
)


@dataclass(frozen=True)
class Rail:
    """A rail: its material and the integrals of its cross-section.

    Parameters
    ----------
    section : SectionProperties
        Integrals of the cross-section; take those of the very mesh that the solid rail uses
        when beam and solid are to share a track.
    youngs_modulus : float
        E [N/m^2].
    poisson_ratio : float
    density : float
        [kg/m^3].
    profile_name : str, optional
        Name of the profile that the section comes from; the solid rail needs one.
    """

    section: SectionProperties = NOMINAL_60E1
    youngs_modulus: float = 210e9
    poisson_ratio: float = 0.3
    density: float = 7850.0
    profile_name: str | None = "60E1"

    def __post_init__(self) -> None:
        section = self.section
        problems = (
            positive("rail youngs_modulus", self.youngs_modulus, "N/m^2")
            + positive("rail density", self.density, "kg/m^3")
            + positive("rail section area", section.area, "m^2")
            + positive("rail section second_moment_y", section.second_moment_y, "m^4")
            + positive("rail section second_moment_z", section.second_moment_z, "m^4")
            + positive("rail section shear_coefficient_z", section.shear_coefficient_z)
            + positive("rail section shear_coefficient_y", section.shear_coefficient_y)
        )
        if not -1.0 < self.poisson_ratio < 0.5:
            problems.append(
                f"rail poisson_ratio = {self.poisson_ratio:g}: must lie between -1 and 0.5"
            )
        raise_if(problems)

    @classmethod
    def from_values(
        cls,
        bending_stiffness: float,
        mass_per_length: float,
        *,
        area: float = 76.70e-4,
        shear_coefficient: float = 0.4,
        youngs_modulus: float = 210e9,
        poisson_ratio: float = 0.3,
    ) -> "Rail":
        """Make a rail (or any beam) from EI [N m^2] and mass per length [kg/m].

        Both bending planes get the same EI. The area [m^2] only matters to Timoshenko's theory
        (shear stiffness and rotary inertia).
        """
        second_moment = bending_stiffness / youngs_modulus
        section = SectionProperties(
            area=area,
            second_moment_y=second_moment,
            second_moment_z=second_moment,
            centroid_z=0.0,
            shear_coefficient_z=shear_coefficient,
            shear_coefficient_y=shear_coefficient,
        )
        return cls(
            section=section,
            youngs_modulus=youngs_modulus,
            poisson_ratio=poisson_ratio,
            density=mass_per_length / area,
            profile_name=None,
        )

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

    def rotary_inertia(self, direction: Direction = "Z") -> float:
        """Rho I [kg m], mass moment of inertia per length for a deflection in that direction."""
        return self.density * self._second_moment(direction)

    def _second_moment(self, direction: Direction) -> float:
        section = self.section
        return section.second_moment_y if direction == "Z" else section.second_moment_z

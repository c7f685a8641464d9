"""What a condensed rail cell is made from."""

from dataclasses import dataclass
from typing import Annotated

from contactstudy.validation import (
    Above,
    AtLeast,
    AtMost,
    Key,
    Naming,
    Parameters,
    Unit,
    Usual,
    complaint,
)
from contactstudy.validation import quantities as q


@dataclass(frozen=True)
class CellRecipe(Parameters):
    """Mesh and reduction of one rail cell; two equal recipes give equal cells.

    The running surface is finely meshed by `contact_half_width` to both sides of `contact_centre`,
    an arc length from the crown [m], 0 if symmetric: then half a section is meshed, for motion
    symmetric about the rail's vertical plane. The material is in Pa, 1 and kg/m^3.
    """

    profile: str = "60E1"
    size: Annotated[
        float, Unit("m"), AtLeast(2e-4), AtMost(0.008), Key("mesh_size"),
        "element size at the running surfaces",
    ] = 0.002  # fmt: skip
    length: Annotated[
        float, Unit("m"), Above(0), AtMost(0.5), Key("cell_length"),
        "length of a condensed cell of rail; it divides the support spacing",
    ] = 0.1  # fmt: skip
    contact_half_width: float = 0.010
    interface_modes: Annotated[
        int, AtLeast(3), AtMost(60), "generalised modes of a plane between two cells"
    ] = 14
    internal_modes: Annotated[
        int, AtLeast(0), AtMost(40), "vibration modes of a cell between fixed planes"
    ] = 8
    coarse: Annotated[
        float, Unit("m"), AtLeast(0.002), AtMost(0.02), Key("coarse_mesh_size"),
        "largest element of the rail's section",
    ] = 0.009  # fmt: skip
    contact_centre: float = 0.0
    symmetric: bool = True
    youngs_modulus: Annotated[q.Modulus, Usual(1e9, 1e12), Key(""), "Young's modulus"] = 210e9
    poisson_ratio: Annotated[
        q.PoissonRatio, Key(""), "Poisson's ratio"
    ] = 0.3  # fmt: skip
    density: Annotated[q.Density, Usual(500.0, 3e4), Key(""), "density of the steel"] = 7850.0

    def problems(self, key: Naming) -> list[str]:
        """Sizes that do not fit each other, and fewer modes than the section has rigid motions."""
        problems = []
        if self.length < 4 * self.size:
            allowed = f"must be at least 4 elements of {key('size')}, {4 * self.size:g} m"
            problems.append(complaint(key("length"), self.length, allowed))
        if self.coarse < self.size:
            allowed = f"must be at least {key('size')}, {self.size:g} m"
            problems.append(complaint(key("coarse"), self.coarse, allowed))
        if not self.symmetric and self.interface_modes < 6:
            allowed = "must be at least 6, the rigid motions of a whole section"
            problems.append(complaint(key("interface_modes"), self.interface_modes, allowed))
        return problems

    @property
    def n_slices(self) -> int:
        """Slices of a cell: the length in elements of about the running surface's size."""
        return max(4, round(self.length / self.size))

    @property
    def thickness(self) -> float:
        """Length of a slice in m."""
        return self.length / self.n_slices

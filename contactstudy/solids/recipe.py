"""What a condensed rail cell is made from."""

from dataclasses import dataclass

from contactstudy.exceptions import InputError


@dataclass(frozen=True)
class CellRecipe:
    """Mesh and reduction of one rail cell; two equal recipes give equal cells.

    Attributes
    ----------
    profile : str
        Name of the rail profile.
    size : float
        Element size at the running surface in m (lateral, depth and along X).
    length : float
        Length of the cell in m.
    contact_half_width : float
        Lateral extent of the fine running surface on each side in m.
    interface_modes : int
        Generalised modes of an interface plane, the beam's own included.
    internal_modes : int
        Fixed-interface vibration modes of a cell.
    coarse : float
        Largest element size of the section away from the running surface in m.
    contact_centre : float
        Centre of the fine running surface, arc length from the crown in m; 0 if symmetric.
    symmetric : bool
        Half section, for motion symmetric about the rail's vertical plane.
    youngs_modulus, poisson_ratio, density : float
        Material in Pa, 1 and kg/m^3.
    """

    profile: str = "60E1"
    size: float = 0.002
    length: float = 0.1
    contact_half_width: float = 0.010
    interface_modes: int = 14
    internal_modes: int = 8
    coarse: float = 0.009
    contact_centre: float = 0.0
    symmetric: bool = True
    youngs_modulus: float = 210e9
    poisson_ratio: float = 0.3
    density: float = 7850.0

    def __post_init__(self) -> None:
        """Refuse what cannot be meshed or reduced; all problems at once."""
        problems = []
        if not 0 < self.size <= 0.008:
            problems.append(f"size = {self.size} m: must be above 0 and at most 0.008 m")
        elif not 4 * self.size <= self.length <= 0.5:
            problems.append(
                f"cell length = {self.length} m: must be at least 4 elements "
                f"({4 * self.size} m) and at most 0.5 m"
            )
        if not self.size <= self.coarse <= 0.03:
            problems.append(
                f"coarse = {self.coarse} m: must lie between the size at the running surface "
                f"({self.size} m) and 0.03 m"
            )
        least = 3 if self.symmetric else 6
        if not least <= self.interface_modes <= 60:
            problems.append(
                f"interface_modes = {self.interface_modes}: must lie between {least} "
                "(the section's rigid motions) and 60"
            )
        if not 0 <= self.internal_modes <= 40:
            problems.append(f"internal_modes = {self.internal_modes}: must lie between 0 and 40")
        if not self.density > 0:
            problems.append(f"density = {self.density} kg/m^3: must be positive")
        if problems:
            raise InputError(problems)

    @property
    def n_slices(self) -> int:
        """Slices of a cell: the length in elements of about the running surface's size."""
        return max(4, round(self.length / self.size))

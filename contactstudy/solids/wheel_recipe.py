"""What an elastic wheel is made from."""

from dataclasses import dataclass, field
from typing import Annotated

import numpy as np

from contactstudy.arrays import Array
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import OWN, Ways, wheel_curve
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.profiles.wheel_file import named_file_digest
from contactstudy.solids.mapped import Grading
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_section import WheelSection, fine_arcs, wheel_section
from contactstudy.validation import (
    Above,
    AtMost,
    File,
    Key,
    Naming,
    Parameters,
    Same,
    Unit,
    complaint,
)
from contactstudy.validation import quantities as q

COARSE, GROWTH = 0.012, 1.6
"""Largest element size of the section away from the tread in m, and ratio of neighbours."""

LARGEST_ZONE = {"contact_half_length": 0.040, "contact_half_width": 0.023}
"""Largest finely meshed tread along and across the rail, each half of it [m]."""

FAR_STEP = np.pi / 15
"""Largest angle between two planes in rad away from the contact, enough for statics."""

FAR_STEP_OF_MODES = np.pi / 60
"""Largest angle between two planes in rad for elastic modes: 24 planes a wave of five round the
wheel."""


@dataclass(frozen=True)
class WheelRecipe(Parameters):
    """What an elastic wheel is made from; two equal recipes give equal wheels.

    Attributes
    ----------
    profile : str
        Wheel profile, a name or a file; even in y where `symmetric`.
    rail_profile : str
        Gives the direction of the contact forces on a symmetric wheel: its outward normal at
        each y. On a whole wheel they act along the wheel's own normal.
    symmetric : bool
        Half section, even in y, without flange. False: the whole section.
    contact_centre : float
        Arc length on the profile, 0 at the tape circle, of the middle of the contact zone in m.
    far_step : float
        Largest angle between two planes in rad, away from the contact.
    profile_ways : tuple of str
        Where y and z of a profile's file point.
    profile_digest : str
        Of the profile's content where it is a file, its name otherwise; filled in by itself.
    """

    profile: Annotated[str, File(True), Key("")] = field(default="cylinder", repr=False)
    rail_profile: str = "60E1"
    dimensions: WheelDimensions = field(default_factory=WheelDimensions)
    size: Annotated[float, Same(CellRecipe, "size"), Key("mesh_size")] = CellRecipe.size
    contact_half_length: Annotated[q.Length, "half the finely meshed tread along the rail"] = 0.012
    contact_half_width: Annotated[q.Length, "half the finely meshed tread across the rail"] = 0.008
    youngs_modulus: Annotated[float, Same(CellRecipe, "youngs_modulus"), Key("")] = (
        CellRecipe.youngs_modulus
    )
    poisson_ratio: Annotated[float, Same(CellRecipe, "poisson_ratio"), Key("")] = (
        CellRecipe.poisson_ratio
    )
    density: Annotated[float, Same(CellRecipe, "density"), Key("")] = CellRecipe.density
    symmetric: bool = True
    contact_centre: float = 0.0
    far_step: Annotated[float, Unit("rad"), Above(0), AtMost(np.pi / 6), Key("")] = FAR_STEP
    profile_ways: Ways = OWN
    profile_digest: str = field(init=False, default="")

    def problems(self, key: Naming) -> list[str]:
        """Zones that cannot be meshed."""
        problems = []
        for name, most in LARGEST_ZONE.items():
            value = getattr(self, name)
            if not self.size <= value <= most:
                least = f"{key('size')}, {self.size:g} m"
                allowed = f"must be at least {least}, and at most {most} m"
                problems.append(complaint(key(name), value, allowed))
        if self.symmetric and self.contact_centre != 0.0:
            allowed = "must be 0 on a symmetric wheel"
            problems.append(complaint(key("contact_centre"), self.contact_centre, allowed))
        return problems

    def __post_init__(self) -> None:
        super().__post_init__()
        content = named_file_digest(self.profile)
        object.__setattr__(self, "profile_digest", content or self.profile)

    @property
    def angles(self) -> Array:
        """Angles of the planes from the bottom (0) to the top (pi) in rad.

        Equal arcs of about `size` in the contact zone, then steps that grow by half each time
        up to `far_step`.
        """
        first = self.size / self.contact_radius
        fine = first * np.arange(self._n_fine + 1)
        steps: list[float] = []
        while fine[-1] + sum(steps) < np.pi:
            steps.append(min(first * 1.5 ** (len(steps) + 1), self.far_step))
        coarse = np.cumsum(steps) * (np.pi - fine[-1]) / sum(steps)
        return np.asarray(np.concatenate([fine, fine[-1] + coarse]))

    @property
    def n_far(self) -> int:
        """Equal steps at the end of `angles`."""
        steps = np.diff(self.angles)
        return int(np.count_nonzero(np.isclose(steps, steps[-1], rtol=1e-9)))

    @property
    def curve(self) -> ProfileCurve:
        """The wheel's profile."""
        return wheel_curve(self.profile, self.profile_ways)

    @property
    def contact_radius(self) -> float:
        """Distance of the contact zone's middle from the axis in m."""
        height = self.curve.point(self.contact_centre)[1]
        return self.dimensions.radius - float(height)

    @property
    def x(self) -> Array:
        """Grid lines of the contact zone along the rail, symmetric about 0, in m."""
        right = self.contact_radius * np.sin(self.angles[: self._n_fine + 1])
        return np.concatenate([-right[:0:-1], right])

    @property
    def y(self) -> Array:
        """Grid lines of the contact zone across the rail, arc lengths on the profile [m].

        From the tape circle; those of a symmetric wheel begin at 0.
        """
        return fine_arcs(self.contact_centre, self.contact_half_width, self.size, self.symmetric)

    def section(self) -> WheelSection:
        """Mesh of the section.

        Raises
        ------
        InputError
            If tread, rim and contact zone do not fit together.
        """
        return wheel_section(
            self.dimensions,
            self.curve,
            self.contact_centre,
            self.contact_half_width,
            Grading(self.size, COARSE, GROWTH),
            self.symmetric,
        )

    @property
    def _n_fine(self) -> int:
        return max(2, round(self.contact_half_length / self.size))

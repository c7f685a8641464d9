"""What a surface contact is: a meshed wheel, its place on the rail, and how contact is enforced."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Annotated

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.augmented import AugmentedLagrangian, Enforcement, Penalty
from contactstudy.contact.moving_wheel import MovingWheel
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import ContactPoints
from contactstudy.geometry.quadrature import Quadrature
from contactstudy.geometry.search import CandidateList
from contactstudy.geometry.tread import candidate_list, mesh_problems, tread_lines, wheel_points
from contactstudy.irregularity import RollingDefect, TreadLines
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.solids.wheel_modes import WheelModes, residual_flexibility
from contactstudy.track.meshed import MeshedTrack
from contactstudy.validation import AtLeast, AtMost, Parameters, Same
from contactstudy.vehicle import Vehicle, with_wheel_modes


@dataclass(frozen=True, eq=False)
class SurfaceContact(Parameters):
    """A meshed wheel that touches a meshed rail.

    Parameters
    ----------
    geometry : Geometry, optional
        Profiles and position of a whole wheel on a whole rail section: inclination, lateral
        shift, yaw. Half sections are centred and upright.
    modes : WheelModes, optional
        Elastic modes of the wheel, which then move with their inertia; without them it is
        quasi-static (or rigid, if it has no flexibility), all its inertia in the wheel's dof.
    wheel_damping : float
        Damping ratio of the modes, an assumption: D. J. Thompson, Railway Noise and Vibration
        (2009), ch. 6, uses 1e-2, 1e-3 and 1e-4 for one, no and more waves round a wheel.
    """

    wheel: WheelFlexibility
    geometry: Geometry | None = None
    modes: WheelModes | None = field(default=None, repr=False)
    wheel_damping: Annotated[float, AtLeast(0), AtMost(1), "damping ratio of its modes"] = 1e-3
    penalty: Annotated[float, Same(Penalty, "penalty")] = Penalty.penalty
    quadrature: Annotated[
        Quadrature, "where contact is enforced: Gauss points of the wheel's facets, or nodes"
    ] = "gauss"
    tolerance: Annotated[float | None, Same(AugmentedLagrangian, "tolerance")] = None

    @cached_property
    def points(self) -> ContactPoints:
        """Contact points on the wheel's tread."""
        return wheel_points(self.wheel, self.quadrature, self.geometry)

    @cached_property
    def lines(self) -> TreadLines:
        """The lines of contact points round the wheel, on which its defects have a shape."""
        return tread_lines(self.points, self.geometry or Geometry.of(self.wheel.recipe))

    def level(self, wheel: RollingDefect, X: float) -> Array:
        """What the wheel's defect adds to r at its points (npx, npy) when it is at X, both in m."""
        return wheel.level(X + self.points.x, self.lines)

    @property
    def enforcement(self) -> Enforcement:
        """How penetration is prevented."""
        if self.tolerance is None:
            return Penalty(self.penalty)
        return AugmentedLagrangian(self.tolerance, self.penalty)

    @property
    def candidates(self) -> CandidateList:
        """Facets of the wheel that can touch the rail."""
        return candidate_list(self.wheel, self.geometry)

    def on(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle with the modes of this wheel, if it has any, last among its dofs."""
        if self.modes is None:
            return vehicle
        modes = self.modes
        return with_wheel_modes(vehicle, modes.frequencies, modes.participation, self.wheel_damping)

    def moving(self, hub: int, n_dofs: int) -> MovingWheel:
        """The wheel in a system of n_dofs whose dof `hub` it is, its modes the last dofs."""
        if self.modes is None:
            return MovingWheel(self.points, self.wheel, np.array([hub]))
        body = residual_flexibility(self.wheel, self.modes)
        dofs = np.r_[hub, n_dofs - len(self.modes.frequencies) : n_dofs]
        return MovingWheel(self.points, body, dofs, self.modes)

    def problems_on(self, track: MeshedTrack) -> list[str]:
        """What speaks against pressing this wheel on that track."""
        return mesh_problems(track, self.wheel, self.points)

    def describe(self) -> dict[str, object]:
        """Attributes of a run's dataset."""
        still = "quasi-static" if self.wheel.flexibility.any() else "rigid"
        told: dict[str, object] = {"law": "penalty", "penalty": self.penalty}
        if self.tolerance is not None:
            told |= {"law": "augmented Lagrangian", "penetration_tolerance": self.tolerance}
        told |= {"quadrature": self.quadrature, "wheel": still}
        if self.modes is not None:
            told |= {"wheel": "modal", "wheel_modes": len(self.modes.frequencies)}
        return told | {"contact_points": len(self.points.gap)}

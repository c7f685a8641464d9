"""An elastic wheel whose modes move while it touches the rail at a point."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.press_table import PressTable
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.solids.wheel_modes import WheelModes
from contactstudy.vehicle import Vehicle, with_wheel_modes


@dataclass(frozen=True, eq=False)
class PointWheel:
    """Elastic modes of a wheel as a contact at a point sees them.

    The static give of all other modes belongs to the contact law: of a law that comes from a press
    of the meshed bodies, that of these modes has to be taken out (`PressTable.without`).

    Attributes
    ----------
    shapes : ndarray (m,)
        Displacement of the contact [1/sqrt(kg)], up: the gap grows by ``shapes @ q``.
    damping : float
        Ratio of all modes, see `contactstudy.contact.surface_contact`.
    """

    modes: WheelModes
    shapes: Array
    damping: float

    @classmethod
    def of(cls, contact: SurfaceContact, table: PressTable) -> "PointWheel":
        """Of a wheel with modes, touched as in a press: the mean over an added load's shares."""
        assert contact.modes is not None
        tread = contact.points.wheel_rows.matrix(len(contact.wheel.flexibility))
        # an added force dF presses the point i with share_i dF / n_i along its normal
        shapes = (table.shares / contact.points.normal_z) @ tread @ contact.modes.shapes.T
        return cls(contact.modes, np.asarray(shapes), contact.wheel_damping)

    @property
    def give(self) -> float:
        """How much the contact moves statically by these modes [m/N]."""
        return float(self.shapes**2 @ (1.0 / self.modes.stiffness))

    def on(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle with these modes, last among its dofs."""
        return with_wheel_modes(
            vehicle, self.modes.frequencies, self.modes.participation, self.damping
        )

"""Lumped vehicles. Defaults: Shinkansen S300 (Y. S. Wu and Y. B. Yang, Eng. Struct. 25 (2003) 251).

All values are per wheel.
"""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from contactstudy.validation import Parameters, Same, Usual
from contactstudy.validation import quantities as q
from contactstudy.vehicle.model import Vehicle

GRAVITY = 9.81
"""m/s^2."""


@dataclass(frozen=True)
class WheelColumn(Parameters):
    """Wheel, bogie share and car share above each other."""

    wheel_mass: Annotated[q.Mass, Usual(10.0, 1e4), "wheel with its share of the axle"] = 890.0
    bogie_mass: Annotated[q.Mass, Usual(10.0, 1e5), "share of the bogie"] = 760.0
    car_mass: Annotated[q.Mass, Usual(10.0, 1e6), "share of the car body"] = 5219.0
    primary_stiffness: Annotated[q.Stiffness, Usual(1e3, 1e9), "wheel to bogie"] = 0.59e6
    primary_damping: Annotated[q.Damping, "wheel to bogie"] = 19.6e3
    secondary_stiffness: Annotated[q.Stiffness, Usual(1e3, 1e9), "bogie to car"] = 0.1325e6
    secondary_damping: Annotated[q.Damping, "bogie to car"] = 22.55e3
    wheel_radius: Annotated[q.Length, Usual(0.05, 1.0), "radius at the tape circle"] = 0.43

    @property
    def static_load(self) -> float:
        """Whole weight, 67.4 kN by default [N]."""
        return (self.wheel_mass + self.bogie_mass + self.car_mass) * GRAVITY

    def vehicle(self) -> Vehicle:
        """Dofs wheel, bogie, car; one wheel."""

        def chain(primary: float, secondary: float) -> np.ndarray:
            return np.array(
                [
                    [primary, -primary, 0.0],
                    [-primary, primary + secondary, -secondary],
                    [0.0, -secondary, secondary],
                ]
            )

        return Vehicle(
            mass=np.diag([self.wheel_mass, self.bogie_mass, self.car_mass]),
            damping=chain(self.primary_damping, self.secondary_damping),
            stiffness=chain(self.primary_stiffness, self.secondary_stiffness),
            wheel_dofs=np.array([0]),
            wheel_offsets=np.zeros(1),
            static_loads=np.array([self.static_load]),
            dof_names=("wheel", "bogie", "car"),
        )


@dataclass(frozen=True)
class BareWheel(Parameters):
    """One wheel under a constant load, its weight included."""

    wheel_mass: Annotated[float, Same(WheelColumn, "wheel_mass")] = WheelColumn.wheel_mass
    static_load: Annotated[q.Force, Usual(100.0, 1e6), "force on the rail at rest"] = 67.4e3
    wheel_radius: Annotated[float, Same(WheelColumn, "wheel_radius")] = WheelColumn.wheel_radius

    def vehicle(self) -> Vehicle:
        """Dof wheel."""
        return Vehicle(
            mass=np.array([[self.wheel_mass]]),
            damping=np.zeros((1, 1)),
            stiffness=np.zeros((1, 1)),
            wheel_dofs=np.array([0]),
            wheel_offsets=np.zeros(1),
            static_loads=np.array([self.static_load]),
            dof_names=("wheel",),
        )


def wheel_column(**values: float) -> Vehicle:
    """Matrices of a `WheelColumn` with the values given."""
    return WheelColumn(**values).vehicle()


def bare_wheel(mass: float, load: float) -> Vehicle:
    """Matrices of a `BareWheel` of given mass [kg] under a load [N]."""
    return BareWheel(mass, load).vehicle()

"""Vehicles: lumped ones, cars and trains by their parameters, and any linear one as matrices."""

from contactstudy.validation import Variants
from contactstudy.vehicle.axles import AxleLoads, FreightWagons, HighSpeedLoadModel
from contactstudy.vehicle.car import Car
from contactstudy.vehicle.consist import Bogie, Train
from contactstudy.vehicle.derived import train, turned, with_wheel_modes
from contactstudy.vehicle.lumped import (
    GRAVITY,
    BareWheel,
    WheelColumn,
    bare_wheel,
    wheel_column,
)
from contactstudy.vehicle.model import Vehicle

VehicleTable = (
    WheelColumn | BareWheel | Bogie | Train | AxleLoads | HighSpeedLoadModel | FreightWagons
)
"""What the table ``[vehicle]`` of a study file is read as."""

VEHICLES = Variants(
    "type",
    {
        "wheel_column": WheelColumn,
        "bare_wheel": BareWheel,
        "bogie": Bogie,
        "train": Train,
        "axle_loads": AxleLoads,
        "hslm": HighSpeedLoadModel,
        "freight_wagons": FreightWagons,
    },
    "model of the vehicle",
)

__all__ = [
    "GRAVITY",
    "VEHICLES",
    "AxleLoads",
    "BareWheel",
    "Bogie",
    "Car",
    "FreightWagons",
    "HighSpeedLoadModel",
    "Train",
    "Vehicle",
    "VehicleTable",
    "WheelColumn",
    "bare_wheel",
    "train",
    "turned",
    "wheel_column",
    "with_wheel_modes",
]

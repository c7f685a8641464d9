"""Vehicles: lumped ones by their parameters, and any linear one as matrices."""

from contactstudy.vehicle.lumped import (
    GRAVITY,
    VEHICLES,
    BareWheel,
    WheelColumn,
    bare_wheel,
    wheel_column,
)
from contactstudy.vehicle.model import Vehicle, train, with_wheel_modes

__all__ = [
    "GRAVITY",
    "VEHICLES",
    "BareWheel",
    "Vehicle",
    "WheelColumn",
    "bare_wheel",
    "train",
    "wheel_column",
    "with_wheel_modes",
]

"""A car on two bogies by its parameters, as vehicle files give them."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, Any

from contactstudy.units import UnitError, to_si
from contactstudy.validation import (
    Above,
    AtLeast,
    Naming,
    Parameters,
    Unit,
    Usual,
    Written,
    complaint,
    parameters,
)
from contactstudy.validation import quantities as q
from contactstudy.vehicle.lumped import GRAVITY

_INERTIA = (Unit("kg*m**2"), Above(0))
_STIFFNESS = (Unit("N/m"), Above(0))
_HEIGHT = (Unit("m"), AtLeast(0))
_LENGTH = (Unit("m"), Above(0))
_WHEELSET = "of a wheelset, both sides together"
_BOGIE = "of a bogie, both sides together"


def weight(value: Any, unit: str) -> Any:
    """A force given as the mass that it carries: "13.7 t" is 134.4 kN."""
    if isinstance(value, list | tuple):
        return [weight(one, unit) for one in value]
    if not isinstance(value, str):
        return value
    try:
        to_si(value, unit)
    except UnitError:
        try:
            return to_si(value, "kg") * GRAVITY
        except UnitError:
            pass
    return value


WEIGHT = Written(weight, "a mass like 13.7 t, whose weight it is")
"""A force that may be given as a mass."""


@dataclass(frozen=True)
class Car(Parameters):
    """One car: body, two bogies and four wheelsets, primary and secondary suspension.

    Stiffness and damping are those of both sides together. What stands below `contact_spacing` is
    needed in three dimensions only; without `primary_longitudinal_stiffness` a wheelset has no yaw
    of its own there.
    """

    length: Annotated[q.Length, "over the couplers"]
    pivot_distance: Annotated[q.Length, "between the middles of the bogies"]
    wheelbase: Annotated[q.Length, "between the wheelsets of a bogie"]
    car_pitch_inertia: Annotated[float, *_INERTIA, Usual(1e4, 1e8), "car body"]
    bogie_mass: Annotated[q.Mass, Usual(500.0, 2e4), "one bogie without its wheelsets"]
    bogie_pitch_inertia: Annotated[float, *_INERTIA, "one bogie"]
    wheelset_mass: Annotated[q.Mass, Usual(300.0, 6e3), "one wheelset"]
    primary_vertical_stiffness: Annotated[q.Stiffness, Usual(1e5, 1e8), _WHEELSET]
    primary_vertical_damping: Annotated[q.Damping, _WHEELSET]
    secondary_vertical_stiffness: Annotated[q.Stiffness, Usual(1e5, 1e9), _BOGIE]
    secondary_vertical_damping: Annotated[q.Damping, _BOGIE]
    car_mass: Annotated[
        float | None,
        Unit("kg"),
        Above(0),
        Usual(3e3, 2e5),
        "car body; give either this or axle_load",
    ] = None
    axle_load: Annotated[
        float | None,
        Unit("N"),
        Above(0),
        Usual(2e4, 5e5),
        WEIGHT,
        "of each wheelset; the car body has the rest",
    ] = None
    wheel_radius: Annotated[q.Length, "radius at the tape circle"] = 0.43
    pivot_offset: Annotated[
        q.Position, "of the middle between the bogies, forward of the middle of the car"
    ] = 0.0
    contact_spacing: Annotated[q.Length, "between the contacts of a wheelset"] = 1.5
    car_roll_inertia: Annotated[float | None, *_INERTIA, "car body"] = None
    car_yaw_inertia: Annotated[float | None, *_INERTIA, "car body"] = None
    bogie_roll_inertia: Annotated[float | None, *_INERTIA, "one bogie"] = None
    bogie_yaw_inertia: Annotated[float | None, *_INERTIA, "one bogie"] = None
    wheelset_roll_inertia: Annotated[float | None, *_INERTIA, "one wheelset"] = None
    wheelset_yaw_inertia: Annotated[float | None, *_INERTIA, "one wheelset"] = None
    primary_lateral_stiffness: Annotated[float | None, *_STIFFNESS, _WHEELSET] = None
    primary_lateral_damping: Annotated[q.Damping, _WHEELSET] = 0.0
    primary_longitudinal_stiffness: Annotated[float | None, *_STIFFNESS, _WHEELSET] = None
    primary_longitudinal_damping: Annotated[q.Damping, _WHEELSET] = 0.0
    secondary_lateral_stiffness: Annotated[float | None, *_STIFFNESS, _BOGIE] = None
    secondary_lateral_damping: Annotated[q.Damping, _BOGIE] = 0.0
    secondary_longitudinal_stiffness: Annotated[
        float, Unit("N/m"), AtLeast(0), f"{_BOGIE}; acts on yaw"
    ] = 0.0
    secondary_longitudinal_damping: Annotated[q.Damping, f"{_BOGIE}; acts on yaw"] = 0.0
    anti_roll_stiffness: Annotated[
        float, Unit("N*m/rad"), AtLeast(0), "anti-roll bars of a bogie, beside the springs"
    ] = 0.0
    primary_spacing: Annotated[float | None, *_LENGTH, "between the sides"] = None
    secondary_spacing: Annotated[float | None, *_LENGTH, "between the sides"] = None
    car_above_secondary: Annotated[
        float | None, *_HEIGHT, "centre of mass above the secondary suspension"
    ] = None
    secondary_above_bogie: Annotated[
        float | None, *_HEIGHT, "secondary suspension above the bogie's centre of mass"
    ] = None
    bogie_above_axle: Annotated[
        float | None, *_HEIGHT, "bogie's centre of mass above the axles"
    ] = None

    def problems(self, key: Naming) -> Iterable[str]:
        """Wheels that overlap or stick out, a body without mass, both mass and axle load."""
        front = 0.5 * self.length - self.pivot_offset - 0.5 * (self.pivot_distance + self.wheelbase)
        rear = front + 2.0 * self.pivot_offset
        if self.wheelbase >= self.pivot_distance:
            allowed = f"must be below {key('pivot_distance')}, {self.pivot_distance:g} m"
            yield complaint(key("wheelbase"), self.wheelbase, allowed)
        elif min(front, rear) < 0.0:
            allowed = f"the wheelsets stick out of the car by {-min(front, rear):.4g} m"
            yield complaint(key("length"), self.length, allowed)
        if (self.car_mass is None) == (self.axle_load is None):
            yield f"{key('car_mass')}: give either this or {key('axle_load')}"
        elif self.axle_load is not None and self.body_mass <= 0.0:
            least = (0.5 * self.bogie_mass + self.wheelset_mass) * GRAVITY
            allowed = f"must be above {least:.6g} N, the weight of bogies and wheelsets"
            yield complaint(key("axle_load"), self.axle_load, allowed)

    @property
    def body_mass(self) -> float:
        """Of the car body, as given or what the axle load leaves for it [kg]."""
        if self.axle_load is None:
            return self.car_mass or 0.0
        carried = 4.0 * self.axle_load / GRAVITY
        return carried - 2.0 * self.bogie_mass - 4.0 * self.wheelset_mass

    @property
    def static_axle_load(self) -> float:
        """Weight on a wheelset [N]."""
        whole = self.body_mass + 2.0 * self.bogie_mass + 4.0 * self.wheelset_mass
        return 0.25 * whole * GRAVITY

    @property
    def missing(self) -> list[str]:
        """Keys that a model in three dimensions needs and that are not given."""
        optional = {"car_mass", "axle_load", "primary_longitudinal_stiffness"}
        if self.primary_longitudinal_stiffness is None:
            optional.add("wheelset_yaw_inertia")
        return [
            p.key
            for p in parameters(type(self))
            if p.name not in optional and getattr(self, p.name) is None
        ]

"""Quantities with their unit and usual limits, to be annotated further with what they mean."""

from typing import Annotated

from contactstudy.validation.metadata import Above, AtLeast, AtMost, Unit

Length = Annotated[float, Unit("m"), Above(0)]
LengthOrZero = Annotated[float, Unit("m"), AtLeast(0)]
Position = Annotated[float, Unit("m")]
SMALL_ANGLE = (Unit("rad"), AtLeast(-0.2), AtMost(0.2))
SmallAngle = Annotated[float, *SMALL_ANGLE]
Speed = Annotated[float, Unit("m/s"), Above(0)]
Duration = Annotated[float, Unit("s"), Above(0)]
Mass = Annotated[float, Unit("kg"), Above(0)]
MassOrZero = Annotated[float, Unit("kg"), AtLeast(0)]
MassPerLength = Annotated[float, Unit("kg/m"), Above(0)]
Density = Annotated[float, Unit("kg/m^3"), Above(0)]
Force = Annotated[float, Unit("N"), Above(0)]
Stiffness = Annotated[float, Unit("N/m"), Above(0)]
Damping = Annotated[float, Unit("N*s/m"), AtLeast(0)]
BedStiffness = Annotated[float, Unit("N/m^2"), Above(0)]
BedDamping = Annotated[float, Unit("N*s/m^2"), AtLeast(0)]
BendingStiffness = Annotated[float, Unit("N*m^2"), Above(0)]
Modulus = Annotated[float, Unit("Pa"), Above(0)]
PoissonRatio = Annotated[float, AtLeast(0), AtMost(0.49)]
Wavenumber = Annotated[float, Unit("rad/m"), Above(0)]
Count = Annotated[int, AtLeast(1)]
CountOrZero = Annotated[int, AtLeast(0)]
Fraction = Annotated[float, AtLeast(0), AtMost(1)]

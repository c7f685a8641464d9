"""Types of the keys of a study file: each reads text with a unit and knows its limits."""

from __future__ import annotations

import math
import re
from typing import Annotated, Any

from pydantic import BeforeValidator
from pydantic.fields import FieldInfo

from contactstudy.units import Limits, UnitError, one_of_or

Length = Annotated[float, BeforeValidator(Limits("m", above=0.0))]
LengthOrZero = Annotated[float, BeforeValidator(Limits("m", at_least=0.0))]
Position = Annotated[float, BeforeValidator(Limits("m"))]
Speed = Annotated[float, BeforeValidator(Limits("m/s", above=0.0))]
Duration = Annotated[float, BeforeValidator(Limits("s", above=0.0))]
Wavenumber = Annotated[float, BeforeValidator(Limits("rad/m", above=0.0))]
WavenumberOrZero = Annotated[float, BeforeValidator(Limits("rad/m", at_least=0.0))]
Roughness = Annotated[float, BeforeValidator(Limits("m^2*rad/m", above=0.0))]
Frequency = Annotated[float, BeforeValidator(Limits("Hz", above=0.0))]
Mass = Annotated[float, BeforeValidator(Limits("kg", above=0.0))]
MassOrZero = Annotated[float, BeforeValidator(Limits("kg", at_least=0.0))]
MassPerLength = Annotated[float, BeforeValidator(Limits("kg/m", above=0.0))]
Density = Annotated[float, BeforeValidator(Limits("kg/m^3", above=0.0))]
Force = Annotated[float, BeforeValidator(Limits("N", above=0.0))]
Stiffness = Annotated[float, BeforeValidator(Limits("N/m", above=0.0))]
Damping = Annotated[float, BeforeValidator(Limits("N*s/m", at_least=0.0))]
BedStiffness = Annotated[float, BeforeValidator(Limits("N/m^2", above=0.0))]
BedDamping = Annotated[float, BeforeValidator(Limits("N*s/m^2", at_least=0.0))]
Modulus = Annotated[float, BeforeValidator(Limits("Pa", above=0.0))]
Penalty = Annotated[float, BeforeValidator(Limits("Pa/m", above=0.0))]
BendingStiffness = Annotated[float, BeforeValidator(Limits("N*m^2", above=0.0))]
Area = Annotated[float, BeforeValidator(Limits("m^2", above=0.0))]
Ratio = Annotated[float, BeforeValidator(Limits("", at_least=0.0, at_most=0.49))]
Fraction = Annotated[float, BeforeValidator(Limits("", at_least=0.0, at_most=1.0))]
Coefficient = Annotated[float, BeforeValidator(Limits("", above=0.0))]
Count = Annotated[int, BeforeValidator(Limits("", at_least=1, whole=True))]
CountOrZero = Annotated[int, BeforeValidator(Limits("", at_least=0, whole=True))]
MeshSize = Annotated[float, BeforeValidator(Limits("m", at_least=2e-4, at_most=0.008))]
CoarseMeshSize = Annotated[float, BeforeValidator(Limits("m", at_least=0.002, at_most=0.02))]
ModeFrequency = Annotated[float, BeforeValidator(Limits("Hz", above=0.0, at_most=2e4))]
Frames = Annotated[int, BeforeValidator(Limits("", at_least=0, at_most=1000, whole=True))]
Penetration = Annotated[float, BeforeValidator(Limits("m", above=0.0, at_most=1e-5))]
Smoothing = Annotated[float, BeforeValidator(Limits("m", at_least=1e-5, at_most=0.01))]
CellLength = Annotated[float, BeforeValidator(Limits("m", above=0.0, at_most=0.5))]
InterfaceModes = Annotated[int, BeforeValidator(Limits("", at_least=3, at_most=60, whole=True))]
InternalModes = Annotated[int, BeforeValidator(Limits("", at_least=0, at_most=40, whole=True))]

LateralShift = Annotated[float, BeforeValidator(Limits("m", at_least=-0.05, at_most=0.05))]
SMALL_ANGLE = Limits("rad", at_least=-0.2, at_most=0.2)
SmallAngle = Annotated[float, BeforeValidator(SMALL_ANGLE)]
RestOrAngle = Annotated[float | str, BeforeValidator(one_of_or(("rest",), SMALL_ANGLE))]
_RATIO = re.compile(r"\s*1\s*:\s*(\d+(?:\.\d+)?)\s*")


def _inclination(value: Any) -> float:
    """Angle in rad of "1:40", of an angle with a unit, or of a bare number in rad."""
    if isinstance(value, str) and (match := _RATIO.fullmatch(value)):
        if float(match[1]) < 5:
            raise UnitError("must be 1:5 or flatter")
        return math.atan(1.0 / float(match[1]))
    try:
        return float(SMALL_ANGLE(value))
    except UnitError as error:
        raise UnitError(f"{error}, or a ratio like 1:40") from error


Inclination = Annotated[float, BeforeValidator(_inclination)]
CONTACT_STIFFNESS = Limits("N/m", above=0.0)
ContactStiffness = Annotated[
    float | str,
    BeforeValidator(one_of_or(("tangent", "hertz_tangent", "rigid"), CONTACT_STIFFNESS)),
]


def unit_of(field: FieldInfo) -> str:
    """SI unit of a field made with the types above (also inside a list), "" for none."""
    return _find_unit(field.metadata) or _find_unit([field.annotation])


def _find_unit(parts: list[Any]) -> str:
    for part in parts:
        if isinstance(part, BeforeValidator):
            limits = part.func if isinstance(part.func, Limits) else CONTACT_STIFFNESS
            return limits.unit
        inner = [*getattr(part, "__metadata__", ()), *getattr(part, "__args__", ())]
        if found := _find_unit(inner):
            return found
    return ""

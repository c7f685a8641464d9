"""Piers of a bridge, and their foundations."""

from dataclasses import dataclass
from typing import Annotated

from contactstudy.validation import Above, AtLeast, Key, Parameters, Unit
from contactstudy.validation import quantities as q

_Rocking = Annotated[float, Unit("N*m/rad"), Above(0)]
_RockingDamping = Annotated[float, Unit("N*m*s/rad"), AtLeast(0)]


@dataclass(frozen=True)
class Pier(Parameters):
    """A column under each inner support, on springs and dashpots of its foundation.

    Defaults are an assumption: a solid concrete pier of 10 m on piles.
    """

    height: Annotated[q.Length, Key("pier_height"), "height of a pier"] = 10.0
    youngs_modulus: Annotated[q.Modulus, Key("pier_youngs_modulus"), "of a pier"] = 31.5e9
    area: Annotated[float, Unit("m^2"), Above(0), Key("pier_area"), "area of a pier's section"] = (
        12.0
    )
    second_moment: Annotated[
        float,
        Unit("m^4"),
        Above(0),
        Key("pier_second_moment"),
        "of a pier, bending along the track",
    ] = 5.0
    lateral_second_moment: Annotated[
        float, Unit("m^4"), Above(0), Key("pier_lateral_second_moment"),
        "of a pier, bending across the track",
    ] = 30.0  # fmt: skip
    torsion_constant: Annotated[
        float, Unit("m^4"), Above(0), Key("pier_torsion_constant"), "of a pier"
    ] = 15.0
    density: Annotated[q.Density, Key("pier_density"), "of a pier"] = 2500.0
    cap_mass: Annotated[q.MassOrZero, "at the top of a pier"] = 50e3
    footing_mass: Annotated[q.MassOrZero, "at the foot of a pier"] = 200e3
    vertical_stiffness: Annotated[
        q.Stiffness, Key("foundation_vertical_stiffness"), "of a pier's foundation"
    ] = 5e9
    vertical_damping: Annotated[
        q.Damping, Key("foundation_vertical_damping"), "of a pier's foundation"
    ] = 10e6
    horizontal_stiffness: Annotated[
        q.Stiffness, Key("foundation_horizontal_stiffness"), "of a pier's foundation"
    ] = 2e9
    horizontal_damping: Annotated[
        q.Damping, Key("foundation_horizontal_damping"), "of a pier's foundation"
    ] = 5e6
    rocking_stiffness: Annotated[
        _Rocking, Key("foundation_rocking_stiffness"), "of a pier's foundation"
    ] = 50e9
    rocking_damping: Annotated[
        _RockingDamping, Key("foundation_rocking_damping"), "of a pier's foundation"
    ] = 100e6

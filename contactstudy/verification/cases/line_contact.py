"""Hertz's contact of cylinders with parallel axes (Johnson, Contact Mechanics, section 4.2c)."""

import math
from dataclasses import dataclass

from contactstudy.validation import positive, raise_if


@dataclass(frozen=True)
class LineContact:
    """Half width [m] and peak pressure [Pa] of cylinders with parallel axes."""

    half_width: float
    peak_pressure: float


def line_contact(load_per_length: float, modulus: float, radius: float) -> LineContact:
    """Hertz's line contact: b = 2 sqrt(P R / (pi E*)), p0 = sqrt(P E* / (pi R)).

    Parameters
    ----------
    load_per_length, modulus : float
        P [N/m], E* [N/m^2].
    radius : float
        Relative radius, 1/R = 1/R1 + 1/R2 [m].

    Raises
    ------
    InputError
        If an argument is not positive and finite.
    """
    raise_if(
        positive("load_per_length", load_per_length, "N/m")
        + positive("modulus", modulus, "Pa")
        + positive("radius", radius, "m")
    )
    return LineContact(
        half_width=2.0 * math.sqrt(load_per_length * radius / (math.pi * modulus)),
        peak_pressure=math.sqrt(load_per_length * modulus / (math.pi * radius)),
    )

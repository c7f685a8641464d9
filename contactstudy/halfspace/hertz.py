"""Hertz's closed forms of frictionless elastic contact.

K. L. Johnson, Contact Mechanics (1985), chapter 4. Two bodies whose gap is x^2/(2 R_x) +
y^2/(2 R_y) touch in an ellipse; with its larger semi-axis a, its smaller b and m = 1 - b^2/a^2

    p(x, y) = p0 sqrt(1 - x^2/a^2 - y^2/b^2),         p0 = 3 F / (2 pi a b)
    1/(2 R_a) = (p0 b / (E* a^2)) (K(m) - E(m)) / m
    1/(2 R_b) = (p0 b / (E* a^2)) (E(m)/(1-m) - K(m)) / m
    approach  = p0 b K(m) / E*

with the complete elliptic integrals K and E. Their differences are computed as Carlson's R_D,
which does not cancel for a circular patch: (K - E)/m = R_D(0, 1-m, 1)/3 and
(E/(1-m) - K)/m = R_D(0, 1, 1-m)/3.
"""

import math
from dataclasses import dataclass

import numpy as np

from contactstudy.validation import not_negative, positive, raise_if

# the axis ratio of a wheel on a rail is near 1; beyond this a contact is a line
_LARGEST_AXIS_RATIO = 1e6


@dataclass(frozen=True)
class HertzContact:
    """Solution for one load.

    Parameters
    ----------
    load : float
        F [N].
    semi_axis_x, semi_axis_y : float
        [m].
    peak_pressure : float
        p0 [Pa].
    approach : float
        Of distant points of the two bodies [m].
    stiffness : float
        k_H of F = k_H approach^(3/2) [N/m^1.5]; it does not depend on the load.
    """

    load: float
    semi_axis_x: float
    semi_axis_y: float
    peak_pressure: float
    approach: float
    stiffness: float

    @property
    def tangent_stiffness(self) -> float:
        """dF/d(approach) = 3/2 k_H approach^(1/2) [N/m]."""
        return 1.5 * self.stiffness * math.sqrt(self.approach)

    @property
    def secant_stiffness(self) -> float:
        """F/approach = k_H approach^(1/2) [N/m], the paper's eq. (7)."""
        return self.stiffness * math.sqrt(self.approach)

    @property
    def area(self) -> float:
        """Of the ellipse [m^2]."""
        return math.pi * self.semi_axis_x * self.semi_axis_y

    def pressure(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Pressure [Pa] at points of the patch [m], zero outside."""
        inside = (
            1.0 - (np.asarray(x) / self.semi_axis_x) ** 2 - (np.asarray(y) / self.semi_axis_y) ** 2
        )
        return self.peak_pressure * np.sqrt(np.maximum(inside, 0.0))


def contact_modulus(
    youngs_modulus: float = 210e9,
    poisson_ratio: float = 0.3,
    other_youngs_modulus: float | None = None,
    other_poisson_ratio: float | None = None,
) -> float:
    """E* with 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [N/m^2]; the other body is alike by default.

    Raises
    ------
    InputError
        For moduli that are not positive or Poisson ratios outside -1 to 0.5.
    """
    e2 = youngs_modulus if other_youngs_modulus is None else other_youngs_modulus
    nu2 = poisson_ratio if other_poisson_ratio is None else other_poisson_ratio
    problems = positive("youngs_modulus", youngs_modulus, "Pa") + positive(
        "other_youngs_modulus", e2, "Pa"
    )
    problems += [
        f"poisson_ratio = {nu:g}: must lie between -1 and 0.5"
        for nu in (poisson_ratio, nu2)
        if not -1.0 < nu <= 0.5
    ]
    raise_if(problems)
    return 1.0 / ((1.0 - poisson_ratio**2) / youngs_modulus + (1.0 - nu2**2) / e2)


def hertz_contact(load: float, modulus: float, radius_x: float, radius_y: float) -> HertzContact:
    """Elliptic contact of two smooth bodies under a load [N], which may be 0.

    Parameters
    ----------
    modulus : float
        E* [N/m^2], see `contact_modulus`.
    radius_x, radius_y : float
        Relative radii of curvature along x and along y, 1/R = 1/R1 + 1/R2 [m]. For a
        cylindrical wheel of 0.43 m on a crown of 0.30 m: 0.43 along the rail, 0.30 across.

    Raises
    ------
    InputError
        If an argument is not positive and finite (a line contact has its own function).
    """
    from scipy.special import ellipk, elliprd

    raise_if(
        not_negative("load", load, "N")
        + positive("modulus", modulus, "Pa")
        + positive("radius_x", radius_x, "m")
        + positive("radius_y", radius_y, "m")
    )
    # the longer axis lies along the larger radius
    large, small = max(radius_x, radius_y), min(radius_x, radius_y)
    ratio = large / small

    def mismatch(log_axes: float) -> float:
        complement = math.exp(-2.0 * log_axes)  # 1 - m = (b/a)^2
        return math.log(elliprd(0.0, 1.0, complement) / elliprd(0.0, complement, 1.0) / ratio)

    # bisection to the last bit; loading scipy.optimize takes longer than a small run
    log_axes, above = 0.0, math.log(_LARGEST_AXIS_RATIO)
    while ratio > 1.0 and log_axes < (middle := 0.5 * (log_axes + above)) < above:
        log_axes, above = (middle, above) if mismatch(middle) < 0.0 else (log_axes, middle)
    complement = math.exp(-2.0 * log_axes)
    # 1/(2 R_a) with p0 = 3 F/(2 pi a b):  a^3 = F R_a R_D(0, 1-m, 1) / (pi E*)
    a = (load * large * elliprd(0.0, complement, 1.0) / (math.pi * modulus)) ** (1.0 / 3.0)
    b = a * math.sqrt(complement)
    # approach = 3 F K / (2 pi E* a), and a^3 proportional to F, so k_H is free of F
    a_unit = (large * elliprd(0.0, complement, 1.0) / (math.pi * modulus)) ** (1.0 / 3.0)
    unit_approach = 3.0 * ellipk(1.0 - complement) / (2.0 * math.pi * modulus * a_unit)
    return HertzContact(
        load=float(load),
        semi_axis_x=float(a if radius_x >= radius_y else b),
        semi_axis_y=float(b if radius_x >= radius_y else a),
        peak_pressure=float(1.5 * load / (math.pi * a * b)) if load > 0.0 else 0.0,
        approach=float(unit_approach * load ** (2.0 / 3.0)),
        stiffness=float(unit_approach**-1.5),
    )

"""What a power spectral density is, and the conventions it may be printed in.

Every spectrum is called with the angular wavenumber in rad/m and returns the *two-sided* density
in m^2/(rad/m): the variance in a band is 2 int G d omega. What its source prints (one or two
sides, rad/m or 1/m, mm^2 or m^2) is declared in ``convention`` and converted there, once.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError

Sides = Literal["one", "two"]
WavenumberUnit = Literal["rad/m", "1/m"]
Formula = Callable[[Array], Array]


@dataclass(frozen=True)
class Convention:
    """How a density is to be read.

    Parameters
    ----------
    sides
        Two-sided: the variance is the integral over both signs of the wavenumber.
    wavenumber
        Variable of the formula and of the integral.
    square
        Square of the unit of length in the numerator [m^2]: 1e-6 for mm^2, 1e-4 for cm^2.
    """

    sides: Sides = "two"
    wavenumber: WavenumberUnit = "rad/m"
    square: float = 1.0

    @property
    def unit(self) -> str:
        """Unit of the density."""
        length = {1.0: "m", 1e-4: "cm", 1e-6: "mm"}[self.square]
        return f"{length}^2/({self.wavenumber})"

    @property
    def factor(self) -> float:
        """Density in this convention times ``factor`` is the two-sided one in m^2/(rad/m)."""
        # S_f df = S_omega d omega with omega = 2 pi f, hence S_omega = S_f/(2 pi)
        per_rad = 1.0 if self.wavenumber == "rad/m" else 1.0 / (2.0 * np.pi)
        return self.square * per_rad * (1.0 if self.sides == "two" else 0.5)


TWO_SIDED = Convention()


@dataclass(frozen=True)
class Spectrum:
    """Power spectral density of an irregularity.

    Parameters
    ----------
    name
        For messages and legends.
    formula
        The source's formula: wavenumber > 0 to density, both in ``convention``.
    breaks
        Wavenumbers of ``convention`` at which the formula has a kink or a jump.
    """

    name: str
    formula: Formula
    convention: Convention
    breaks: tuple[float, ...] = ()

    def __call__(self, omega: ArrayLike) -> Array:
        """Two-sided density [m^2/(rad/m)] at angular wavenumbers omega > 0 [rad/m]."""
        return self.density(omega, TWO_SIDED)

    def read(self, sides: Sides) -> Spectrum:
        """The same formula read as one- or two-sided."""
        return replace(self, convention=replace(self.convention, sides=sides))

    def density(self, wavenumber: ArrayLike, convention: Convention) -> Array:
        """Density at ``wavenumber``, both in the wanted convention.

        Raises
        ------
        InputError
            If a wavenumber is not positive.
        """
        k = np.asarray(wavenumber, dtype=float)
        if not np.all(k > 0.0):
            raise InputError(f"spectrum {self.name}: wavenumbers must be above 0")
        turn = {"rad/m": 1.0, "1/m": 2.0 * np.pi}
        own = k * turn[convention.wavenumber] / turn[self.convention.wavenumber]
        return self.formula(own) * (self.convention.factor / convention.factor)

    def variance(self, lower: float, upper: float) -> float:
        """Variance between two angular wavenumbers [rad/m]: 2 int G d omega [m^2]."""
        from scipy.integrate import quad

        turn = 1.0 if self.convention.wavenumber == "rad/m" else 2.0 * np.pi
        kinks = [turn * k for k in self.breaks if lower < turn * k < upper]
        # integrated over ln omega, in which a power law is smooth over many decades
        edges = np.sort(np.log([*np.geomspace(lower, upper, 21), *kinks]))

        def share(s: float) -> float:
            return 2.0 * np.exp(s) * float(self(np.exp(s)))

        parts = (quad(share, a, b, epsrel=1e-10)[0] for a, b in itertools.pairwise(edges))
        return float(sum(parts))

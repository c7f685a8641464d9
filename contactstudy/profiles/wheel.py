"""Wheel treads."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.pieces import ArcPiece, LinePiece, ParametricPiece, Piece, PolynomialPath
from contactstudy.resources import resource

NAMES = ("cylinder", "cone", "S1002")

# lateral ends of the straight treads: those of S1002's tread [m]
_STRAIGHT = (-0.07, 0.06)


class WheelProfile(Protocol):
    """Tread of a wheel as a function of the lateral position.

    y is measured from the tape circle, positive to the field side (away from the flange) [m].
    The height is positive away from the rail: the local rolling radius is the nominal radius
    minus ``height(y)``.
    """

    @property
    def name(self) -> str:
        """Name of the profile."""

    def height(self, y: ArrayLike) -> Array:
        """Height of the tread above the lowest point of the tape circle [m]."""

    def slope(self, y: ArrayLike) -> Array:
        """Derivative of the height [-]."""

    def curvature(self, y: ArrayLike) -> Array:
        """Second derivative of the height [1/m]."""


class WheelTread(WheelProfile, Protocol):
    """Tread that is also known as a curve of pieces."""

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Pieces from the flange's back to the field side, z up."""


@dataclass(frozen=True)
class ConicalTread:
    """Straight tread.

    Parameters
    ----------
    name : str
        Name of the profile.
    conicity : float
        Rise per metre towards the field side [-]; 0 is a cylinder.
    """

    name: str
    conicity: float

    def height(self, y: ArrayLike) -> Array:
        """Height of the tread above the lowest point of the tape circle [m]."""
        return self.conicity * np.asarray(y, dtype=float)

    def slope(self, y: ArrayLike) -> Array:
        """Derivative of the height [-]."""
        return np.full_like(np.asarray(y, dtype=float), self.conicity)

    def curvature(self, y: ArrayLike) -> Array:
        """Second derivative of the height [1/m]."""
        return np.zeros_like(np.asarray(y, dtype=float))

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """One line, 70 mm to the flange side and 60 mm to the field side."""
        low, high = _STRAIGHT
        return (LinePiece((low, self.conicity * low), (high, self.conicity * high)),)


@dataclass(frozen=True)
class PolynomialSection:
    """Part of a drawn profile, ``z(y)`` a polynomial, z up.

    Parameters
    ----------
    begin, end : float
        Range of y [m].
    path : PolynomialPath
        The polynomial.
    """

    begin: float
    end: float
    path: PolynomialPath

    def height(self, y: Array, derivative: int) -> Array:
        """Height, slope or second derivative at y [m, 1, 1/m]."""
        return self.path.height(y, derivative)

    @property
    def piece(self) -> Piece:
        """The section by arc length."""
        return ParametricPiece(self.path, self.begin, self.end)


@dataclass(frozen=True)
class ArcSection:
    """Part of a drawn profile, an arc, z up.

    Parameters
    ----------
    begin, end : float
        Range of y [m].
    centre : tuple of float
        (y, z) [m].
    radius : float
        [m].
    lower : bool
        Lower half of the circle: the steel of a wheel lies inside, the arc is convex.
    """

    begin: float
    end: float
    centre: tuple[float, float]
    radius: float
    lower: bool

    def height(self, y: Array, derivative: int) -> Array:
        """Height, slope or second derivative at y [m, 1, 1/m]."""
        b = y - self.centre[0]
        root = np.sqrt(np.maximum(self.radius**2 - b * b, 0.0))
        sign = -1.0 if self.lower else 1.0
        if derivative == 0:
            return self.centre[1] + sign * root
        with np.errstate(divide="ignore"):
            return -sign * b / root if derivative == 1 else -sign * self.radius**2 / root**3

    @property
    def piece(self) -> Piece:
        """The section by arc length."""
        z = self.height(np.array([self.begin, self.end]), 0)
        return ArcPiece(self.centre, (self.begin, float(z[0])), (self.end, float(z[1])))


@dataclass(frozen=True)
class SectionedTread:
    """Tread drawn in sections of y.

    Parameters
    ----------
    name : str
        Name of the profile.
    sections : tuple of PolynomialSection or ArcSection
        From the flange's back to the field side.
    source : str
        Where the dimensions come from.
    reference : tuple of (str, float)
        Values printed by the source, in its units, for checks only.
    """

    name: str
    sections: tuple[PolynomialSection | ArcSection, ...]
    source: str = ""
    reference: tuple[tuple[str, float], ...] = ()

    def height(self, y: ArrayLike) -> Array:
        """Height of the tread above the lowest point of the tape circle [m]."""
        return self._evaluate(y, 0)

    def slope(self, y: ArrayLike) -> Array:
        """Derivative of the height [-]; infinite where the flange's back begins."""
        return self._evaluate(y, 1)

    def curvature(self, y: ArrayLike) -> Array:
        """Second derivative of the height [1/m]."""
        return self._evaluate(y, 2)

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Pieces from the flange's back to the field side, z up."""
        return tuple(section.piece for section in self.sections)

    def _evaluate(self, y: ArrayLike, derivative: int) -> Array:
        b = np.asarray(y, dtype=float)
        low, high = self.sections[0].begin, self.sections[-1].end
        if not np.all((b >= low) & (b <= high)):
            raise InputError(
                f"wheel profile {self.name}: y = {b.min():.6g} to {b.max():.6g} m reaches beyond "
                f"the profile, which goes from {low:.6g} m (flange) to {high:.6g} m (field side)"
            )
        starts = np.array([section.begin for section in self.sections])
        which = np.clip(np.searchsorted(starts, b, side="right") - 1, 0, len(starts) - 1)
        value = np.empty(b.shape)
        for k in np.unique(which):
            here = which == k
            value[here] = self.sections[k].height(b[here], derivative)
        return value


def _section(data: Mapping[str, Any]) -> PolynomialSection | ArcSection:
    """Section of the file: mm, z down; here m, z up."""
    begin, end = float(data["from"]) * 1e-3, float(data["to"]) * 1e-3
    if "coefficients" in data:
        coefficients = tuple(-float(c) for c in data["coefficients"])
        return PolynomialSection(begin, end, PolynomialPath(coefficients))
    y, z = (float(v) * 1e-3 for v in data["centre"])
    return ArcSection(begin, end, (y, -z), float(data["radius"]) * 1e-3, data["sign"] > 0)


@lru_cache(maxsize=8)
def _drawn(name: str) -> SectionedTread:
    with resource("meshes", "profiles", f"{name}.toml").open("rb") as file:
        data = tomllib.load(file)
    return SectionedTread(
        data["name"],
        tuple(_section(section) for section in data["section"]),
        data["source"],
        tuple((key, float(value)) for key, value in data["reference"].items()),
    )


def wheel_profile(name: str = "cylinder") -> WheelTread:
    """Wheel profile by name: ``"cylinder"``, ``"cone"`` with its 1:20, or ``"S1002"``.

    Raises
    ------
    InputError
        If there is no such profile.
    """
    if name == "cylinder":
        return ConicalTread("cylinder", 0.0)
    if name == "cone":
        return ConicalTread("cone", 1.0 / 20.0)
    if name in NAMES:
        return _drawn(name)
    raise InputError(f"wheel profile '{name}' is unknown; allowed: {', '.join(NAMES)}")

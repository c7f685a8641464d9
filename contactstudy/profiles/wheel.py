"""Wheel treads."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contactstudy.exceptions import InputError

NAMES = ("cylinder", "cone")


class WheelProfile(Protocol):
    """Tread of a wheel as a function of the lateral position.

    y is measured from the tape circle, positive to the field side (away from the flange) [m].
    The height is positive away from the rail: the local rolling radius is the nominal radius
    minus ``height(y)``.
    """

    @property
    def name(self) -> str:
        """Name of the profile."""

    def height(self, y: ArrayLike) -> NDArray[np.float64]:
        """Height of the tread above the lowest point of the tape circle [m]."""

    def slope(self, y: ArrayLike) -> NDArray[np.float64]:
        """Derivative of the height [-]."""

    def curvature(self, y: ArrayLike) -> NDArray[np.float64]:
        """Second derivative of the height [1/m]."""


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

    def height(self, y: ArrayLike) -> NDArray[np.float64]:
        """Height of the tread above the lowest point of the tape circle [m]."""
        return self.conicity * np.asarray(y, dtype=float)

    def slope(self, y: ArrayLike) -> NDArray[np.float64]:
        """Derivative of the height [-]."""
        return np.full_like(np.asarray(y, dtype=float), self.conicity)

    def curvature(self, y: ArrayLike) -> NDArray[np.float64]:
        """Second derivative of the height [1/m]."""
        return np.zeros_like(np.asarray(y, dtype=float))


def wheel_profile(name: str = "cylinder") -> WheelProfile:
    """Wheel profile by name: ``"cylinder"``, or ``"cone"`` with its 1:20.

    Raises
    ------
    InputError
        If there is no such profile.
    """
    if name == "cylinder":
        return ConicalTread("cylinder", 0.0)
    if name == "cone":
        return ConicalTread("cone", 1.0 / 20.0)
    raise InputError(f"wheel profile '{name}' is unknown; allowed: {', '.join(NAMES)}")

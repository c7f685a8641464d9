"""Wheel treads."""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.profiles.pieces import ArcPiece, LinePiece, ParametricPiece, Piece, PolynomialPath
from contactstudy.resources import resource

NAMES = ("cylinder", "cone", "S1002")

# lateral ends of the straight treads: those of S1002's tread [m]
_STRAIGHT = (-0.07, 0.06)


@dataclass(frozen=True)
class WheelProfile:
    """Tread and flange of a wheel as drawn.

    y is measured from the tape circle, positive to the field side (away from the flange); z is
    positive away from the rail: the local rolling radius is the nominal one minus z.

    Parameters
    ----------
    name : str
        Name of the profile.
    pieces : tuple of Piece
        From the flange's back to the field side [m].
    source : str
        Where the dimensions come from.
    reference : tuple of (str, float)
        Values printed by the source, in its units, for checks only.
    """

    name: str
    pieces: tuple[Piece, ...]
    source: str = ""
    reference: tuple[tuple[str, float], ...] = ()


def _straight(name: str, conicity: float) -> WheelProfile:
    """Straight tread that rises to the field side by the conicity [-]."""
    start, end = ((y, conicity * y) for y in _STRAIGHT)
    return WheelProfile(name, (LinePiece(start, end),))


def _piece(section: Mapping[str, Any]) -> Piece:
    """Section of the file: mm, z down; here m, z up."""
    begin, end = float(section["from"]) * 1e-3, float(section["to"]) * 1e-3
    if "coefficients" in section:
        path = PolynomialPath(tuple(-float(c) for c in section["coefficients"]))
        return ParametricPiece(path, begin, end)
    (y, z), radius = section["centre"], float(section["radius"]) * 1e-3
    centre = float(y) * 1e-3, -float(z) * 1e-3

    def on_circle(y: float) -> tuple[float, float]:
        # the lower half where the arc is convex: steel lies inside the circle, above the rail
        square = max(radius**2 - (y - centre[0]) ** 2, 0.0)
        return y, centre[1] - float(section["sign"]) * math.sqrt(square)

    return ArcPiece(centre, on_circle(begin), on_circle(end))


@lru_cache(maxsize=8)
def _drawn(name: str) -> WheelProfile:
    with resource("meshes", "profiles", f"{name}.toml").open("rb") as file:
        data = tomllib.load(file)
    return WheelProfile(
        data["name"],
        tuple(_piece(section) for section in data["section"]),
        data["source"],
        tuple((key, float(value)) for key, value in data["reference"].items()),
    )


def wheel_profile(name: str = "cylinder") -> WheelProfile:
    """Wheel profile by name: ``"cylinder"``, ``"cone"`` with its 1:20, or ``"S1002"``.

    Raises
    ------
    InputError
        If there is no such profile.
    """
    if name == "cylinder":
        return _straight("cylinder", 0.0)
    if name == "cone":
        return _straight("cone", 1.0 / 20.0)
    if name in NAMES:
        return _drawn(name)
    raise InputError(f"wheel profile '{name}' is unknown; allowed: {', '.join(NAMES)}")

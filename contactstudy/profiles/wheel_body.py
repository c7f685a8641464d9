"""Rim, web and hub of a wheel: its cross-section but for the tread."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.validation import raise_if


@dataclass(frozen=True)
class WheelDimensions:
    """Dimensions of a wheel; the defaults are those of ``meshes/wheels/straight_860.toml``.

    y from the tape circle, positive to the field side.

    Attributes
    ----------
    radius : float
        Of the tape circle in m.
    rim_inside, rim_outside : float
        y of the faces of the rim in m; inside is the back of the flange.
    rim_thickness : float
        In m; the rim reaches from ``radius - rim_thickness`` to the tread.
    web_station : tuple of float
        Places along the web from 0 (hub) to 1 (rim), increasing.
    web_offset, web_thickness : tuple of float
        Middle line's y and the thickness there in m, linear between.
    hub_inside, hub_outside : float
        y of the faces of the hub in m.
    hub_radius, bore_radius : float
        In m.
    """

    radius: float = 0.430
    rim_inside: float = -0.070
    rim_outside: float = 0.065
    rim_thickness: float = 0.060
    web_station: tuple[float, ...] = (0.0, 1.0)
    web_offset: tuple[float, ...] = (0.0, 0.0)
    web_thickness: tuple[float, ...] = (0.025, 0.025)
    hub_inside: float = -0.090
    hub_outside: float = 0.090
    hub_radius: float = 0.130
    bore_radius: float = 0.095

    def __post_init__(self) -> None:
        """Refuse dimensions that make no wheel; all problems at once."""
        raise_if(_problems(self))

    @property
    def inner_radius(self) -> float:
        """Radius at which the rim ends and the web begins [m]."""
        return self.radius - self.rim_thickness

    @property
    def rim_width(self) -> float:
        """Width of the rim [m]."""
        return self.rim_outside - self.rim_inside

    @property
    def hub_width(self) -> float:
        """Width of the hub [m]."""
        return self.hub_outside - self.hub_inside

    def web(self, rho: ArrayLike) -> tuple[Array, Array]:
        """Faces of the web (y inside, y outside) at distances `rho` from the axis [m]."""
        at = (np.asarray(rho, dtype=float) - self.hub_radius) / (
            self.inner_radius - self.hub_radius
        )
        middle = np.interp(at, self.web_station, self.web_offset)
        half = 0.5 * np.interp(at, self.web_station, self.web_thickness)
        return middle - half, middle + half

    def with_radius(self, radius: float) -> "WheelDimensions":
        """Same rim and hub on a web that is longer or shorter."""
        return replace(self, radius=radius)


def _problems(d: WheelDimensions) -> list[str]:
    numbers = {k: v for k, v in vars(d).items() if not isinstance(v, tuple)}
    lists = {k: v for k, v in vars(d).items() if isinstance(v, tuple)}
    infinite = [k for k, v in numbers.items() if not math.isfinite(v)]
    infinite += [k for k, v in lists.items() if not np.all(np.isfinite(v))]
    if infinite:
        return [f"wheel {name} = {vars(d)[name]}: must be finite" for name in infinite]
    problems = [
        f"wheel {name} = {numbers[name]:.6g} m: must be positive"
        for name in ("radius", "rim_thickness", "hub_radius", "bore_radius")
        if not numbers[name] > 0
    ]
    if not d.bore_radius < d.hub_radius < d.inner_radius:
        problems.append(
            f"wheel: bore_radius ({d.bore_radius:.6g} m) < hub_radius ({d.hub_radius:.6g} m) < "
            f"radius - rim_thickness ({d.inner_radius:.6g} m) is required"
        )
    for part in ("rim", "hub"):
        inside, outside = numbers[f"{part}_inside"], numbers[f"{part}_outside"]
        if not inside < 0 < outside:
            problems.append(
                f"wheel {part}: its faces at y = {inside:.6g} and {outside:.6g} m must lie on "
                "both sides of the tape circle (y = 0), the inside one first"
            )
    stations = d.web_station
    if not len(stations) == len(d.web_offset) == len(d.web_thickness) >= 2:
        problems.append(
            f"wheel web: station ({len(stations)} values), offset ({len(d.web_offset)}) and "
            f"thickness ({len(d.web_thickness)}) must be equally many, two or more"
        )
        return problems
    if stations[0] != 0 or stations[-1] != 1 or np.any(np.diff(stations) <= 0):
        problems.append(f"wheel web station = {list(stations)}: must increase from 0 to 1")
    thickness = np.array(d.web_thickness)
    if np.any(thickness <= 0):
        problems.append(f"wheel web_thickness = {list(d.web_thickness)} m: must be positive")
    low, high = np.array(d.web_offset) - 0.5 * thickness, np.array(d.web_offset) + 0.5 * thickness
    for part, k in (("hub", 0), ("rim", -1)):
        inside, outside = numbers[f"{part}_inside"], numbers[f"{part}_outside"]
        if not inside < low[k] < high[k] < outside:
            problems.append(
                f"wheel web at the {part}: from y = {low[k]:.6g} to {high[k]:.6g} m, must lie "
                f"within the {part}, {inside:.6g} to {outside:.6g} m"
            )
    return problems

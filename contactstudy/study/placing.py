"""Where the wheel of a study stands on its rail, and where both are meshed finely."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from contactstudy.contact.pose import Pose
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.rail import rail_profile
from contactstudy.scans import Meeting
from contactstudy.solids.section_mesh import fine_reach
from contactstudy.solids.wheel_section_whole import fine_arcs
from contactstudy.solvers.geometry import Geometry
from contactstudy.study.schema import Study
from contactstudy.study.vehicles import vehicle
from contactstudy.study.wheelset import complaint_of_position

Array = NDArray[np.float64]

RAIL_MARGIN = 0.002
"""m, by which the rail's fine running surface reaches beyond the wheel's contact points."""

_PER_METRE = 2000.0  # zones move in steps of half a millimetre
# of rail, pads and wheel together, N/m: about that of the defaults, to find the zones only
_LATERAL_STIFFNESS = 40e6
_FELT = 0.1e-3  # m, sideways: less hardly moves the patch


@dataclass(frozen=True)
class ContactZone:
    """Finely meshed zones of a wheel and its rail.

    Attributes
    ----------
    wheel : float
        Middle of the wheel's zone, arc length on its profile in m.
    rail : tuple of float
        Ends of the rail's zone, arc lengths from its crown in m.
    """

    wheel: float
    rail: tuple[float, float]


def geometry(study: Study) -> Geometry | None:
    """Profiles and position of the wheel; None for half sections, centred and upright."""
    if study.solid.section == "half":
        return None
    drawn, pose = _position(study)
    return _geometry(*study.scan.curves(*drawn), study.vehicle.wheel_radius, pose)


def _position(study: Study) -> tuple[tuple[ProfileCurve, ProfileCurve], Pose]:
    """Drawn profiles of rail and wheel, and the position of the wheel that they give.

    Scans seldom show gauge face and flange back, so they do not change the position.
    """
    drawn = study.wheelset.curves(study.track.rail)
    return drawn, study.wheelset.pose(*drawn, study.vehicle.wheel_radius)


@lru_cache(maxsize=4)
def _geometry(rail: ProfileCurve, wheel: ProfileCurve, radius: float, pose: Pose) -> Geometry:
    # one object, so that its first touch is searched for once
    return Geometry(rail, wheel, radius, pose)


def scan_meeting(study: Study) -> Meeting | None:
    """First touch of the study's scans, whose facets must cover the zone of contact.

    Raises
    ------
    InputError
        Listing everything that is wrong with the scans.
    """
    if study.solid.section == "half" or not study.scan.used:
        return None
    drawn, pose = _position(study)
    zone = study.solid.contact_half_length, study.solid.contact_half_width
    return study.scan.touch(*drawn, study.vehicle.wheel_radius, pose, *zone)


def contact_zone(study: Study) -> ContactZone:
    """Finely meshed zones on wheel and rail.

    The wheel's lies in the middle of where the bodies would overlap at an approach of 80 um at
    70 kN and in proportion to ``F^(2/3)`` at others, somewhat more than the approach of steel
    wheels, before and after the rail has given way sideways; higher up where its feet on the rail
    would go too far down the side of the head. The rail's holds these feet.

    Raises
    ------
    InputError
        If the bodies touch beyond the place that can be meshed finely.
    """
    solid, placed = study.solid, geometry(study)
    if placed is None:
        half = solid.contact_half_width + RAIL_MARGIN
        return ContactZone(0.0, (-half, half))
    s, arc = _overlap(placed, float(vehicle(study).static_loads[0]))
    lines = fine_arcs(0.0, solid.contact_half_width, solid.mesh_size)
    reach = fine_reach(rail_profile(study.track.rail), solid.mesh_size)
    middle = _rounded(0.5 * (s.min() + s.max()))
    # from both sides towards the crown, as long as the zone still holds the overlap
    inner = -float(np.sign(arc.mean())) / _PER_METRE
    while True:
        feet = placed.feet(middle + lines)
        low, high = feet.min() - RAIL_MARGIN, feet.max() + RAIL_MARGIN
        if max(-low, high) <= reach:
            return ContactZone(middle, (_rounded(low, np.floor), _rounded(high, np.ceil)))
        middle += inner
        if not middle + lines[0] <= s.min() <= s.max() <= middle + lines[-1]:
            break
    place = study.wheelset
    at = complaint_of_position("wheelset.lateral_shift", place.lateral_shift, place.yaw)
    deepest = float(np.abs(arc).max())
    raise InputError(
        f"{at}: the {place.side} wheel touches its rail down to {1e3 * deepest:.1f} mm from the "
        f"crown; with solid.contact_half_width = {1e3 * solid.contact_half_width:g} mm the finely "
        f"meshed zone would end at {1e3 * max(-low, high):.1f} mm, and must end within "
        f"{1e3 * reach:.1f} mm"
    )


@lru_cache(maxsize=8)
def _overlap(placed: Geometry, load: float) -> tuple[Array, Array]:
    """Where the bodies would overlap under a load, arc lengths on wheel and rail in m."""
    approach = 80e-6 * (load / 70e3) ** (2 / 3)
    found = [placed.overlap(approach)]
    # the rail gives way by d = F tan(angle(d)) / k, angle(d) that of the first touch
    low, high = 0.0, load * np.tan(placed.touch.angle) / _LATERAL_STIFFNESS
    if abs(high) < _FELT:
        return found[0]
    while abs(high - low) > 0.25 * _FELT:
        middle = 0.5 * (low + high)
        given = load * np.tan(placed.moved(-middle).touch.angle) / _LATERAL_STIFFNESS
        low, high = (middle, high) if abs(given) > abs(middle) else (low, middle)
    # where the touch jumps from one place to another in between, both will carry
    found += [placed.moved(-d).overlap(approach) for d in (low, high)]
    s, arc = (np.concatenate(v) for v in zip(*found, strict=True))
    return s, arc


def _rounded(arc: float, by: Callable[[float], float] = round) -> float:
    return float(by(float(arc) * _PER_METRE)) / _PER_METRE

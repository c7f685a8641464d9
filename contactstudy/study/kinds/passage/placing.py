"""Where the wheel of a study stands on its rail, and where both are meshed finely."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from contactstudy.arrays import Array
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.smooth_touch import SmoothTouch
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.wheel_file import wheel_dimensions
from contactstudy.scans import Meeting
from contactstudy.solids.rim import tread_reach
from contactstudy.solids.section_outline import fine_reach
from contactstudy.solids.wheel_section import fine_arcs
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.wheelset import complaint_of_position
from contactstudy.validation import raise_if

RAIL_MARGIN = 0.002
"""m, by which the rail's fine running surface reaches beyond the wheel's contact points."""

_PER_METRE = 2000.0  # zones move in steps of half a millimetre
# beyond, the gap's error d^2/2R at the gauge corner is a third of the approach
_FURTHEST = 1e-3
# of rail, pads and wheel together, N/m: about that of the defaults, to find the zones only
_LATERAL_STIFFNESS = 20e6
_FELT, _LITTLE = 0.1e-3, 0.5e-3  # m, sideways: less hardly moves the patch, or moves it little


@dataclass(frozen=True)
class ContactZone:
    """Finely meshed zones: the wheel's middle, the rail's ends, as arc lengths in m."""

    wheel: float
    rail: tuple[float, float]


def meshed_rail(study: Study) -> str:
    """Name of the profile that is meshed."""
    return study.track.rail.profile_name or "given"


def geometry(study: Study) -> Geometry:
    """Profiles and position of the wheel; half sections are a centred cylinder's."""
    if study.solid.half:
        rail, wheel = rail_curve(meshed_rail(study)), wheel_curve("cylinder")
        return _geometry(rail, wheel, study.vehicle.wheel_radius, Pose())
    drawn, pose = _position(study)
    return _geometry(*study.scan.curves(*drawn), study.vehicle.wheel_radius, pose)


def _position(study: Study) -> tuple[tuple[ProfileCurve, ProfileCurve], Pose]:
    """Drawn profiles of rail and wheel, and the position of the wheel that they give.

    Scans seldom show gauge face and flange back, so they do not change the position.
    """
    drawn = study.wheelset.curves(meshed_rail(study))
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
    if study.solid.half or not study.scan.used:
        return None
    drawn, pose = _position(study)
    zone = study.solid.contact_half_length, study.solid.contact_half_width
    return study.scan.touch(*drawn, study.vehicle.wheel_radius, pose, *zone)


def contact_zone(study: Study) -> ContactZone:
    """Finely meshed zones on wheel and rail.

    The wheel's lies in the middle of where the bodies would overlap at an approach of 80 um at
    70 kN and in proportion to ``F^(2/3)`` at others, somewhat more than the approach of steel
    wheels, after the rail has given way sideways, and as drawn as well where it gives way little
    (a light wheel stands as drawn); higher up where the zone would leave the wheel's profile, or
    its feet on the rail would go too far down the side of the head. The rail's zone holds these
    feet.

    Raises
    ------
    InputError
        If the bodies touch beyond the place that can be meshed finely, or so steeply that the
        rail is pushed far aside.
    """
    solid = study.solid
    if solid.half:
        half = solid.contact_half_width + RAIL_MARGIN
        return ContactZone(0.0, (-half, half))
    placed = geometry(study)
    found = _settled(placed, study.vehicle.static_load)
    lines = fine_arcs(0.0, solid.contact_half_width, solid.mesh_size)
    dimensions = wheel_dimensions(solid.wheel_section).with_radius(study.vehicle.wheel_radius)
    curve = wheel_curve(study.wheelset.wheel_profile, study.wheelset.wheel_ways)
    first, last = tread_reach(dimensions, curve, solid.mesh_size)
    middle = max(
        _rounded(0.5 * (found.s.min() + found.s.max())), _rounded(first - lines[0], np.ceil)
    )
    middle = min(middle, _rounded(last - lines[-1], np.floor))
    reach = fine_reach(rail_profile(meshed_rail(study)), solid.mesh_size)
    while True:
        feet = placed.feet(middle + lines)
        low = _rounded(feet.min() - RAIL_MARGIN, np.floor)
        high = _rounded(feet.max() + RAIL_MARGIN, np.ceil)
        inside = all(
            middle + lines[0] + solid.mesh_size < t.wheel_s < middle + lines[-1] - solid.mesh_size
            for t in found.touches
        )
        if not inside or max(-low, high) <= reach:
            break
        # from both sides towards the crown
        middle += (1.0 if -low > high else -1.0) / _PER_METRE
    place, problems = study.wheelset, []
    at = complaint_of_position("wheelset.lateral_shift", place.lateral_shift, place.yaw)
    deepest = max(abs(t.arc) for t in found.touches)
    if abs(found.sideways) > _FURTHEST:
        problems.append(
            f"{at}: the {place.side} wheel's contact is so steep that it would push its rail "
            f"{1e3 * abs(found.sideways):.2g} mm aside; allowed is {1e3 * _FURTHEST:g} mm, as gaps "
            "are linear in the displacements. Studies of positions (table [positions]) compute it"
        )
    elif not inside or first > middle + lines[0] + 1e-9:
        problems.append(
            f"{at}: the {place.side} wheel touches its rail down to {1e3 * deepest:.1f} mm from "
            f"the crown; with solid.contact_half_width = {1e3 * solid.contact_half_width:g} mm and "
            f"solid.mesh_size = {1e3 * solid.mesh_size:g} mm no finely meshed zone holds that "
            f"within {1e3 * reach:.1f} mm of the rail and {1e3 * first:.1f} to {1e3 * last:.1f} mm "
            f"of the wheel's profile"
        )
    ahead = max(abs(t.wheel_x) for t in found.touches)
    if ahead > solid.contact_half_length:
        problems.append(
            f"{at}: the {place.side} wheel touches its rail {1e3 * ahead:.1f} mm ahead of or "
            f"behind its lowest point; solid.contact_half_length = "
            f"{1e3 * solid.contact_half_length:g} mm must be larger, by the patch's semi-axis"
        )
    raise_if(problems)
    return ContactZone(middle, (low, high))


@dataclass(frozen=True)
class _Settled:
    """Where a wheel stands when the rail has given way sideways.

    Attributes
    ----------
    touches : tuple of SmoothTouch
        First touches on both sides of where it settles: both will carry if they are apart.
    sideways : float
        How far the rail has given way, to the field side, in m.
    s : ndarray (n,)
        Arc lengths on the wheel where the bodies overlap there, and as drawn where that is near,
        in m.
    """

    touches: tuple[SmoothTouch, ...]
    sideways: float
    s: Array


@lru_cache(maxsize=8)
def _settled(placed: Geometry, load: float) -> _Settled:
    approach = 80e-6 * (load / 70e3) ** (2 / 3)
    # the rail gives way by d = F tan(angle(d)) / k, angle(d) that of the first touch
    low, high = 0.0, float(load * np.tan(placed.touch.angle)) / _LATERAL_STIFFNESS
    if abs(high) < _FELT:
        return _Settled((placed.touch,), high, placed.overlap(approach)[0])
    while abs(high - low) > 0.25 * _FELT:
        middle = 0.5 * (low + high)
        given = load * np.tan(placed.moved(-middle).touch.angle) / _LATERAL_STIFFNESS
        low, high = (middle, high) if abs(given) > abs(middle) else (low, middle)
    moved = [placed.moved(-d) for d in (low, high)]
    found = [*moved, placed] if abs(high) < _LITTLE else moved
    s = np.concatenate([m.overlap(approach)[0] for m in found])
    return _Settled(tuple(m.touch for m in moved), high, s)


def _rounded(arc: float, by: Callable[[float], float] = round) -> float:
    return float(by(float(arc) * _PER_METRE)) / _PER_METRE

"""First touch of scanned bodies: by their facets, and by the smooth surfaces fitted to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.exceptions import InputError
from contactstudy.geometry.facets import in_track_axes, rail_surface, wheel_surface
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.smooth_touch import SmoothTouch, smooth_touch
from contactstudy.geometry.touch import FirstTouch, first_touch
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.scans.cover import uncovered
from contactstudy.scans.scan import Scan

if TYPE_CHECKING:
    import trimesh

_STEP = 0.5e-3  # of the facets made for a body that is not scanned [m]
_SLACK = 2.0  # of the zone along the rail, for facets made for a body that is not scanned


@dataclass(frozen=True)
class Meeting:
    """Where a wheel lowered onto a rail touches first, if either is scanned.

    Attributes
    ----------
    smooth : SmoothTouch
        Of the smooth surfaces, which the gap is taken from.
    facets : FirstTouch
        Of the facets, in track axes.
    """

    smooth: SmoothTouch
    facets: FirstTouch

    @property
    def difference(self) -> float:
        """Travel of the facets less that of the smooth surfaces [m]: noise and sagitta."""
        return self.facets.travel - self.smooth.travel


def meeting(
    rail: Scan | ProfileCurve,
    wheel: Scan | ProfileCurve,
    radius: float,
    pose: Pose,
    half_length: float,
    half_width: float,
) -> Meeting:
    """First touch of two bodies, and whether the scanned ones have facets all around it.

    A scan touches half way along it (rail) or at its lowest circle (wheel). Half the size along and
    across of the zone that must be covered by facets, and the rolling radius at the tape circle,
    are in m.

    Raises
    ------
    InputError
        If the bodies never touch, or their scans do not cover the zone of contact.
    """
    curves = [b.curve if isinstance(b, Scan) else b for b in (rail, wheel)]
    smooth = smooth_touch(PlacedWheel(curves[1], radius, pose), curves[0])
    problems = [
        uncovered(scan, x, s, half_length, half_width)
        for scan, x, s in ((rail, smooth.x, smooth.arc), (wheel, smooth.wheel_x, smooth.wheel_s))
        if isinstance(scan, Scan)
    ]
    if any(problems):
        raise InputError([problem for problem in problems if problem])
    reach = _SLACK * half_length + abs(smooth.x)
    x = np.linspace(-reach, reach, round(2.0 * reach / _STEP) + 1)[:, None]
    lower, upper = (_facets(b, radius, x) for b in (rail, wheel))
    facets = first_touch(in_track_axes(lower, pose, False), in_track_axes(upper, pose, True))
    return Meeting(smooth, facets)


def _facets(body: Scan | ProfileCurve, radius: float, x: np.ndarray) -> trimesh.Trimesh:
    """Triangulated surface of a body in its own axes."""
    if isinstance(body, Scan):
        return body.mesh
    low, high = body.s_range
    s = np.linspace(low, high, round((high - low) / _STEP) + 1)[None]
    return rail_surface(body, x, s) if body.upper else wheel_surface(body, radius, x, s)

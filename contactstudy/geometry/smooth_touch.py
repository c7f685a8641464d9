"""First touch of a smooth wheel lowered onto a smooth rail."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.geometry.pose import PlacedWheel
from contactstudy.profiles.curve import ProfileCurve

# spacing of the first look along the wheel's profile, and of the last [m]
_FIRST, _LAST = 0.1e-3, 1e-10


@dataclass(frozen=True)
class SmoothTouch:
    """Where a wheel moved straight down meets the rail.

    Attributes
    ----------
    travel : float
        Downward travel from the tape circle's lowest point level with the crown [m]; negative
        if the wheel has to be raised.
    x : float
        Place along the rail [m], from the tape circle's lowest point.
    wheel_x, wheel_s : float
        Place on the wheel: along it in its own axes, arc length on its profile [m].
    arc : float
        Place on the rail: arc length from its crown [m].
    point : tuple of float
        The same in the rail's (y, z) [m].
    angle : float
        Contact angle: of the normal with the track's vertical [rad], positive where it points
        to the flange's side (-Y).
    """

    travel: float
    x: float
    wheel_x: float
    wheel_s: float
    arc: float
    point: tuple[float, float]
    angle: float


def smooth_touch(wheel: PlacedWheel, rail: ProfileCurve, tolerance: float = 1e-15) -> SmoothTouch:
    """Lower a wheel onto a rail until their smooth surfaces touch within `tolerance` [m].

    A prismatic rail is touched where the wheel's normal has no component along it, so one curve on
    the wheel, its contact locus, holds all candidates. Its least distance g from the rail as a
    function of the travel is driven to zero by Newton's iteration, ``dg/dt = -n_z``.

    Raises
    ------
    InputError
        If they touch at the end of a profile, or beside the rail, or never.
    """
    s0, s1 = wheel.curve.s_range
    s = np.linspace(s0, s1, int((s1 - s0) / _FIRST) + 2)
    vertical = wheel.pose.vertical
    # from so high above that nothing overlaps
    samples = wheel.lowest(s)[:, 1:]
    crown = rail.point(np.linspace(*rail.s_range, 101)) @ vertical
    travel = float((samples @ vertical).min() - crown.max() - 1e-3)
    low, high = travel, np.inf
    for _ in range(60):
        best, arc, distance = _nearest(wheel, rail, s, samples, travel)
        rise = float(rail.normal(arc) @ vertical)
        if abs(distance) <= tolerance or high - low <= tolerance:
            break
        low, high = (travel, high) if distance > 0 else (low, travel)
        # where the normal is level the distance itself is a safe step
        travel += distance / rise if rise > 0.05 else distance
        if not low <= travel <= high:
            travel = 0.5 * (low + high)
    if not (rail.s_range[0] <= arc <= rail.s_range[1] and s0 < best < s1 and rise > 0.0):
        raise InputError(
            f"first touch of {wheel.curve.name} on {rail.name} at s = {best:.5g} m of the wheel "
            f"and {arc:.5g} m of the rail: lies at or beyond the end of a profile "
            f"({s0:.4g} to {s1:.4g} m, {rail.s_range[0]:.4g} to {rail.s_range[1]:.4g} m)"
        )
    if abs(distance) > 1e-12:
        raise NumericalError(
            f"first touch of {wheel.curve.name} on {rail.name}: {distance:.3e} m left at "
            f"s = {best:.5g} m of the wheel"
        )
    x = wheel.locus(np.array([best]))
    place, _ = wheel.points_and_normals(x, np.array([best]))
    n = wheel.pose.track_of_rail(rail.normal(arc))
    y, z = (float(v) for v in rail.point(arc))
    angle = float(np.arctan2(-n[0], n[1]))
    return SmoothTouch(travel, float(place[0, 0]), float(x[0]), best, arc, (y, z), angle)


def _nearest(
    wheel: PlacedWheel, rail: ProfileCurve, s: Array, samples: Array, travel: float
) -> tuple[float, float, float]:
    """Arc length on the wheel, on the rail, and distance at the locus' closest point.

    `samples` (n, 2) are the locus' points at s (n,), not lowered, in the rail's (y, z).
    """
    down = travel * wheel.pose.vertical

    def look(s: Array) -> tuple[Array, Array]:
        return rail.project(wheel.lowest(s)[:, 1:] - down)

    arc, distance = rail.project(samples - down)
    step = float(s[1] - s[0])
    # a sample lies within half a step of a minimum, whose distance can be this much less
    middle = np.clip(np.arange(len(s)), 1, len(s) - 2)
    lowest = (distance <= distance[middle - 1]) & (distance <= distance[middle + 1])
    drop = np.maximum(distance[middle - 1], distance[middle + 1]) - distance
    candidates = np.flatnonzero(lowest & (distance - drop <= distance.min()))
    best = (0.0, 0.0, np.inf)
    for k in candidates:
        centre, width = float(s[k]), step
        while width > _LAST:
            near = np.clip(centre + width * np.linspace(-1.0, 1.0, 21), s[0], s[-1])
            arc, distance = look(near)
            i = int(np.argmin(distance))
            centre, width = float(near[i]), 0.15 * width
            if distance[i] < best[2]:
                best = (centre, float(arc[i]), float(distance[i]))
    return best

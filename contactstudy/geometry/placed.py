"""Contact points of a wheel in any position on an inclined rail."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.geometry.interpolation import grid_rows
from contactstudy.geometry.points import ContactPoints
from contactstudy.geometry.pose import PlacedWheel, Pose
from contactstudy.geometry.quadrature import Quadrature, grid_facets, point_line
from contactstudy.geometry.smooth_touch import SmoothTouch, smooth_touch
from contactstudy.profiles.curve import ProfileCurve


def placed_points(
    wheel_x: Array,
    wheel_s: Array,
    radius: float,
    rail: ProfileCurve,
    wheel: ProfileCurve,
    pose: Pose,
    touch: SmoothTouch | None = None,
    quadrature: Quadrature = "gauss",
) -> ContactPoints:
    """Contact points of the wheel's tread facets over an inclined rail.

    The gap is the signed distance of the wheel's surface of revolution from the rail's running
    surface. It is 0 at the first touch of the smooth surfaces, which need not be a point of the
    grid; a downward travel d from there closes it by ``d normal_z`` to first order.

    The interpolation on the rail is a product of x and arc: its lines are the feet of the
    wheel's lines where these come nearest to the rail (`PlacedWheel.locus`), and x is counted
    in the wheel's axes. With yaw both depend on the other coordinate a little (by
    ``yaw * distance`` from the touch); the gap is exact.

    Parameters
    ----------
    wheel_x, wheel_s : ndarray (mx,), (my,)
        Grid lines of the wheel's tread nodes: position along the wheel in its own axes, and arc
        length on its profile [m].
    radius : float
        Rolling radius at the tape circle [m].
    rail : ProfileCurve
        Running surface in the rail's own axes.
    wheel : ProfileCurve
        Profile of the wheel.
    pose : Pose
        Position of the wheel.
    touch : SmoothTouch, optional
        Their first touch, if it is known already.
    quadrature : {"gauss", "nodes"}
        Gauss points of the facets, or the tread nodes with nodal areas.

    Returns
    -------
    ContactPoints
        `wheel_y` holds the lines `wheel_s`; `normal_z` is the component of the rail's normal
        along the track's vertical.

    Raises
    ------
    InputError
        If the grid is impossible, reaches beyond the wheel's profile, or the bodies do not touch.
    """
    wheel_x, wheel_s = np.asarray(wheel_x, dtype=float), np.asarray(wheel_s, dtype=float)
    s0, s1 = wheel.s_range
    problems = []
    if np.any(np.diff(wheel_x) <= 0) or np.any(np.diff(wheel_s) <= 0):
        problems.append("contact grid: lines must increase")
    if not (wheel_s[0] >= s0 - 1e-12 and wheel_s[-1] <= s1 + 1e-12):
        problems.append(
            f"contact grid: s = {wheel_s[0]:.4g} to {wheel_s[-1]:.4g} m reaches beyond the "
            f"profile {wheel.name}, {s0:.4g} to {s1:.4g} m"
        )
    if problems:
        raise InputError(problems)
    placed = PlacedWheel(wheel, radius, pose)
    touch = smooth_touch(placed, rail) if touch is None else touch
    along, across = point_line(wheel_x, quadrature), point_line(wheel_s, quadrature)
    x, s = along.at, across.at
    nx, ny = len(x), len(s)
    facing = surface_gap(placed, rail, touch.travel, np.repeat(x, ny), np.tile(s, nx))
    # on the wheel dA = dx ds / cos(a), x = r sin(a); projected along the rail's normal
    local = radius - wheel.point(s)[:, 1]
    cosine = np.sqrt(1.0 - (x[:, None] / local[None, :]) ** 2)
    area = (
        along.weight[:, None] * across.weight[None, :] / cosine * facing.alignment.reshape(nx, ny)
    )
    feet, _ = placed.surface(placed.locus(s), s)
    arc, _ = rail.project(feet[:, 1:] - touch.travel * pose.vertical)
    my = len(wheel_s)
    return ContactPoints(
        x,
        rail.point(arc)[:, 0],
        arc,
        wheel_x,
        wheel_s,
        facing.gap,
        facing.normal_z,
        area.ravel(),
        grid_facets(along, across, my),
        grid_rows(along.rows, across.rows, my),
        False,
    )


@dataclass(frozen=True, eq=False)
class Facing:
    """Points of a wheel's surface over a rail.

    Attributes
    ----------
    gap : ndarray (n,)
        Signed distance from the rail's surface [m].
    normal : ndarray (n, 2)
        The rail's outward unit normals at the feet, in track (Y, Z).
    arc : ndarray (n,)
        Feet on the rail: arc length from its crown [m].
    x : ndarray (n,)
        Places along the rail, from the tape circle's lowest point [m].
    alignment : ndarray (n,)
        ``-n_wheel . n_rail``, 1 where the surfaces are parallel.
    """

    gap: Array
    normal: Array
    arc: Array
    x: Array
    alignment: Array

    @property
    def normal_z(self) -> Array:
        """Component of the normals along the track's vertical, (n,)."""
        return self.normal[:, 1]


def surface_gap(
    wheel: PlacedWheel, rail: ProfileCurve, travel: float, x: Array, s: Array
) -> Facing:
    """Gap of points of the wheel's surface.

    Parameters
    ----------
    wheel, rail
        The bodies.
    travel : float
        Downward travel of the wheel from its tape circle level with the crown [m].
    x, s : ndarray (n,)
        Places on the wheel [m].
    """
    points, normals = wheel.surface(x, s)
    arc, gap = rail.project(points[:, 1:] - travel * wheel.pose.vertical)
    n = rail.normal(arc)
    alignment = -(normals[:, 1] * n[:, 0] + normals[:, 2] * n[:, 1])
    return Facing(gap, wheel.pose.track_of_rail(n), arc, points[:, 0], alignment)

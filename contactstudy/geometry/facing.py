"""Gap between points of a placed wheel's surface and a rail's running surface."""

from dataclasses import dataclass

from contactstudy.arrays import Array
from contactstudy.geometry.pose import PlacedWheel
from contactstudy.profiles.curve import ProfileCurve


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
    """Gap of points at places x, s (n,) [m] on a wheel's surface.

    `travel` is counted downwards from the wheel's tape circle level with the crown [m].
    """
    points, normals = wheel.points_and_normals(x, s)
    arc, gap = rail.project(points[:, 1:] - travel * wheel.pose.vertical)
    n = rail.normal(arc)
    alignment = -(normals[:, 1] * n[:, 0] + normals[:, 2] * n[:, 1])
    return Facing(gap, wheel.pose.track_of_rail(n), arc, points[:, 0], alignment)

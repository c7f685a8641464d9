"""Position of a wheel on a rail, and its surface of revolution in the rail's axes.

Axes. Track: X along the rail, Y to the field side, Z up, origin at the crown of the rail. Rail:
the track's axes turned about X by the inclination, which leans the top of the rail to -Y. Wheel:
origin at the lowest point of the tape circle, y along the axle to the field side, z up.
"""

import math
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve


@dataclass(frozen=True)
class Pose:
    """Position of a wheel relative to a rail; the height follows from the touch.

    Parameters
    ----------
    rail_inclination : float
        Angle by which the top of the rail leans towards the track's centre [rad]; 1:40 is
        ``atan(1/40)``.
    lateral : float
        Y of the lowest point of the wheel's tape circle in track axes [m].
    roll : float
        Of the wheel about X [rad]; positive lifts the field side.
    yaw : float
        Of the wheel about Z [rad]; positive turns +X towards +Y.
    """

    rail_inclination: float = 0.0
    lateral: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0

    def __post_init__(self) -> None:
        problems = [
            f"{name} = {value} {unit}: must be a number between {-limit} and {limit} {unit}"
            for name, value, limit, unit in (
                ("rail inclination", self.rail_inclination, 0.2, "rad"),
                ("lateral position of the wheel", self.lateral, 0.1, "m"),
                ("roll of the wheel", self.roll, 0.2, "rad"),
                ("yaw of the wheel", self.yaw, 0.2, "rad"),
            )
            if not abs(value) <= limit
        ]
        if problems:
            raise InputError(problems)

    @property
    def vertical(self) -> Array:
        """The track's upward unit vector in the rail's (y, z), (2,)."""
        return np.array([math.sin(self.rail_inclination), math.cos(self.rail_inclination)])

    @property
    def to_track(self) -> Array:
        """Rotation of wheel axes to track axes, (3, 3): first roll, then yaw."""
        c, s = math.cos(self.roll), math.sin(self.roll)
        roll = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        yaw = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        return yaw @ roll

    @property
    def to_rail(self) -> Array:
        """Rotation of wheel axes to rail axes, (3, 3)."""
        c, s = math.cos(self.rail_inclination), math.sin(self.rail_inclination)
        # rail's own y axis is (cos, sin) in track (Y, Z), its z axis (-sin, cos)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]]) @ self.to_track

    def track_of_rail(self, points: Array) -> Array:
        """Track (Y, Z) of points (..., 2) given in the rail's (y, z) [m]; directions as well."""
        c, s = math.cos(self.rail_inclination), math.sin(self.rail_inclination)
        return np.asarray(points @ np.array([[c, s], [-s, c]]))


@dataclass(frozen=True, eq=False)
class PlacedWheel:
    """Wheel of a profile and a rolling radius at the tape circle [m] in a pose.

    Its tape circle's lowest point is level with the crown of the rail.
    """

    curve: ProfileCurve
    radius: float
    pose: Pose

    def __post_init__(self) -> None:
        if not self.radius > 0:
            raise InputError(f"wheel radius = {self.radius} m: must be positive")
        if self.curve.upper:
            raise InputError(f"profile {self.curve.name}: is a rail's, a wheel's is needed")

    def points_and_normals(self, x: Array, s: Array) -> tuple[Array, Array]:
        """Points of the surface of revolution, and its outward normals, (n, 3) in rail axes [m].

        At positions x along the wheel, in its own axes, and arc lengths s on its profile, (n,) [m];
        the height is that of the tape circle level with the crown.

        Raises
        ------
        InputError
            If points lie outside the rolling circle.
        """
        c, n = self.curve.point_and_normal(s)
        local = self.radius - c[:, 1]
        square = local**2 - x**2
        if np.any(square <= 0) or np.any(local <= 0):
            raise InputError("wheel: contact points lie outside the rolling circle")
        root = np.sqrt(square)
        # R - sqrt(r^2 - x^2) with r = R - h, written so that no digits are lost
        own = np.stack([x, c[:, 0], c[:, 1] + x**2 / (local + root)], axis=-1)
        # the profile's normal (n_y, n_z) turned about the axle by the angle of x = r sin(a)
        sine, cosine = x / local, root / local
        out = np.stack([-n[:, 1] * sine, n[:, 0], n[:, 1] * cosine], axis=-1)
        turn = self.pose.to_rail
        start = self.pose.lateral * np.array(
            [0.0, math.cos(self.pose.rail_inclination), -math.sin(self.pose.rail_inclination)]
        )
        return own @ turn.T + start, out @ turn.T

    def locus(self, s: Array) -> Array:
        """Positions x where the wheel's normal has no component along the rail, (n,) [m].

        Only there can the circle of arc length s touch a prismatic rail. With the profile's
        normal ``(n_y, n_z)`` and the rows R of the rotation the condition is
        ``-R_xx n_z sin(a) + R_xz n_z cos(a) = -R_xy n_y`` for ``x = r sin(a)``. Where the flange
        is so steep that there is no such place, the circle cannot touch, and the place nearest
        to it is returned.
        """
        c, n = self.curve.point_and_normal(s)
        r_xx, r_xy, r_xz = self.pose.to_rail[0]
        sine, cosine = -r_xx * n[:, 1], r_xz * n[:, 1]
        share = -r_xy * n[:, 0] / np.hypot(sine, cosine)
        angle = np.arcsin(np.clip(share, -0.999, 0.999)) - np.arctan2(cosine, sine)
        return np.asarray((self.radius - c[:, 1]) * np.sin(angle))

    def lowest(self, s: Array) -> Array:
        """Points (n, 3) of the contact locus at arc lengths s (n,), in rail axes [m]."""
        return self.points_and_normals(self.locus(s), s)[0]

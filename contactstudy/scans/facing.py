"""Which way a scanned surface lies, by its shape: along which axis a rail runs, where a wheel's
flange and its axle are."""

from collections.abc import Sequence

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.profiles.orientation import Found, Way, shape_of_rail, shape_of_wheel, stated
from contactstudy.profiles.worn import Body

_SIDE = np.sin(np.deg2rad(10.0))
"""Least vertical part of the normal of facets that are looked at: no faces of rim or foot."""
_SLAB = 0.05  # half length of a slab across, over the scan's
_BAND = 0.005  # half width [m] of the band round a tread that shows its circle
_OPEN = 0.4
"""Net area over area above which a surface is open and faces one way."""
_ROUND = 0.8  # height over length above which a wheel is seen all round


def wrong_axes(
    points: Array, faces: IntArray, body: Body, ways: Sequence[Way], tape: float = 0.0
) -> list[str]:
    """Axes that are not as stated.

    Vertices (n, 3) in this program's axes by what was stated [m]; the winding of the faces (m, 3)
    does not matter. `tape` is Y of a wheel's tape circle [m].
    """
    corners = points[faces]
    area = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(area, axis=1)
    sound = size > 0.0
    centres, normals = corners[sound].mean(axis=1), area[sound] / size[sound, None]
    runs = (body == "rail" and _along(normals, size[sound])) or 0
    for line, ours, what in ((runs, 0, "that the rail runs along"), (_out(area), 2, "it faces")):
        if line != ours:
            name, way = _name(line, ways), ("along", "", "up")[ours]
            return [
                f'{name} is the axis {what}; state {body}_{name} = "{way}", or the other way, and '
                "where the others point"
            ]
    facing = np.abs(normals[:, 2]) > _SIDE
    if not facing.any() or (body == "rail" and not _open(area)):
        return []  # a closed rail's top and underside are one cloud
    seen = _rail(centres[facing]) if body == "rail" else _wheel(centres[facing], tape)
    return seen.faults(body, ways)


def _along(normals: Array, size: Array) -> int:
    """Axis that a rail runs along: the normals of a prism are square to it.

    0 for a flat surface, whose normals leave the direction open.
    """
    value, vector = np.linalg.eigh((normals * size[:, None]).T @ normals)
    line = int(np.argmax(np.abs(vector[:, 0])))
    seen = abs(vector[line, 0]) > 0.9 and value[0] < 0.1 * value[1]
    return line if seen else 0


def _out(area: Array) -> int:
    """Axis that an open surface faces, either way; 2 for one that is closed, or faces all round."""
    return int(np.argmax(np.abs(area.sum(axis=0)))) if _open(area) else 2


def _open(area: Array) -> bool:
    return bool(np.abs(area.sum(axis=0)).max() > _OPEN * np.linalg.norm(area, axis=1).sum())


def _name(line: int, ways: Sequence[Way]) -> str:
    """The file's name of one of our axes."""
    own = {"along": 0, "back": 0, "up": 2, "down": 2}
    return next(n for n, way in zip("xyz", stated(ways), strict=True) if own.get(way, 1) == line)


def _rail(points: Array) -> Found:
    x = points[:, 0]
    middle, length = 0.5 * (x.min() + x.max()), np.ptp(x)
    slab = np.abs(x - middle) <= max(_SLAB * length, np.abs(x - middle).min())
    return shape_of_rail(points[slab][:, 1:])


def _wheel(points: Array, tape: float) -> Found:
    x, y, z = points.T
    if np.ptp(z) > _ROUND * np.ptp(x) and np.ptp(z) > 0.2:
        axis = 0.5 * (x.min() + x.max()), 0.5 * (z.min() + z.max())
        height = -np.hypot(x - axis[0], z - axis[1])
        found = shape_of_wheel(np.stack([y - tape, height], axis=-1))
        return Found(found.y, 1, found.told, found.tip, found.other)
    band = np.abs(y - tape) < _BAND
    if np.count_nonzero(band) < 20:
        return Found(0, 0, "no tread at the tape circle")
    away = x[band] - x[band].mean()
    # z = c + a x + x^2/2R: a tread curves upwards from its lowest line
    bend = float(np.polyfit(away, z[band], 2)[0])
    sign = 1.0 if bend >= 0.0 else -1.0
    height = z - bend * (x - x[band].mean()) ** 2
    found = shape_of_wheel(np.stack([y - tape, sign * height], axis=-1))
    if sign < 0.0:
        told = f"the tread curves downwards to both sides along the rail; {found.told}"
        return Found(found.y, -1, told, other=found.other)
    return found

"""Outlines made of arcs and lines: from a drawing's dimensions to resolved pieces."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from contactstudy.arrays import Array
from contactstudy.profiles.pieces import ArcPiece, LinePiece


@dataclass(frozen=True)
class Line:
    """Straight piece of an outline, a part of the drawing, from start to end (y, z) [m]."""

    part: str
    start: tuple[float, float]
    end: tuple[float, float]

    def y_of_z(self, z: Array) -> Array:
        """Lateral position at height z [m]."""
        (y0, z0), (y1, z1) = self.start, self.end
        return y0 + (z - z0) * ((y1 - y0) / (z1 - z0)) if z1 != z0 else np.full_like(z, y0)

    def z_of_y(self, y: float) -> float:
        """Height at lateral position y [m]."""
        (y0, z0), (y1, z1) = self.start, self.end
        return z0 + (y - y0) * (z1 - z0) / (y1 - y0)

    @property
    def curve(self) -> LinePiece:
        """The piece by arc length."""
        return LinePiece(self.start, self.end)

    def points(self, chord_error: float) -> Array:
        """Both ends, shape (2, 2) [m]; a line has no chord error."""
        return np.array([self.start, self.end])


@dataclass(frozen=True)
class Arc:
    """Circular piece of an outline, shorter than half a circle.

    Parameters
    ----------
    part : str
        What it is on the drawing.
    centre : tuple of float
        Centre (y, z) [m].
    radius : float
        Positive if convex, negative if concave (centre outside the material) [m].
    start, end : tuple of float
        End points (y, z) in walking order [m].
    """

    part: str
    centre: tuple[float, float]
    radius: float
    start: tuple[float, float]
    end: tuple[float, float]

    def y_of_z(self, z: Array) -> Array:
        """Lateral position at height z [m]; right half, where the outward normal has y >= 0."""
        h = z - self.centre[1]
        return self.centre[0] + np.sign(self.radius) * np.sqrt(
            np.maximum(self.radius**2 - h * h, 0.0)
        )

    @property
    def curve(self) -> ArcPiece:
        """The piece by arc length."""
        return ArcPiece(self.centre, self.start, self.end)

    def points(self, chord_error: float) -> Array:
        """Points (n, 2) [m] from start to end whose chords stay within ``chord_error`` [m]."""
        ends = self.start, self.end
        a, b = (np.arctan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in ends)
        sweep = (b - a + np.pi) % (2.0 * np.pi) - np.pi
        step = 2.0 * np.arccos(1.0 - chord_error / abs(self.radius))
        n = max(int(np.ceil(abs(sweep) / step)), 1)
        angle = a + sweep * np.linspace(0.0, 1.0, n + 1)
        points = np.asarray(self.centre) + abs(self.radius) * np.stack(
            [np.cos(angle), np.sin(angle)], axis=-1
        )
        points[0], points[-1] = self.start, self.end
        return points


Segment = Line | Arc


@dataclass(frozen=True)
class _Carrier:
    """Infinite line (radius 0: point, unit direction) or full circle (point is the centre)."""

    part: str
    point: Array
    direction: Array
    radius: float  # signed

    def offset(self, distance: float) -> "_Carrier":
        """Parallel curve, ``distance`` into the material (walking clockwise: to the right)."""
        if self.radius == 0.0:
            inward = np.array([self.direction[1], -self.direction[0]])
            return _Carrier(self.part, self.point + distance * inward, self.direction, 0.0)
        return _Carrier(self.part, self.point, self.direction, self.radius - distance)

    def nearest(self, p: Array) -> Array:
        if self.radius == 0.0:
            return self.point + self.direction * float((p - self.point) @ self.direction)
        d = p - self.point
        return self.point + abs(self.radius) * d / np.linalg.norm(d)


def _unit(v: Sequence[float]) -> Array:
    d = np.asarray(v, dtype=float)
    return d / np.linalg.norm(d)


def _carrier(element: Mapping[str, Any], last: _Carrier | None) -> _Carrier:
    """Circle or line of one path element; ``last`` is the element before it."""
    part = str(element["part"])
    zero = np.zeros(2)
    if "direction" in element:
        return _Carrier(part, np.array(element["point"], float), _unit(element["direction"]), 0.0)
    if "tangent_direction" in element:
        assert last is not None
        d = _unit(element["tangent_direction"])
        outward = np.array([-d[1], d[0]])
        return _Carrier(part, last.point + last.radius * outward, d, 0.0)
    radius = float(element["radius"])
    if "tangent_y" in element:
        # internal tangency at P: the new centre lies on the line from P to the old centre
        assert last is not None
        y = float(element["tangent_y"]) - last.point[0]
        p = last.point + np.array([y, np.sqrt(last.radius**2 - y * y)])
        return _Carrier(part, p + (last.point - p) * radius / last.radius, zero, radius)
    if "inside" in element:
        # internal tangency: distance of the centres is the difference of the radii
        y, z, big = element["inside"]
        dz = float(element["centre_z"]) - z
        dy = np.sqrt((big - abs(radius)) ** 2 - dz * dz)
        return _Carrier(part, np.array([y - dy, z + dz]), zero, radius)
    return _Carrier(part, np.array(element["centre"], float), zero, radius)


def _joint(a: _Carrier, b: _Carrier) -> Array:
    """Point where two carriers touch each other."""
    if a.radius == 0.0:
        return a.nearest(b.point)
    if b.radius == 0.0:
        return b.nearest(a.point)
    # circles that touch from inside: along the line of centres, on the smaller one's far side
    small, big = (a, b) if abs(a.radius) < abs(b.radius) else (b, a)
    return small.point + abs(small.radius) * _unit(list(small.point - big.point))


def _corner(a: _Carrier, b: _Carrier) -> Array:
    """Intersection of a line with a line, or with the circle, on the side walked first."""
    if b.radius == 0.0 and a.radius == 0.0:
        t = np.linalg.solve(np.stack([a.direction, -b.direction], axis=1), b.point - a.point)
        return a.point + t[0] * a.direction
    line, circle = (a, b) if a.radius == 0.0 else (b, a)
    foot = line.nearest(circle.point)
    half = np.sqrt(circle.radius**2 - float(np.sum((foot - circle.point) ** 2)))
    # the arc is the far side of the circle as the line enters it, the near side as it leaves
    return foot + line.direction * half * (1.0 if line is a else -1.0)


def resolve_path(path: Sequence[Mapping[str, Any]]) -> tuple[Segment, ...]:
    """Connected arcs and lines [m] of a half outline from its drawing, fillets included.

    The elements are in the language described in ``meshes/profiles/60E1.toml`` [mm]; clockwise on
    the right half, from (0, 0) to the axis of symmetry at the foot.
    """
    pieces: list[Segment] = []
    carriers: list[_Carrier] = []
    for element in path:
        carriers.append(_carrier(element, carriers[-1] if carriers else None))
    start = np.zeros(2)
    for i, (carrier, element) in enumerate(zip(carriers, path, strict=True)):
        following = carriers[i + 1] if i + 1 < len(carriers) else None
        r = float(path[i + 1].get("fillet", 0.0)) if following is not None else 0.0
        if following is None:
            end = np.array([0.0, carrier.point[1]])
            pieces.append(_piece(carrier, start, end))
        elif r == 0.0:
            end = _joint(carrier, following)
            pieces.append(_piece(carrier, start, end))
            start = end
        else:
            # the fillet's centre is at distance r from both: where their parallels meet
            centre = _corner(carrier.offset(r), following.offset(r))
            end, begin = carrier.nearest(centre), following.nearest(centre)
            pieces.append(_piece(carrier, start, end))
            name = f"fillet {element['part']} / {following.part}"
            pieces.append(_piece(_Carrier(name, centre, np.zeros(2), r), end, begin))
            start = begin
    return tuple(pieces)


def _piece(carrier: _Carrier, start: Array, end: Array) -> Segment:
    a, b, c = ((float(p[0]) * 1e-3, float(p[1]) * 1e-3) for p in (start, end, carrier.point))
    if carrier.radius == 0.0:
        return Line(carrier.part, a, b)
    return Arc(carrier.part, c, carrier.radius * 1e-3, a, b)

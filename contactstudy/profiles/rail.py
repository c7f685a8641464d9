"""Rail cross-sections: exact arcs and lines of the drawing."""

import tomllib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.outline import Arc, Line, Segment, resolve_path
from contactstudy.resources import resource

NAMES = ("60E1", "54E1", "49E1")

# drawn as far as the head goes only
_HEADS = ("UIC60-Manchester",)


@dataclass(frozen=True)
class RailProfile:
    """Cross-section of a rail, symmetric about y = 0.

    Coordinates: y lateral, z up, z = 0 at the top of the rail, foot at ``-height`` [m].

    Parameters
    ----------
    name : str
        Name of the standard's profile.
    height : float
        Height of the rail [m].
    pieces : tuple of Line or Arc
        Right half of the outline from the crown (0, 0) down to (0, -height), clockwise.
    source : str
        Where the dimensions come from.
    reference : tuple of (str, float)
        Values printed by the source, in its units, for checks only.
    """

    name: str
    height: float
    pieces: tuple[Segment, ...]
    source: str = ""
    reference: tuple[tuple[str, float], ...] = ()

    @property
    def crown_radius(self) -> float:
        """Radius of curvature at the top of the rail [m]."""
        first = self.pieces[0]
        assert isinstance(first, Arc)
        return first.radius

    @property
    def foot_width(self) -> float:
        """Greatest width of the foot [m]."""
        return 2.0 * self._piece("foot edge").start[0]

    @property
    def bearing_half_width(self) -> float:
        """Half width of the flat underside of the foot, where the pad acts [m]."""
        return self._piece("foot bottom").start[0]

    @property
    def web_thickness(self) -> float:
        """Least thickness of the web [m]."""
        web = self._piece("web")
        waist = web.start[0] if isinstance(web, Line) else web.centre[0] - abs(web.radius)
        return 2.0 * waist

    @cached_property
    def heights(self) -> dict[str, float]:
        """Heights z of the joints of the right half, from top to bottom [m].

        Keys: ``side_top`` (end of the running surface's arcs), ``side_bottom`` (end of the side
        face), ``head_corner`` (start of the head's underside), ``head_web`` (underside goes over
        into the fillet to the web), ``head_bottom_axis`` (underside produced to the axis),
        ``web_top`` and ``web_bottom`` (ends of the straight web, or of its longest arc),
        ``foot_top_axis`` (foot's top produced to the axis), ``foot_web`` (fillet goes over into the
        foot's top), ``foot_knee`` (middle of the fillet between the two slopes),
        ``foot_edge_top``, ``foot_edge_bottom`` (ends of the vertical edge), ``foot_bottom``.
        """
        side, under = self._piece("side face"), self._piece("head underside")
        web, steep = self._piece("web"), self._piece("foot top, steep")
        shallow, edge = self._piece("foot top, shallow"), self._piece("foot edge")
        return {
            "side_top": side.start[1],
            "side_bottom": side.end[1],
            "head_corner": under.start[1],
            "head_web": under.end[1],
            "head_bottom_axis": _on_axis(under),
            "web_top": web.start[1],
            "web_bottom": web.end[1],
            "foot_top_axis": _on_axis(steep),
            "foot_web": steep.start[1],
            "foot_knee": 0.5 * (steep.end[1] + shallow.start[1]),
            "foot_edge_top": edge.start[1],
            "foot_edge_bottom": edge.end[1],
            "foot_bottom": -self.height,
        }

    def half_width(self, z: ArrayLike) -> Array:
        """Half width of the outline at heights z from ``-height`` to 0 [m].

        At the very foot the end of its rounding.

        Raises
        ------
        InputError
            If a height lies outside the rail.
        """
        h = np.asarray(z, dtype=float)
        if np.any((h > 1e-12) | (h < -self.height - 1e-12) | ~np.isfinite(h)):
            raise InputError(
                f"height z on profile {self.name} must lie between {-self.height} m and 0 m"
            )
        h = np.clip(h, -self.height, 0.0)
        # z falls monotonically along the right half, so the pieces are ordered by it
        sloped = [p for p in self.pieces if p.start[1] > p.end[1]]
        ends = np.array([p.end[1] for p in sloped])
        which = np.searchsorted(-ends, -h, side="left").clip(0, len(sloped) - 1)
        y = np.empty_like(h)
        for k in np.unique(which):
            y[which == k] = sloped[k].y_of_z(h[which == k])
        return y

    @cached_property
    def curve(self) -> ProfileCurve:
        """Running surface with both side faces, by arc length from the crown."""
        return _running_surface(self.name, self.pieces)

    def half_outline(self, chord_error: float = 1e-7) -> Array:
        """Right half from the crown to the foot's centre, shape (n, 2), clockwise [m]."""
        rows = [p.points(chord_error)[:-1] for p in self.pieces]
        return np.concatenate([*rows, [self.pieces[-1].end]])

    @cached_property
    def outline(self) -> Array:
        """Whole outline, shape (n, 2), counter-clockwise from the foot's centre, open [m].

        Chords stay within 0.1 um of the arcs.
        """
        right = self.half_outline()[::-1]
        left = right[::-1][1:-1] * np.array([-1.0, 1.0])
        return np.concatenate([right, left])

    def _piece(self, part: str) -> Segment:
        return next(p for p in self.pieces if p.part == part)


def _on_axis(line: Segment) -> float:
    assert isinstance(line, Line)
    return line.z_of_y(0.0)


def _running_surface(name: str, pieces: tuple[Segment, ...]) -> ProfileCurve:
    """Both halves of the running surface; the pieces of the right one go further down."""
    last = next(k for k, piece in enumerate(pieces) if piece.part == "side face")
    right = [piece.curve for piece in pieces[: last + 1]]
    left = [piece.mirrored for piece in reversed(right)]
    return ProfileCurve(name, (*left, *right), -sum(p.length for p in left), upper=True)


@lru_cache(maxsize=8)
def running_surface(name: str) -> ProfileCurve:
    """Running surface of a drawn rail with both side faces, by arc length from the crown.

    One of ``profiles.rail.NAMES``, or a rail of which only the head is drawn.

    Raises
    ------
    InputError
        If there is no such profile.
    """
    if name in NAMES:
        return rail_profile(name).curve
    if name not in _HEADS:
        raise InputError(f"rail profile '{name}' is unknown; allowed: {', '.join(NAMES + _HEADS)}")
    return _running_surface(name, resolve_path(_drawing(name)["path"]))


def _drawing(name: str) -> dict[str, Any]:
    with resource("meshes", "profiles", f"{name}.toml").open("rb") as file:
        return tomllib.load(file)


@lru_cache(maxsize=8)
def rail_profile(name: str = "60E1") -> RailProfile:
    """Rail profile by its standard's name, one of ``profiles.rail.NAMES``.

    Raises
    ------
    InputError
        If there is no such profile.
    """
    if name not in NAMES:
        raise InputError(f"rail profile '{name}' is unknown; allowed: {', '.join(NAMES)}")
    data = _drawing(name)
    return RailProfile(
        name=data["name"],
        height=data["height"] * 1e-3,
        pieces=resolve_path(data["path"]),
        source=data["source"],
        reference=tuple(data["reference"].items()),
    )

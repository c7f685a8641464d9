"""How matplotlib's lines and areas look, as plain data."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

Shape = dict[str, Any]
"""``kind``, arrays of places and values, and how it looks."""
PIXELS = 96.0 / 72.0
"""Of a page, for a point."""
_MARKERS = {
    "s": "square", "^": "triangle", "v": "inverted_triangle", "D": "diamond", "o": "circle",
    "P": "plus", "X": "x", "x": "x", "+": "cross", "_": "dash", ".": "dot",
}  # fmt: skip
_NARROW = 0.4


class UnknownShapeError(Exception):
    """Something that is shown as a picture."""


def key_of(artist: Any) -> tuple[tuple[str, Any], ...] | None:
    """What tells a line, points or bars from others in a legend."""
    if isinstance(artist, Line2D):
        dash = dashes(artist)
        if dash != "none":
            return ("color", to_hex(artist.get_color())), ("dash", dash)
        look = points(artist)
        return (("dash", dash), *((name, look[name]) for name in ("color", "fill", "marker")))
    if isinstance(artist, Patch):
        color = artist.get_edgecolor() if artist.get_hatch() else artist.get_facecolor()
        return ("color", to_hex(color)), ("dash", "area")
    return None


def labelled(key: Any, shape: Shape, legend: dict[Any, Shape]) -> Shape:
    """The entry of a shape in a legend: of its look, else the only one of its colour."""
    if key in legend:
        return {"label": legend[key]["label"]}
    color = shape["color"] or shape.get("fill")
    own = [entry["label"] for entry in legend.values() if entry["color"] == color]
    return {"label": own[0]} if len(own) == 1 else {}


def dashes(line: Line2D) -> tuple[float, ...] | str:
    """Lengths of dashes and gaps in line widths; () for a solid line, "none" for no line."""
    if line.get_linestyle() in ("None", "none", " ", ""):
        return "none"
    _, pattern = getattr(line, "_unscaled_dash_pattern", (0, None))
    return tuple(float(v) for v in pattern or ())


def stroke(line: Line2D) -> Shape:
    """Of a line; one that is not visible on paper, where a band is shown for it, is narrow."""
    alpha = line.get_alpha()
    look: Shape = {
        "color": to_hex(line.get_color()),
        "width": float(line.get_linewidth()),
        "dash": dashes(line),
        "alpha": 1.0 if alpha is None else float(alpha),
    }
    return look if line.get_visible() else look | {"width": _NARROW, "dash": ()}


def points(line: Line2D) -> Shape:
    """Of a line's points; without ``marker`` if it has none."""
    marker = _MARKERS.get(str(line.get_marker()))
    if marker is None:
        return {}
    return {
        "marker": marker,
        "size": PIXELS * float(line.get_markersize()),
        "color": to_hex(line.get_markeredgecolor()),
        "fill": _hex(line.get_markerfacecolor()),
    }


def filling(faces: Any, edges: Any, widths: Any) -> Shape:
    """Of polygons of one look: ``fill`` with its ``alpha``, ``color`` and ``width`` of the edge.

    Raises
    ------
    UnknownShapeError
        If they have several.
    """
    face, edge, width = np.atleast_2d(faces), np.atleast_2d(edges), np.atleast_1d(widths)
    if len(face) > 1 or len(edge) > 1:
        raise UnknownShapeError("polygons of several colours")
    fill, color = face[0] if face.size else np.zeros(4), edge[0] if edge.size else np.zeros(4)
    return {
        "fill": to_hex(tuple(fill)) if fill[3] > 0 else None,
        "alpha": float(fill[3]),
        "color": to_hex(tuple(color)) if color[3] > 0 and width[0] > 0 else None,
        "width": float(width[0]),
    }


def _hex(color: Any) -> str | None:
    return None if isinstance(color, str) and color == "none" else to_hex(color)

"""Lines, areas and maps on matplotlib's axes as plain data."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import (
    Collection,
    LineCollection,
    PathCollection,
    PolyCollection,
    QuadMesh,
)
from matplotlib.colors import to_hex
from matplotlib.contour import ContourSet
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.text import Text

from contactstudy.arrays import Array
from contactstudy.plot.cells import cells
from contactstudy.plot.looks import (
    PIXELS,
    Shape,
    UnknownShapeError,
    filling,
    key_of,
    labelled,
    points,
    stroke,
)

_POLYGONS = 400
"""More of them are a picture."""
_LABELLED = ("line", "points", "areas", "bars")
_SIDES = ("left", "right", "bottom", "top")


def shapes_of(axes: Axes, legend: dict[Any, Shape]) -> list[Shape]:
    """All that lies on the axes, from below to above; of bars of one look one shape.

    Raises
    ------
    UnknownShapeError
        For what is no line, area or map.
    """
    found: list[Shape] = []
    lying = [*axes.lines, *axes.collections, *axes.patches, *axes.texts, *axes.images]
    for artist in sorted(lying, key=lambda one: one.get_zorder()):
        make = next((make for kind, make in _KNOWN if isinstance(artist, kind)), None)
        if make is None:
            raise UnknownShapeError(type(artist).__name__)
        for shape in make(axes, artist):
            if shape["kind"] in _LABELLED:
                shape |= labelled(key_of(artist), shape, legend)
            if shape["kind"] == "bars" and found and _look(found[-1]) == _look(shape):
                for side in _SIDES:
                    found[-1][side] = np.append(found[-1][side], shape[side])
            else:
                found.append(shape)
    return found


def _look(shape: Shape) -> Shape:
    return {k: v for k, v in shape.items() if not isinstance(v, np.ndarray)}


def _line(axes: Axes, line: Line2D) -> Iterator[Shape]:
    data = line.get_data(orig=False)
    x, y = np.array([np.ma.filled(np.ma.asarray(v, float), np.nan) for v in data])
    look, marks, steps = stroke(line), points(line), line.get_drawstyle()
    transform = line.get_transform()
    for which, blended in _blended(axes):
        if transform == blended and not marks:
            yield {"kind": "across", "along": which, "at": float((x, y)[which == "y"][0])} | look
            return
        if transform == blended:  # marks on the edge of the axes
            place = transform.transform(np.column_stack([x, y]))
            x, y = axes.transData.inverted().transform(place).T
            break
    else:
        if transform != axes.transData or steps not in ("default", "steps-post"):
            raise UnknownShapeError("a line in other coordinates, or other steps")
    if look["dash"] != "none":
        stepped = steps == "steps-post"
        sx, sy = (np.repeat(x, 2)[1:], np.repeat(y, 2)[:-1]) if stepped else (x, y)
        yield {"kind": "line", "x": sx, "y": sy} | look
    if marks:
        yield {"kind": "points", "x": x, "y": y} | look | marks


def _blended(axes: Axes) -> Iterator[tuple[str, Any]]:
    """Coordinates that are places along one axis, and shares of the other's length."""
    yield "x", axes.get_xaxis_transform()
    yield "y", axes.get_yaxis_transform()


def _points(axes: Axes, marks: PathCollection) -> Iterator[Shape]:
    x, y = np.array(np.ma.filled(np.ma.asarray(marks.get_offsets(), float), np.nan)).T
    look = filling(marks.get_facecolor(), marks.get_edgecolor(), marks.get_linewidth())
    size = PIXELS * float(np.sqrt(marks.get_sizes()[0]))
    own = {"size": size, "marker": "circle", "color": look["color"] or look["fill"]}
    yield {"kind": "points", "x": x, "y": y} | look | own


def _areas(axes: Axes, areas: Collection) -> Iterator[Shape]:
    """Filled polygons, such as the band between two curves."""
    if not areas.get_visible():
        return
    polygons = _outlines(axes, areas)
    if len(polygons) > _POLYGONS:
        raise UnknownShapeError("many polygons")
    look = filling(areas.get_facecolor(), areas.get_edgecolor(), areas.get_linewidth())
    own = {"hatch": bool(areas.get_hatch())}
    yield {"kind": "areas", "polygons": [list(p.T) for p in polygons]} | look | own


def _lines(axes: Axes, lines: Collection) -> Iterator[Shape]:
    """Lines of one look, with gaps between them."""
    colors = np.atleast_2d(np.asarray(lines.get_edgecolor(), dtype=float))
    if len(np.unique(colors, axis=0)) > 1:
        raise UnknownShapeError("lines of several colours")
    gap = np.full((1, 2), np.nan)
    if parts := [part for path in _outlines(axes, lines) for part in (path, gap)]:
        x, y = np.concatenate(parts).T
        width = float(np.atleast_1d(lines.get_linewidth())[0])
        look = {"color": to_hex(tuple(colors[0])), "width": width, "alpha": float(colors[0][3])}
        yield {"kind": "line", "x": x, "y": y, "dash": ()} | look


def _outlines(axes: Axes, drawn: Collection) -> list[Array]:
    if drawn.get_transform() != axes.transData:
        raise UnknownShapeError("polygons in other coordinates")
    paths = drawn.get_paths()
    return [np.asarray(p, float) for path in paths for p in path.to_polygons(closed_only=False)]


def _contours(axes: Axes, lines: ContourSet) -> Iterator[Shape]:
    if lines.filled:
        raise UnknownShapeError("filled contours")
    yield from _lines(axes, lines)


def _patch(axes: Axes, patch: Patch) -> Iterator[Shape]:
    """Bars and other polygons, and stretches that are marked through all the height."""
    if not patch.get_visible():
        return
    look = filling([patch.get_facecolor()], [patch.get_edgecolor()], patch.get_linewidth())
    ends = patch.get_corners() if isinstance(patch, Rectangle) else np.zeros((1, 2))
    (left, bottom), (right, top) = ends.min(axis=0), ends.max(axis=0)
    for which, blended in _blended(axes):
        if patch.get_data_transform() == blended and isinstance(patch, Rectangle):
            low, high = (left, right) if which == "x" else (bottom, top)
            yield {"kind": "stretch", "along": which, "low": low, "high": high} | look
            return
    if patch.get_data_transform() != axes.transData:
        raise UnknownShapeError("a polygon in other coordinates")
    look["hatch"] = bool(patch.get_hatch())
    if isinstance(patch, Rectangle):
        sides = zip(_SIDES, (left, right, bottom, top), strict=True)
        upright = bool(bottom == 0.0 or left != 0.0)
        yield {"kind": "bars", "upright": upright} | {k: np.array([v]) for k, v in sides} | look
        return
    # curves become lines in pixels, where short ones are not coarse
    drawn = patch.get_transform().transform_path(patch.get_path()).to_polygons()
    polygons = [list(axes.transData.inverted().transform(p).T) for p in drawn]
    yield {"kind": "areas", "polygons": polygons} | look


def _text(axes: Axes, text: Text) -> Iterator[Shape]:
    if not text.get_text() or not text.get_visible():
        return
    place = text.get_transform().transform(text.get_position())
    x, y = axes.transData.inverted().transform(place)
    yield {
        "kind": "text", "at": (float(x), float(y)), "text": text.get_text(),
        "color": to_hex(text.get_color()), "align": text.get_horizontalalignment(),
        "baseline": text.get_verticalalignment(), "size": float(text.get_fontsize()),
    }  # fmt: skip


_KNOWN: tuple[tuple[type, Callable[[Axes, Any], Iterator[Shape]]], ...] = (
    (Line2D, _line), (QuadMesh, cells), (ContourSet, _contours), (PathCollection, _points),
    (PolyCollection, _areas), (LineCollection, _lines), (Patch, _patch), (Text, _text),
)  # fmt: skip

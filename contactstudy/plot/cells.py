"""Maps of coloured cells on matplotlib's axes as plain data: their values and colours."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import BoundaryNorm, LogNorm, to_hex

from contactstudy.arrays import Array
from contactstudy.plot.looks import Shape, UnknownShapeError

_MOST = 40_000
"""More cells are a picture."""
_COLOURS = 256


def cells(axes: Axes, mesh: QuadMesh) -> Iterator[Shape]:
    """Cells between lines x (nx + 1,), y (ny + 1,): ``cells``, or an ``image`` of equal ones."""
    corners = np.asarray(mesh.get_coordinates(), dtype=float)
    values: Array = np.ma.filled(np.ma.asarray(mesh.get_array(), float), np.nan)
    x, y = corners[0, :, 0], corners[:, 0, 1]
    if values.size > _MOST or np.ptp(corners[..., 0], axis=0).any():
        raise UnknownShapeError("a large or oblique map")
    bars = [m.colorbar for a in axes.figure.axes for m in a.collections if m.norm is mesh.norm]
    bar = next((bar for bar in bars if bar), None)
    equal = (axes.get_xscale(), axes.get_yscale()) == ("linear", "linear") and all(
        np.allclose(np.diff(u), u[1] - u[0]) for u in (x, y)
    )
    yield {
        "kind": "image" if equal else "cells",
        "x": x,
        "y": y,
        "values": values.reshape(len(y) - 1, len(x) - 1),
        "colours": _colours(mesh.norm, mesh.cmap),
        "name": bar.ax.get_ylabel() or bar.ax.get_xlabel() if bar else "",
        "bar": bar is not None,
    }


def _colours(norm: Any, cmap: Any) -> Shape:
    """Palette, and the values of its ends or between its steps."""
    if isinstance(norm, BoundaryNorm):
        steps = [norm.boundaries[0] - 1.0, *norm.boundaries]
        palette = [to_hex(cmap(norm(np.nextafter(v, np.inf)))) for v in steps]
        return {"bounds": [float(v) for v in norm.boundaries], "palette": palette}
    palette = [to_hex(color) for color in cmap(np.linspace(0.0, 1.0, _COLOURS))]
    ends = {"low": float(norm.vmin), "high": float(norm.vmax)}
    return {**ends, "log": isinstance(norm, LogNorm), "palette": palette}

"""Fields of the patch on its grid: both halves of a symmetric model, lines in millimetres."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array

if TYPE_CHECKING:
    import xarray as xr

_FIELDS = ("pressure", "gap", "contact_status")
_ALONG = "position along the rail, relative to the wheel"


def whole_grid(
    run: xr.Dataset, field: Array, at: tuple[str, str] = ("point_x", "point_y")
) -> tuple[Array, Array, Array]:
    """Grid lines (n,), (m,) in mm and a field (k, points) on them, (k, n, m).

    Both halves of a symmetric model. `at` names the points' coordinates.
    """
    # positions of points come from their interpolation, equal but for rounding
    x, y = (np.unique(np.round(np.asarray(run[name].values), 9)) for name in at)
    grid = field.reshape(-1, len(x), len(y))
    if run["point_y"].attrs.get("symmetric", y[0] >= -1e-9):
        rest = 1 if y[0] < 1e-9 else 0  # points on the plane of symmetry have no mirror image
        mirrored = grid[:, :, rest:][:, :, ::-1]
        y, grid = np.r_[-y[rest:][::-1], y], np.concatenate([mirrored, grid], axis=2)
    return x * 1e3, y * 1e3, grid


def with_maps(run: xr.Dataset) -> xr.Dataset:
    """A run that has stored fields of its patch, with these as maps beside them; others as it is.

    ``pressure_map`` and so on have the dimensions (instant, patch_x, patch_y), whose coordinates
    are in mm.
    """
    dims = {"instant", "point"}
    stored = [name for name in _FIELDS if name in run and set(run[name].dims) == dims]
    maps = {}
    for name in stored:
        values = run[name].transpose("instant", "point")
        x, y, grid = whole_grid(run, np.asarray(values.values))
        maps[f"{name}_map"] = (("instant", "patch_x", "patch_y"), grid, values.attrs)
    if not maps:
        return run
    across = run["point_y"].attrs.get("long_name", "position across")
    lines = {
        "patch_x": ("patch_x", x, {"units": "mm", "long_name": _ALONG}),
        "patch_y": ("patch_y", y, {"units": "mm", "long_name": across}),
    }
    return run.assign_coords(lines).assign(maps)

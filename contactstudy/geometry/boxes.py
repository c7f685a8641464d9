"""Boxes that enclose a surface piece by piece, for the search of what comes near it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve

if TYPE_CHECKING:
    import trimesh


def facet_boxes(
    mesh: trimesh.Trimesh, size: float, padding: float = 0.0, along: float = np.inf
) -> Array:
    """Boxes (m, 2, 3), lower and upper corners [m], around groups of a surface's facets.

    Facets are grouped by the cell of a lattice in which their centre lies, `size` across (y and z)
    and `along` long (x) [m]; without `along` a box may be as long as a rail. A box encloses its
    facets whole and is enlarged by `padding` [m] on all sides; so the boxes together cover the
    surface however it is triangulated.

    Raises
    ------
    InputError
        If the surface has no facets or a size is not positive.
    """
    if len(mesh.faces) == 0 or not size > 0 or not along > 0:
        raise InputError(
            f"boxes around facets: {len(mesh.faces)} facets in cells of {size} m by {along} m; "
            "allowed: one facet or more, sizes above 0 m"
        )
    triangles = np.asarray(mesh.triangles, dtype=float)
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    centre = triangles.mean(axis=1) - low.min(axis=0)
    cells = np.floor(centre / np.array([along, size, size])).astype(np.int64)
    _, group = np.unique(cells, axis=0, return_inverse=True)
    order = np.argsort(group.ravel(), kind="stable")
    begins = np.flatnonzero(np.diff(group.ravel()[order], prepend=-1))
    return np.stack(
        [
            np.minimum.reduceat(low[order], begins) - padding,
            np.maximum.reduceat(high[order], begins) + padding,
        ],
        axis=1,
    )


def largest_sagitta(curve: ProfileCurve, s: Array) -> float:
    """Largest distance of a profile from the chords between arc lengths s (n,), in m."""
    inner = np.asarray(s)[:-1, None] + np.diff(s)[:, None] * np.linspace(0.0, 1.0, 9)
    p = curve.point(inner)
    chord = p[:, -1:] - p[:, :1]
    off = p - p[:, :1]
    cross = chord[..., 0] * off[..., 1] - chord[..., 1] * off[..., 0]
    # between the nine places it can be larger by (1/16)^2 of the whole
    return float(np.abs(cross / np.linalg.norm(chord, axis=-1)).max()) * 1.01

"""Faults of a triangulated surface: degenerate, doubled, flipped triangles, edges of more than two.

All places are given in the file's own unit, so that they are found in the scanner's program.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import numpy as np

from contactstudy.arrays import Array, IntArray

if TYPE_CHECKING:
    import trimesh

THINNEST = 1e-5
"""Height over longest edge below which a triangle is degenerate (single precision rounds it)."""
_SHOWN = 3
_TOP = 5e-3  # depth [m] of the outermost facets, which show where the outside is


def faults(
    mesh: trimesh.Trimesh, body: Literal["rail", "wheel"], unit: float, unit_name: str
) -> list[str]:
    """Everything that makes a surface unusable, one sentence a kind with count and places.

    The mesh is in m, equal vertices joined; `unit` is the file's length unit in m. A rail is looked
    at from above, a wheel from below.
    """
    centres = np.asarray(mesh.triangles_center, dtype=float) / unit

    def at(which: IntArray) -> str:
        return _places(centres, which, unit_name)

    degenerate = degenerate_triangles(mesh)
    sound = np.setdiff1d(np.arange(len(mesh.faces)), degenerate)
    problems = []
    if len(degenerate):
        problems.append(f"{triangles(len(degenerate), 'degenerate')}, without area{at(degenerate)}")
    if not len(sound):
        return problems
    faces = np.asarray(mesh.faces, dtype=np.int64)[sound]
    many, flipped, sheet = _orientation(faces)
    if len(many):
        problems.append(
            f"{triangles(len(many))} at edges that more than two share (not a surface)"
            f"{at(sound[many])}"
        )
    if len(flipped):
        problems.append(
            f"{triangles(len(flipped), 'flipped')}, against the winding of the neighbours"
            f"{at(sound[flipped])}"
        )
    problems += _inward(mesh, sound, sheet, body, at)
    return problems


def degenerate_triangles(mesh: trimesh.Trimesh) -> IntArray:
    """Numbers of the triangles whose height is nothing beside their longest edge."""
    corners = np.asarray(mesh.triangles, dtype=float)
    edges = np.roll(corners, -1, axis=1) - corners
    longest = np.linalg.norm(edges, axis=2).max(axis=1)
    double = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    # twice the area is longest edge times height
    return np.flatnonzero(double <= THINNEST * longest**2).astype(np.int64)


def _orientation(faces: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Triangles at edges of more than two; those flipped; the connected sheet of each triangle.

    In the double cover every triangle is there both ways round. Two that share an edge are joined
    as they would have to lie for it to be walked once in each direction. A sheet then has two
    halves; the triangles that lie in its smaller one as given are flipped. Where the halves are
    one, no winding is consistent, and the triangles along the seam are named.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    n = len(faces)
    start, end = faces, np.roll(faces, -1, axis=1)
    low, high = np.minimum(start, end).ravel(), np.maximum(start, end).ravel()
    forward, owner = (start < end).ravel(), np.repeat(np.arange(n), 3)
    order = np.lexsort((high, low))
    new = np.concatenate([[True], (np.diff(low[order]) != 0) | (np.diff(high[order]) != 0)])
    begin = np.flatnonzero(new)
    count = np.diff(np.append(begin, len(order)))
    edge = np.repeat(count, count)
    many = np.unique(owner[order][edge > 2])
    pair = begin[count == 2]
    one, two = order[pair], order[pair + 1]
    f, g = owner[one], owner[two]
    against = forward[one] == forward[two]
    # node t is the triangle as given, node t + n the same turned over
    other = np.where(against, g + n, g)
    rows = np.concatenate([f, f + n])
    columns = np.concatenate([other, np.where(against, g, g + n)])
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(2 * n, 2 * n))
    label = connected_components(graph, directed=False)[1]
    as_given, turned = label[:n], label[n:]
    sheet = np.minimum(as_given, turned)
    votes = np.bincount(as_given, minlength=int(label.max()) + 1)
    flipped = votes[as_given] < votes[turned]
    # a tie: the ones of the half with the higher number
    flipped |= (votes[as_given] == votes[turned]) & (as_given > turned)
    seam = np.unique(np.concatenate([f[against], g[against]]))
    twisted = seam[as_given[seam] == turned[seam]]
    return many, np.union1d(np.flatnonzero(flipped), twisted), sheet


def _inward(
    mesh: trimesh.Trimesh,
    sound: IntArray,
    sheet: IntArray,
    body: Literal["rail", "wheel"],
    at: Callable[[IntArray], str],
) -> list[str]:
    """Complaint about sheets whose outermost facets face into the body."""
    sign = 1.0 if body == "rail" else -1.0
    corners = np.asarray(mesh.triangles, dtype=float)[sound]
    height = sign * corners[:, :, 2].mean(axis=1)
    # vertical component of the area
    edges = corners[:, 1:] - corners[:, :1]
    lift = 0.5 * sign * np.cross(edges[:, 0], edges[:, 1])[:, 2]
    turned = np.zeros(len(sound), dtype=bool)
    for k in np.unique(sheet[height > height.max() - _TOP]):
        member = sheet == k
        outermost = member & (height > height[member].max() - _TOP)
        if lift[outermost].sum() < 0:
            turned |= member
    if not turned.any():
        return []
    where = "up" if body == "rail" else "down"
    return [
        f"{triangles(int(turned.sum()))} turned inside out: the normals of the running surface "
        f"must point out of the body ({where}){at(sound[turned])}"
    ]


def triangles(count: int, kind: str = "") -> str:
    """Their number in words of a sentence."""
    return f"{count} {kind}{' ' * bool(kind)}triangle{'s' * (count != 1)}"


def _places(centres: Array, which: IntArray, unit: str) -> str:
    shown = "; ".join(
        f"triangle {k} at ({', '.join(f'{c:.4g}' for c in centres[k])}) {unit}"
        for k in which[:_SHOWN]
    )
    return f" ({shown}{', ...' if len(which) > _SHOWN else ''})"

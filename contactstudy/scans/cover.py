"""Whether facets cover the place where a scanned surface is touched."""

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.scans.scan import Scan, developed

_NEAR = 1e-3  # distance from the fitted surface [m] within which an edge belongs to it


def uncovered(scan: Scan, x: float, s: float, half_length: float, half_width: float) -> str:
    """Complaint about a hole in the facets around a place, "" where they cover it.

    A surface without an edge of its own within a zone covers all of the zone or nothing of it; so
    the zone is covered if no edge with one triangle only passes through it and its centre lies in a
    triangle.

    The centre is x along the rail, or the tape circle, from the scan's origin, and the arc length s
    on the generating curve [m]; the zone reaches half its size to both sides [m].
    """
    mesh = scan.mesh
    zone = (
        f"the contact zone, x = {1e3 * (x - half_length):.1f} to {1e3 * (x + half_length):.1f} mm, "
        f"s = {1e3 * (s - half_width):.1f} to {1e3 * (s + half_width):.1f} mm from the "
        f"{'crown in the middle of the scan' if scan.body == 'rail' else 'tape circle below axle'}"
    )
    half = np.array([half_length, half_width])
    u, v, distance = developed(scan, np.asarray(mesh.vertices))
    # in units of the zone's half size about its centre
    plan = (np.stack([u, v], axis=-1) - [x, s]) / half
    near = np.abs(distance) < _NEAR
    faces = np.asarray(mesh.faces)[near[mesh.faces].all(axis=1)]
    edges = _free_edges(faces)
    crossing = edges[_meets_square(plan[edges[:, 0]], plan[edges[:, 1]])]
    if len(crossing):
        ends = plan[crossing].reshape(-1, 2) * half + [x, s]
        low, high = ends.min(axis=0), ends.max(axis=0)
        limits = plan[near].min(axis=0), plan[near].max(axis=0)
        kind = "is cut off by the scan's edge or has a hole"
        if np.all(limits[0] < -1.0) and np.all(limits[1] > 1.0):
            kind = "has a hole in the scan"
        return (
            f"{scan.name}: {zone}, {kind}: free edges from x = {1e3 * low[0]:.1f} to "
            f"{1e3 * high[0]:.1f} mm, s = {1e3 * low[1]:.1f} to {1e3 * high[1]:.1f} mm"
        )
    if not _holds_origin(plan[faces]):
        return f"{scan.name}: {zone}, is not covered by the scan"
    return ""


def _free_edges(faces: IntArray) -> IntArray:
    """Edges (k, 2) that belong to one triangle only."""
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return np.asarray(unique[count == 1])


def _meets_square(a: Array, b: Array) -> BoolArray:
    """Which segments a-b (n, 2) pass through the square from -1 to 1 (Liang and Barsky 1984)."""
    d = b - a
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (-1.0 - a) / d, (1.0 - a) / d
    level = d == 0.0
    inside = np.abs(a) <= 1.0
    enter = np.where(level, np.where(inside, -np.inf, np.inf), np.minimum(first, second))
    leave = np.where(level, np.where(inside, np.inf, -np.inf), np.maximum(first, second))
    return np.asarray(np.maximum(enter.max(axis=1), 0.0) <= np.minimum(leave.min(axis=1), 1.0))


def _holds_origin(triangles: Array) -> bool:
    """Whether any of the triangles (n, 3, 2) contains (0, 0)."""
    after = np.roll(triangles, -1, axis=1)
    turn = triangles[..., 0] * after[..., 1] - triangles[..., 1] * after[..., 0]
    return bool(np.any(np.all(turn >= 0, axis=1) | np.all(turn <= 0, axis=1)))

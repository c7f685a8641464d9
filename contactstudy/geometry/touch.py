"""First touch of two arbitrary triangulated bodies along the vertical."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.geometry.search import FacetSearch, bounding_volumes

if TYPE_CHECKING:
    import trimesh


@dataclass(frozen=True)
class FirstTouch:
    """Where a body moved straight down meets another one.

    Attributes
    ----------
    travel : float
        Downward travel of the upper body until it touches, in m (negative: it had to be
        raised).
    point : ndarray (3,)
        The point touched, on the lower body, in m.
    lower_facet, upper_facet : int
        Triangles that touch.
    """

    travel: float
    point: Array
    lower_facet: int
    upper_facet: int


def first_touch(
    lower: trimesh.Trimesh, upper: trimesh.Trimesh, tolerance: float = 1e-7
) -> FirstTouch:
    """Lower one body onto another, both in the same axes [m], along Z.

    FCL's distance between the two surfaces is never larger than the vertical clearance, so lowering
    by it again and again (conservative advancement) cannot pass the first touch. When the distance
    is below the tolerance [m] the facets near the touch are compared exactly, in double precision.

    Raises
    ------
    InputError
        If the bodies never touch.
    NumericalError
        If the advancement does not come to an end.
    """
    import fcl

    model = FacetSearch(lower)
    fixed = fcl.CollisionObject(model.model, fcl.Transform())
    moving = fcl.CollisionObject(bounding_volumes(upper), fcl.Transform())
    # start well apart
    travel = float(upper.vertices[:, 2].min() - lower.vertices[:, 2].max()) - 1e-3
    last = float(upper.vertices[:, 2].max() - lower.vertices[:, 2].min())
    for _ in range(2000):
        moving.setTranslation(np.array([0.0, 0.0, -travel]))
        result = fcl.DistanceResult()
        distance = fcl.distance(fixed, moving, fcl.DistanceRequest(True), result)
        if distance <= tolerance:
            return _exact(model, upper, travel, np.asarray(result.nearest_points[0]), tolerance)
        travel += distance
        if travel > last:
            raise InputError(
                "first touch: the bodies never touch when one is lowered onto the other "
                f"(lower body x {_range(lower, 0)}, y {_range(lower, 1)}; "
                f"upper body x {_range(upper, 0)}, y {_range(upper, 1)})"
            )
    raise NumericalError(
        f"first touch: not reached after 2000 steps; the bodies still stand {distance:.3e} m apart"
    )


def _range(mesh: trimesh.Trimesh, axis: int) -> str:
    low, high = mesh.bounds[:, axis]
    return f"{low:.4g} to {high:.4g} m"


def _exact(
    model: FacetSearch, upper: trimesh.Trimesh, travel: float, near: Array, tolerance: float
) -> FirstTouch:
    """Least vertical clearance of the facets around a point."""
    lower = model.mesh
    up = FacetSearch(upper)
    reach = max(50 * tolerance, 2 * _edge(lower, near), 2 * _edge(upper, near))
    box = np.array([[near - reach, near + reach]])
    box[:, :, 2] += [-reach, reach]
    below = model.meeting(box)
    above = up.meeting(box, np.array([0.0, 0.0, -travel]))
    pairs = np.stack(np.meshgrid(below, above, indexing="ij"), axis=-1).reshape(-1, 2)
    A = np.asarray(lower.triangles, dtype=float)[pairs[:, 0]]
    B = np.asarray(upper.triangles, dtype=float)[pairs[:, 1]]
    clearance, points = _clearances(A, B)
    if not np.any(np.isfinite(clearance)):
        raise NumericalError(f"first touch: no facets lie over each other near {near}")
    best = int(np.argmin(clearance))
    return FirstTouch(
        float(clearance[best]), points[best], int(pairs[best, 0]), int(pairs[best, 1])
    )


def _edge(mesh: trimesh.Trimesh, near: Array) -> float:
    """Longest edge of the facet whose centre lies nearest in plan."""
    centres = mesh.triangles_center[:, :2] - near[:2]
    triangle = mesh.triangles[int(np.argmin((centres**2).sum(axis=1)))]
    return float(np.linalg.norm(triangle - np.roll(triangle, 1, axis=0), axis=1).max())


def _clearances(lower: Array, upper: Array) -> tuple[Array, Array]:
    """Least vertical distance (m,) of pairs of triangles (m, 3, 3) over their common plan, where.

    It is linear over the common plan, a convex polygon, so least at a corner: a vertex of either
    triangle inside the other, or a crossing of two edges. Inf where they do not lie over each
    other; the points (m, 3) are on the lower one.
    """
    p, q = lower[:, :, None, :2], upper[:, None, :, :2]
    r, s = np.roll(lower, -1, axis=1)[:, :, None, :2] - p, np.roll(upper, -1, 1)[:, None, :, :2] - q
    # edges all but parallel cross far outside both triangles, or at infinity: no corner
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        t = _cross(q - p, s) / _cross(r, s)
        crossing = (p + t[..., None] * r).reshape(len(lower), 9, 2)
        corners = np.concatenate([upper[:, :, :2], lower[:, :, :2], crossing], axis=1)
        z = [_height(body, corners) for body in (lower, upper)]
    distance = np.where(np.isfinite(z[0]) & np.isfinite(z[1]), z[1] - z[0], np.inf)
    best = np.argmin(distance, axis=1)
    row = np.arange(len(lower))
    points = np.concatenate([corners[row, best], z[0][row, best, None]], axis=1)
    return distance[row, best], points


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _height(triangles: Array, at: Array) -> Array:
    """Height (m, k) of each triangle at its own points (m, k, 2); NaN outside and if vertical."""
    a, b, c = (triangles[:, None, i] for i in range(3))
    d = at - a[..., :2]
    area = _cross(b[..., :2] - a[..., :2], c[..., :2] - a[..., :2])
    u = _cross(d, c[..., :2] - a[..., :2]) / area
    v = _cross(b[..., :2] - a[..., :2], d) / area
    inside = (u >= -1e-12) & (v >= -1e-12) & (u + v <= 1 + 1e-12)
    z = a[..., 2] + u * (b[..., 2] - a[..., 2]) + v * (c[..., 2] - a[..., 2])
    return np.where(inside, z, np.nan)

"""Which facets can touch: broad phase with trimesh and FCL.

FCL answers only the question "which facets come near"; distances, depths and normals are
computed elsewhere in double precision from smooth geometry. The query is
``fcl.collide(BVH, Box)`` with the BVH first, because only the first object's facet numbers are
returned, against boxes that enclose pieces of the other body's surface. The BVH is built once
on the undeformed surface; the bodies' relative position enters through a transform.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.geometry.boxes import facet_boxes

if TYPE_CHECKING:
    import fcl
    import trimesh


def grid_mesh(nodes: Array) -> trimesh.Trimesh:
    """Triangulate a surface given by the nodes (nx, ny, 3) of a grid.

    Node ``i*ny + j``; quadrilateral ``q = i*(ny-1) + j`` becomes the triangles ``2q`` and
    ``2q + 1``. Unprocessed, so numbers are kept; normals up where x and y grow with i and j.
    """
    import trimesh

    nx, ny, _ = nodes.shape
    node = np.arange(nx * ny).reshape(nx, ny)
    a, b, c, d = node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2).reshape(-1, 3)
    return trimesh.Trimesh(nodes.reshape(-1, 3), faces, process=False)


class FacetSearch:
    """Finds the facets of one surface that meet given boxes; refuses a surface without facets."""

    def __init__(self, mesh: trimesh.Trimesh) -> None:
        import fcl

        if len(mesh.faces) == 0:
            raise InputError("contact search: the surface has no facets")
        self.mesh = mesh
        self.model = bounding_volumes(mesh)
        self._object = fcl.CollisionObject(self.model, fcl.Transform())

    def meeting(self, boxes: Array, offset: Array | None = None) -> IntArray:
        """Facets that meet any axis-aligned boxes (m, 2, 3), lower and upper corners [m]; sorted.

        `offset` (3,) is the position of the surface relative to the boxes' axes [m].
        """
        import fcl

        self._object.setTranslation(np.zeros(3) if offset is None else np.asarray(offset))
        # room for every facet: FCL stops silently at the limit
        request = fcl.CollisionRequest(
            num_max_contacts=4 * len(self.mesh.faces) + 16, enable_contact=True
        )
        found: set[int] = set()
        for low, high in np.asarray(boxes, dtype=float):
            box = fcl.CollisionObject(
                fcl.Box(*(high - low)), fcl.Transform(np.eye(3), 0.5 * (low + high))
            )
            result = fcl.CollisionResult()
            fcl.collide(self._object, box, request, result)
            found.update(int(contact.b1) for contact in result.contacts)
        return np.array(sorted(found), dtype=np.int64)


def bounding_volumes(mesh: trimesh.Trimesh) -> fcl.BVHModel:
    """FCL's bounding volume hierarchy of a triangulated surface."""
    import fcl

    model = fcl.BVHModel()
    model.beginModel(len(mesh.vertices), len(mesh.faces))
    model.addSubModel(np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces))
    model.endModel()
    return model


class CandidateList:
    """Facets of the upper body that can touch, kept until the bodies have moved (a Verlet list).

    A list made for the approach d holds every facet of the upper body that comes within the padding
    of the lower body's surface, or has passed through it. It serves all approaches up to
    ``d + padding``, and is made anew as well when the approach has fallen so far that it is
    needlessly long; `queries` counts how often.

    A point of the upper body that lies below the lower surface stood above it at first touch, an
    approach higher; so the boxes around the lower surface, drawn down by the approach, hold all
    such points, whatever the shapes and the position of the bodies.

    Parameters
    ----------
    wheel, rail
        The upper body in its position at first touch, the tread as made by `grid_mesh` or any
        triangulated surface, and the lower body's surface in the same axes.
    sagitta : float
        Largest distance between facets and smooth surface, both bodies together, in m.
    padding, box_size : float
        Padding, and size across of the groups of facets that a box encloses, in m.
    """

    def __init__(
        self,
        wheel: FacetSearch,
        rail: trimesh.Trimesh,
        sagitta: float = 0.0,
        padding: float = 20e-6,
        box_size: float = 2e-3,
    ) -> None:
        self._wheel, self._padding = wheel, padding
        self._boxes = facet_boxes(rail, box_size, padding + sagitta)
        self._made_for = np.nan
        self._facets = self._quads = np.empty(0, dtype=np.int64)
        self.queries = 0

    def facets(self, approach: float) -> IntArray:
        """Triangles of the upper body that can touch at a rigid approach, sorted.

        The approach is how far the undeformed upper body stands below the first touch of the smooth
        surfaces, in m; with irregularity its largest value over the patch. The same object is
        returned as long as the list is the same.
        """
        if -2 * self._padding <= approach - self._made_for <= self._padding:
            return self._facets
        boxes = self._boxes.copy()
        boxes[:, 0, 2] -= max(approach, 0.0)
        self._facets = self._wheel.meeting(boxes, np.array([0.0, 0.0, -approach]))
        self._quads = np.unique(self._facets // 2)
        self._made_for = approach
        self.queries += 1
        return self._facets

    def quads(self, approach: float) -> IntArray:
        """As `facets`, quadrilaterals of a tread made by `grid_mesh`."""
        self.facets(approach)
        return self._quads

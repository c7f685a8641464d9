"""Which facets can touch: broad phase with trimesh and FCL.

FCL answers only the question "which facets come near"; distances, depths and normals are
computed elsewhere in double precision from smooth geometry. The query is
``fcl.collide(BVH, Box)`` with the BVH first, because only the first object's facet numbers are
returned, against boxes that enclose strips of the other body's surface. The BVH is built once
on the undeformed surface; the bodies' relative position enters through a transform.
"""

import fcl
import numpy as np
import trimesh
from numpy.typing import NDArray

from contactstudy.exceptions import InputError

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]


def grid_surface(x: Array, y: Array, z: Array) -> trimesh.Trimesh:
    """Triangulate a surface z(x, y) given on a rectangular grid.

    Quadrilateral ``q = i*(ny-1) + j`` becomes the triangles ``2q`` and ``2q + 1``.

    Parameters
    ----------
    x, y : ndarray (nx,), (ny,)
        Grid lines in m.
    z : ndarray (nx, ny)
        Heights in m.

    Returns
    -------
    trimesh.Trimesh
        With nodes ``i*ny + j``, unprocessed (numbers are kept), normals up.
    """
    nx, ny = len(x), len(y)
    X, Y = np.meshgrid(x, y, indexing="ij")
    vertices = np.stack([X, Y, np.asarray(z)], axis=-1).reshape(-1, 3)
    node = np.arange(nx * ny).reshape(nx, ny)
    a, b, c, d = node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2).reshape(-1, 3)
    return trimesh.Trimesh(vertices, faces, process=False)


class FacetSearch:
    """Finds the facets of one surface that meet given boxes.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Surface; kept as it is.

    Raises
    ------
    InputError
        If the mesh has no facets.
    """

    def __init__(self, mesh: trimesh.Trimesh) -> None:
        if len(mesh.faces) == 0:
            raise InputError("contact search: the surface has no facets")
        self.mesh = mesh
        self.model = bounding_volumes(mesh)
        self._object = fcl.CollisionObject(self.model, fcl.Transform())

    def meeting(self, boxes: Array, offset: Array | None = None) -> IntArray:
        """Facets that meet any of some axis-aligned boxes.

        Parameters
        ----------
        boxes : ndarray (m, 2, 3)
            Lower and upper corners in m.
        offset : ndarray (3,), optional
            Position of the surface relative to the boxes' axes in m.

        Returns
        -------
        ndarray of int
            Triangle numbers, sorted, each once.
        """
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


def bounding_volumes(mesh: trimesh.Trimesh) -> "fcl.BVHModel":
    """FCL's bounding volume hierarchy of a triangulated surface."""
    model = fcl.BVHModel()
    model.beginModel(len(mesh.vertices), len(mesh.faces))
    model.addSubModel(np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces))
    model.endModel()
    return model


def strip_boxes(mesh: trimesh.Trimesh, y: Array, padding: float, depth: float = 0.0) -> Array:
    """Boxes around the strips of a running surface between neighbouring lines y.

    A box over the whole crown would be flat and let in every facet of a cylindrical tread;
    strips follow the curvature.

    Parameters
    ----------
    mesh : trimesh.Trimesh
        Running surface with vertices on the lines.
    y : ndarray (ny,)
        Lines in m.
    padding : float
        Enlargement on all sides in m.
    depth : float
        Further enlargement downwards in m, for facets that already lie below the surface.

    Returns
    -------
    ndarray (ny-1, 2, 3)
        Lower and upper corners.
    """
    v = np.asarray(mesh.vertices)
    boxes = np.empty((len(y) - 1, 2, 3))
    for k in range(len(y) - 1):
        strip = v[(v[:, 1] >= y[k] - 1e-9) & (v[:, 1] <= y[k + 1] + 1e-9)]
        boxes[k] = strip.min(axis=0) - padding, strip.max(axis=0) + padding
    boxes[:, 0, 2] -= depth
    return boxes


class CandidateList:
    """Facets of the tread that can touch, kept until the bodies have moved (a Verlet list).

    A list made for the approach d holds every quadrilateral of the tread that comes within the
    padding of the rail's surface. It serves all approaches up to ``d + padding``, and is made
    anew as well when the approach has fallen so far that it is needlessly long.

    Parameters
    ----------
    wheel : FacetSearch
        Tread as made by `grid_surface`, lowest point of the smooth tread at z = 0.
    rail : trimesh.Trimesh
        Running surface under the wheel, top at z = 0.
    rail_y : ndarray
        Its lines in y, in m.
    sagitta : float
        Largest distance between facets and smooth surface, both bodies together, in m.
    padding : float
        In m.
    """

    def __init__(
        self,
        wheel: FacetSearch,
        rail: trimesh.Trimesh,
        rail_y: Array,
        sagitta: float,
        padding: float = 20e-6,
    ) -> None:
        self._wheel, self._rail, self._rail_y = wheel, rail, np.asarray(rail_y)
        self._margin, self._padding = padding + sagitta, padding
        self._made_for = np.nan
        self._quads = np.empty(0, dtype=np.int64)
        self.queries = 0

    def quads(self, approach: float) -> IntArray:
        """Quadrilaterals of the tread that can touch at a rigid approach.

        Parameters
        ----------
        approach : float
            How far the undeformed wheel stands below the first touch of the smooth surfaces,
            in m; with irregularity its largest value over the patch.

        Returns
        -------
        ndarray of int
            Sorted; the same object as long as the list is the same.
        """
        if -2 * self._padding <= approach - self._made_for <= self._padding:
            return self._quads
        boxes = strip_boxes(self._rail, self._rail_y, self._margin, max(approach, 0.0))
        triangles = self._wheel.meeting(boxes, np.array([0.0, 0.0, -approach]))
        self._quads = np.unique(triangles // 2)
        self._made_for = approach
        self.queries += 1
        return self._quads

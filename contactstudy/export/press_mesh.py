"""The static press as one plain finite-element mesh: rail slices and ring slices as hexahedra.

Node for node the mesh that `track.unreduced.UnreducedTrack` and `solids.wheel.elastic_wheel`
compute with; nothing is condensed. Axes are those of the track: X along the rail, Y lateral (to
the field side), Z up; the origin is the crown in the middle of the rail. The bodies just touch, by
their smooth profiles, wherever the position of the wheel has them touch.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.export.hexahedra import Hexahedra, rail_hexahedra, wheel_hexahedra
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.solids.mapped import on_mirror
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.validation import raise_if

# corners of the six faces of a hexahedron, in the order in which CalculiX and Abaqus count them
FACES = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))


@dataclass(frozen=True)
class PressMesh:
    """Rail and wheel as hexahedra; nodes and elements are counted from 0 through both.

    Attributes
    ----------
    nodes : ndarray (n, 3)
        In track axes, m.
    rail, wheel : ndarray of int (m, 8)
        Elements: four corners, then the four opposite ones; positive Jacobian.
    symmetric : bool
        Only the half y >= 0 is there.
    symmetry : ndarray of int
        Nodes on y = 0 of a half model; none of a whole one.
    rail_ends : ndarray of int
        Nodes of the two clamped planes.
    bore : ndarray of int
        Nodes of the wheel's bore, which moves as one.
    running_surface, tread : ndarray of int (k, 2)
        Faces that may touch: element (the wheel's follow the rail's) and index into `FACES`.
    tread_nodes : ndarray of int (mx, my)
        Nodes of the tread's faces, on the grid of the wheel's contact zone.
    """

    nodes: Array
    rail: IntArray
    wheel: IntArray
    symmetric: bool
    symmetry: IntArray
    rail_ends: IntArray
    bore: IntArray
    running_surface: IntArray
    tread: IntArray
    tread_nodes: IntArray

    @property
    def elements(self) -> IntArray:
        """All elements, the rail's first."""
        return np.vstack([self.rail, self.wheel])

    def corner_nodes(self, faces: IntArray) -> IntArray:
        """Nodes (k, 4) of faces (k, 2)."""
        return np.asarray(self.elements[faces[:, :1], np.array(FACES)[faces[:, 1]]])

    def corners(self, faces: IntArray) -> Array:
        """Corner coordinates (k, 4, 3) of faces (k, 2) in m."""
        return np.asarray(self.nodes[self.corner_nodes(faces)])

    def places(self, faces: IntArray) -> tuple[IntArray, IntArray]:
        """Intervals (k,) along and across of faces of the tread on the grid `tread_nodes`."""
        my, place = self.tread_nodes.shape[1], np.full(len(self.nodes), -1)
        place[self.tread_nodes.ravel()] = np.arange(self.tread_nodes.size)
        first = place[self.corner_nodes(faces)].min(axis=1)
        return first // my, first % my


def press_mesh(
    cell: CellRecipe, wheel: WheelRecipe, length: float, geometry: Geometry | None = None
) -> PressMesh:
    """Mesh the wheel in the middle of a rail of a given length [m], a whole number of slices.

    Rail and wheel are of the same kind of section, half or whole. The geometry is the position of
    the wheel, of the very profiles that are meshed; a half model is centred and upright and needs
    none.

    Raises
    ------
    InputError
        If the slices do not divide the length, the rail is shorter than the contact zone, or the
        sections and the position do not belong together.
    """
    thickness = cell.thickness
    slices = round(length / thickness)
    problems = _contradictions(cell, wheel, geometry)
    if abs(slices * thickness - length) > 1e-9 * length:
        problems.append(
            f"rail length = {length:g} m: must be a whole number of slices of {thickness:g} m"
        )
    yaw = 0.0 if geometry is None else abs(np.sin(geometry.pose.yaw))
    across = wheel.contact_half_width + abs(wheel.contact_centre)
    reach = float(wheel.x[-1]) + across * yaw + 2 * thickness
    if length < 4 * reach:
        problems.append(
            f"rail length = {length:g} m: must be at least {4 * reach:.4g} m, twice the contact "
            "zone of the wheel"
        )
    raise_if(problems)
    rail, ring = rail_hexahedra(cell, slices), wheel_hexahedra(wheel)
    nodes = _placed(rail, ring, geometry or Geometry.of(wheel))
    first = len(rail.nodes)
    elements, tread = ring.elements + first, ring.surface + first
    under = rail.surface[np.abs(rail.nodes[rail.surface, 0]) <= reach + 0.5 * thickness]
    return PressMesh(
        nodes=nodes,
        rail=rail.elements,
        wheel=elements,
        symmetric=cell.symmetric,
        symmetry=on_mirror(nodes[:, 1:], cell.symmetric),
        rail_ends=rail.held,
        bore=ring.held + first,
        running_surface=_faces(rail.elements, under),
        tread=_faces(elements, tread) + np.array([len(rail.elements), 0]),
        tread_nodes=tread,
    )


def _contradictions(cell: CellRecipe, wheel: WheelRecipe, geometry: Geometry | None) -> list[str]:
    """What does not belong together."""
    problems, kinds = [], {True: "half", False: "whole"}
    if cell.symmetric != wheel.symmetric:
        problems.append(
            f"symmetric: the rail is a {kinds[cell.symmetric]} section, the wheel a "
            f"{kinds[wheel.symmetric]} one; both must be the same"
        )
    elif geometry is None and not cell.symmetric:
        problems.append("geometry: must be given for whole sections")
    elif geometry is not None and cell.symmetric and geometry.pose != Pose():
        problems.append("geometry: a half model is centred and upright; mesh whole sections")
    if wheel.rail_profile != cell.profile:
        problems.append(
            f"wheel made for rail {wheel.rail_profile}, rail {cell.profile}: must be the same"
        )
    if geometry is None:
        return problems
    given = geometry.rail.name, geometry.wheel.name, geometry.radius
    meshed = cell.profile, wheel.curve.name, wheel.dimensions.radius
    what = "geometry's rail", "geometry's wheel", "geometry's radius in m"
    return problems + [
        f"{name} = {g}: must be what is meshed, {m}"
        for name, g, m in zip(what, given, meshed, strict=True)
        if g != m
    ]


def _placed(rail: Hexahedra, wheel: Hexahedra, geometry: Geometry) -> Array:
    """Nodes of both bodies in track axes."""
    pose = geometry.pose
    lower = np.column_stack([rail.nodes[:, 0], pose.track_of_rail(rail.nodes[:, 1:])])
    # the tape circle's lowest point level with the crown, then down to the first touch
    upper = wheel.nodes @ pose.to_track.T + [0.0, pose.lateral, -geometry.touch.travel]
    return np.vstack([lower, upper])


def _faces(elements: IntArray, nodes: IntArray) -> IntArray:
    """Faces (element, face) all of whose corners are among the nodes."""
    chosen = np.isin(elements, nodes)
    found = [
        np.column_stack([hits, np.full(len(hits), face)])
        for face, corners in enumerate(FACES)
        if len(hits := np.flatnonzero(chosen[:, corners].all(axis=1)))
    ]
    if not found:
        raise InputError("press mesh: no face of the elements lies on the contact surface")
    return np.vstack(found)

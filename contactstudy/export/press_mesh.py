"""The static press as one plain finite-element mesh: rail slices and ring slices as hexahedra.

Node for node the mesh that `track.unreduced.UnreducedTrack` and `solids.wheel.elastic_wheel`
compute with; nothing is condensed. Half model y >= 0. The wheel's lowest point touches the crown
in the middle of the rail, which is the origin: X along the rail, Y lateral, Z up.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contactstudy.exceptions import InputError
from contactstudy.solids.cell import section_of
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.validation import raise_if

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]

# corners of the six faces of a hexahedron, in the order in which CalculiX and Abaqus count them
FACES = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))


@dataclass(frozen=True)
class PressMesh:
    """Rail and wheel as hexahedra; nodes and elements are counted from 0 through both.

    Attributes
    ----------
    nodes : ndarray (n, 3)
        In m.
    rail, wheel : ndarray of int (m, 8)
        Elements: four corners, then the four opposite ones; positive Jacobian.
    symmetry : ndarray of int
        Nodes on y = 0.
    rail_ends : ndarray of int
        Nodes of the two clamped planes.
    bore : ndarray of int
        Nodes of the wheel's bore, which moves as one.
    running_surface, tread : ndarray of int (k, 2)
        Faces that may touch: element (the wheel's follow the rail's) and index into `FACES`.
    """

    nodes: Array
    rail: IntArray
    wheel: IntArray
    symmetry: IntArray
    rail_ends: IntArray
    bore: IntArray
    running_surface: IntArray
    tread: IntArray

    @property
    def elements(self) -> IntArray:
        """All elements, the rail's first."""
        return np.vstack([self.rail, self.wheel])

    def corners(self, faces: IntArray) -> Array:
        """Corner coordinates (k, 4, 3) of faces (k, 2) in m."""
        nodes = self.elements[faces[:, :1], np.array(FACES)[faces[:, 1]]]
        return np.asarray(self.nodes[nodes])


def press_mesh(cell: CellRecipe, wheel: WheelRecipe, length: float) -> PressMesh:
    """Mesh the wheel in the middle of a rail.

    Parameters
    ----------
    cell : CellRecipe
        Mesh of the rail; with the symmetric half section.
    wheel : WheelRecipe
    length : float
        Of the rail in m, a whole number of slices.

    Returns
    -------
    PressMesh

    Raises
    ------
    InputError
        If the slices do not divide the length, the rail is shorter than the contact zone, or the
        section is not the half one.
    """
    thickness = cell.length / cell.n_slices
    slices, problems = round(length / thickness), []
    if abs(slices * thickness - length) > 1e-9 * length:
        problems.append(
            f"rail length = {length:g} m: must be a whole number of slices of {thickness:g} m"
        )
    reach = float(wheel.x[-1]) + 2 * thickness
    if length < 4 * reach:
        problems.append(
            f"rail length = {length:g} m: must be at least {4 * reach:.4g} m, twice the contact "
            "zone of the wheel"
        )
    if not (cell.symmetric and wheel.symmetric):
        problems.append("symmetric = False: only the half model y >= 0 can be exported")
    if wheel.rail_profile != cell.profile:
        problems.append(
            f"wheel made for rail {wheel.rail_profile}, rail {cell.profile}: must be the same"
        )
    raise_if(problems)
    rail_nodes, rail, rail_ends, surface = _rail(cell, slices, thickness)
    wheel_nodes, ring, bore, tread = _wheel(wheel)
    first = len(rail_nodes)
    nodes = np.vstack([rail_nodes, wheel_nodes])
    ring, bore, tread = ring + first, bore + first, tread + first
    running = _faces(rail, surface[np.abs(rail_nodes[surface, 0]) <= reach + 0.5 * thickness])
    return PressMesh(
        nodes=nodes,
        rail=rail,
        wheel=ring,
        symmetry=np.flatnonzero(np.abs(nodes[:, 1]) < 1e-12),
        rail_ends=rail_ends,
        bore=bore,
        running_surface=running,
        tread=_faces(ring, tread) + np.array([len(rail), 0]),
    )


def _rail(
    cell: CellRecipe, slices: int, thickness: float
) -> tuple[Array, IntArray, IntArray, IntArray]:
    """Nodes, elements, nodes of the end planes, nodes of the fine running surface."""
    section, _, _ = section_of(cell)
    n, planes = len(section.nodes), np.arange(slices + 1)
    nodes = np.empty((len(planes), n, 3))
    nodes[:, :, 0] = (thickness * (planes - 0.5 * slices))[:, None]
    nodes[:, :, 1:] = section.nodes
    q = section.quads
    # corners 0 3 7 4 on one plane, 1 2 6 5 on the next, as `solids.extrusion.extrude`
    element = np.stack([q[:, 0], q[:, 0] + n, q[:, 1] + n, q[:, 1]], axis=1)
    element = np.hstack([element, np.stack([q[:, 3], q[:, 3] + n, q[:, 2] + n, q[:, 2]], axis=1)])
    elements = (element[None] + n * planes[:-1, None, None]).reshape(-1, 8)
    ends = np.r_[np.arange(n), n * slices + np.arange(n)]
    return nodes.reshape(-1, 3), elements, ends, (n * planes[:, None] + section.surface).ravel()


def _wheel(recipe: WheelRecipe) -> tuple[Array, IntArray, IntArray, IntArray]:
    """Nodes, elements, nodes of the bore, nodes of the fine tread."""
    section, right = recipe.section(), recipe.angles
    angles = np.concatenate([-right[-2:0:-1], right])  # the top, at pi, is there once
    n, planes = len(section.nodes), np.arange(len(angles))
    y, rho = section.nodes.T
    nodes = np.empty((len(angles), n, 3))
    nodes[:, :, 0] = np.sin(angles)[:, None] * rho
    nodes[:, :, 1] = y
    nodes[:, :, 2] = recipe.dimensions.radius - np.cos(angles)[:, None] * rho
    following = np.roll(planes, -1)
    # quads turn counter-clockwise in (y, rho), which looks along -X at the bottom
    q = section.quads
    elements = np.concatenate(
        [
            n * following[:, None, None] + q[None],
            n * planes[:, None, None] + q[None],
        ],
        axis=2,
    ).reshape(-1, 8)
    fine = np.flatnonzero(np.abs(angles) <= right[len(recipe.x) // 2] * (1 + 1e-9))
    tread = (n * fine[:, None] + section.tread).ravel()
    return nodes.reshape(-1, 3), elements, (n * planes[:, None] + section.bore).ravel(), tread


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

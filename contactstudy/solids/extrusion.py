"""One slice of a prismatic body: a section mesh extruded by one hexahedron."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.chain import Slice
from contactstudy.solids.hexahedron import hex_mass, hex_stiffness
from contactstudy.solids.section_mesh import SectionMesh


@dataclass(frozen=True)
class ExtrudedSlice:
    """Stiffness and mass of one slice on the free degrees of freedom of its two planes.

    Attributes
    ----------
    stiffness, mass : Slice
        Blocks in N/m and kg on (plane at x = 0, plane at x = thickness); of the WHOLE body in
        symmetric motion, where only half a section is meshed.
    thickness : float
        Extent along X in m.
    free : ndarray (n,)
        Degrees of freedom 3*node + component that a plane keeps (on a plane of symmetry
        the lateral displacement is left out).
    n_nodes : int
        Nodes of a plane.
    """

    stiffness: Slice
    mass: Slice
    thickness: float
    free: IntArray
    n_nodes: int


def extrude(
    section: SectionMesh,
    thickness: float,
    youngs_modulus: float,
    poisson_ratio: float,
    density: float,
) -> ExtrudedSlice:
    """Matrices of a slice, the plane (y, z) extruded along X by a thickness [m]; all in SI."""
    n = len(section.nodes)
    plane = np.c_[np.zeros(n), section.nodes]
    # hexahedron: corners 0 3 7 4 on the first plane, 1 2 6 5 on the second, counter-clockwise
    conn = np.empty((len(section.quads), 8), dtype=np.int64)
    conn[:, [0, 3, 7, 4]] = section.quads
    conn[:, [1, 2, 6, 5]] = section.quads + n
    coordinates = np.vstack([plane, plane + np.array([thickness, 0.0, 0.0])])[conn]
    factor = 2.0 if section.symmetric else 1.0
    dofs = (3 * conn[:, :, None] + np.arange(3)).reshape(len(conn), 24)
    fixed = 3 * section.plane_of_symmetry + 1
    free = np.setdiff1d(np.arange(3 * n), fixed)

    def assemble(elements: Array) -> Slice:
        A = np.zeros((6 * n, 6 * n))
        np.add.at(A, (dofs[:, :, None], dofs[:, None, :]), factor * elements)
        a, b = free, free + 3 * n
        return Slice(A[np.ix_(a, a)], A[np.ix_(a, b)], A[np.ix_(b, b)])

    return ExtrudedSlice(
        assemble(hex_stiffness(coordinates, youngs_modulus, poisson_ratio)),
        assemble(hex_mass(coordinates, density)),
        thickness,
        free,
        n,
    )

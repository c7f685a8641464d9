"""One slice of a solid of revolution, between two planes through its axis.

Components of a node in a plane are those of the plane's own axes: (radial outwards, y,
tangential in the sense of growing angle), so that the matrices of a slice depend on the angle
between its planes only.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, BoolArray
from contactstudy.solids.hexahedron import hex_mass, hex_stiffness
from contactstudy.solids.wheel_section import WheelSection


def slice_stiffness(
    section: WheelSection, angle: float, youngs_modulus: float, poisson_ratio: float
) -> sp.csr_array:
    """Stiffness (6n, 6n) [N/m] of a slice on the dofs of its two planes, one after the other.

    The angle between the planes is in rad, E in Pa; of both halves y where the section is
    symmetric.
    """
    K = hex_stiffness(_corners(section, angle), youngs_modulus, poisson_ratio)
    return _assembled(section, angle, K)


def slice_mass(section: WheelSection, angle: float, density: float) -> sp.csr_array:
    """Consistent mass of a slice in kg, as `slice_stiffness`; `density` in kg/m^3."""
    return _assembled(section, angle, hex_mass(_corners(section, angle), density))


@dataclass(frozen=True)
class SparseSlice:
    """Blocks (n, n) of a slice's stiffness in N/m, see `Slice`."""

    aa: sp.csr_array
    ab: sp.csr_array
    bb: sp.csr_array


def ring_slice(
    section: WheelSection,
    angle: float,
    youngs_modulus: float,
    poisson_ratio: float,
    free: BoolArray,
) -> SparseSlice:
    """Blocks of `slice_stiffness` on the free (3n,) degrees of freedom of both planes."""
    K = slice_stiffness(section, angle, youngs_modulus, poisson_ratio)
    a = np.flatnonzero(free)
    b = a + len(free)
    return SparseSlice(K[a][:, a], K[a][:, b], K[b][:, b])


def _corners(section: WheelSection, angle: float) -> Array:
    """Corners (m, 8, 3) of the elements in the first plane's axes (y, radial, tangential).

    Quads turn counter-clockwise in (y, radial), so the kernel wants this order.
    """
    y, rho = section.nodes.T
    planes = [
        np.stack([y, rho * np.cos(theta), rho * np.sin(theta)], axis=1) for theta in (0.0, angle)
    ]
    return np.concatenate([plane[section.quads] for plane in planes], axis=1)


def _assembled(section: WheelSection, angle: float, matrices: Array) -> sp.csr_array:
    n = len(section.nodes)
    elements = np.concatenate([section.quads, section.quads + n], axis=1)
    c, s = np.cos(angle), np.sin(angle)
    # (y, radial, tangential) of the first plane from (radial, y, tangential) of the second
    second = np.array([[0.0, 1.0, 0.0], [c, 0.0, -s], [s, 0.0, c]])
    first = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    T = np.zeros((24, 24))
    for node in range(8):
        T[3 * node : 3 * node + 3, 3 * node : 3 * node + 3] = first if node < 4 else second
    values = (2.0 if section.symmetric else 1.0) * (T.T @ matrices @ T)
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    rows = np.repeat(dofs, 24, axis=1).ravel()
    columns = np.tile(dofs, (1, 24)).ravel()
    return sp.csr_array(sp.coo_array((values.ravel(), (rows, columns)), shape=(6 * n, 6 * n)))

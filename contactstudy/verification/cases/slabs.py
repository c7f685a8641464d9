"""Boxes of hexahedra cut into slabs between planes of nodes: their stiffness and stresses."""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.hexahedron import hex_stiffness, strain_operators
from contactstudy.verification.cases.element_stress import hex_stress, nodal_stress


def _elements(ny: int, nz: int) -> IntArray:
    """Corner nodes of the elements between planes 0 and 1, (m, 8).

    Reference axes (xi, eta, zeta) lie along (y, depth, x), a right-handed triple. A plane's
    node index is ``iy*nz + iz``.
    """
    plane = np.arange(ny * nz).reshape(ny, nz)
    quads = np.stack(
        [plane[:-1, :-1], plane[1:, :-1], plane[1:, 1:], plane[:-1, 1:]], axis=-1
    ).reshape(-1, 4)
    return np.concatenate([quads, quads + ny * nz], axis=1)


def _corners(nodes: Array, elements: IntArray, k: int) -> Array:
    """Coordinates of the elements behind plane k, (m, 8, 3)."""
    return np.asarray(nodes[k : k + 2].reshape(-1, 3)[elements])


def slab_stiffness(nodes: Array, youngs_modulus: float, poisson_ratio: float) -> list[Array]:
    """Stiffness of every slab on its two planes; equally thick ones share one array.

    Parameters
    ----------
    nodes : ndarray (nx, ny, nz, 3)
        Positions (x, y, depth) on a rectangular grid [m].
    youngs_modulus, poisson_ratio : float
        Elastic constants, E in Pa.

    Returns
    -------
    list of ndarray (6 ny nz, 6 ny nz)
        nx - 1 of them [N/m]; dof ``3*(iy*nz + iz) + direction`` of the first plane, then of the
        second.
    """
    ny, nz = nodes.shape[1:3]
    elements, n = _elements(ny, nz), 3 * ny * nz
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    made: dict[float, Array] = {}
    slabs = []
    for k, thickness in enumerate(np.diff(nodes[:, 0, 0, 0]).round(12).tolist()):
        if thickness not in made:
            K = hex_stiffness(_corners(nodes, elements, k), youngs_modulus, poisson_ratio)
            made[thickness] = np.zeros((2 * n, 2 * n))
            np.add.at(made[thickness], (dofs[:, :, None], dofs[:, None, :]), K)
        slabs.append(made[thickness])
    return slabs


def slab_stress(
    nodes: Array, displacement: Array, youngs_modulus: float, poisson_ratio: float
) -> Array:
    """Stresses at the nodes, averaged over the elements about each.

    Parameters
    ----------
    nodes, youngs_modulus, poisson_ratio
        As in `slab_stiffness`.
    displacement : ndarray (nx, ny, nz, 3)
        [m].

    Returns
    -------
    ndarray (nx, ny, nz, 6)
        (xx, yy, zz, yz, zx, xy) in Pa in the axes (x, y, depth).
    """
    nx, ny, nz = nodes.shape[:3]
    elements, u = _elements(ny, nz), displacement.reshape(nx, -1, 3)
    gauss, volume = [], []
    for k in range(nx - 1):
        corners = _corners(nodes, elements, k)
        moved = u[k : k + 2].reshape(-1, 3)[elements]
        gauss.append(hex_stress(corners, moved, youngs_modulus, poisson_ratio))
        volume.append(strain_operators(corners)[2].sum(axis=1))
    numbers = np.concatenate([elements + k * ny * nz for k in range(nx - 1)])
    nodal = nodal_stress(np.concatenate(gauss), numbers, np.concatenate(volume), nx * ny * nz)
    return nodal.reshape(nx, ny, nz, 6)

"""Stresses of hexahedra at their Gauss points and nodes.

A stress is stored as (xx, yy, zz, yz, zx, xy) in Pa, tension positive.
"""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.hexahedron import GAUSS, elasticity_matrix, strain_operators


def hex_stress(
    coordinates: Array,
    displacement: Array,
    youngs_modulus: float,
    poisson_ratio: float,
    incompatible: bool = True,
) -> Array:
    """Stresses at the 2 x 2 x 2 Gauss points of hexahedra.

    With bubbles the strain is ``B u + H a``, where ``a = -Kaa^-1 Kau u`` is what
    `contactstudy.solids.hexahedron.hex_stiffness` has condensed out.

    Parameters
    ----------
    coordinates, displacement : ndarray (m, 8, 3)
        Of the corners in m.
    incompatible : bool
        Whether the elements have bubble modes; as in `hex_stiffness`.

    Returns
    -------
    ndarray (m, 8, 6)
        Gauss point a lies towards corner a.

    Raises
    ------
    InputError
        If an element is inverted or an elastic constant impossible.
    """
    D = elasticity_matrix(youngs_modulus, poisson_ratio)
    B, H, det = strain_operators(np.asarray(coordinates, dtype=float))
    u = np.asarray(displacement, dtype=float).reshape(len(B), 24)
    strain = np.einsum("mpsi,mi->mps", B, u)
    if incompatible:
        Kaa = np.einsum("mpsi,st,mptj,mp->mij", H, D, H, det, optimize=True)
        rhs = np.einsum("mpsi,st,mpt,mp->mi", H, D, strain, det, optimize=True)
        a = -np.linalg.solve(Kaa, rhs[:, :, None])[:, :, 0]
        strain += np.einsum("mpsi,mi->mps", H, a)
    return np.asarray(strain @ D)


def stress_at_nodes(
    corners: Array,
    displacement: Array,
    elements: IntArray,
    youngs_modulus: float,
    poisson_ratio: float,
) -> Array:
    """`nodal_stress` (n_nodes, 6) of elements (m, 8) whose corners (m, 8, 3) move so, in m."""
    gauss = hex_stress(corners, displacement, youngs_modulus, poisson_ratio)
    volume = strain_operators(corners)[2].sum(axis=1)
    return nodal_stress(gauss, elements, volume, int(elements.max()) + 1)


def nodal_stress(gauss: Array, quads: IntArray, volume: Array, n_nodes: int) -> Array:
    """Stresses at nodes: extrapolated from the Gauss points, averaged over the elements there.

    Parameters
    ----------
    gauss : ndarray (m, 8, 6)
        As `hex_stress` gives them.
    quads : ndarray of int (m, 8)
        Corner nodes of the elements.
    volume : ndarray (m,)
        Weight of an element in the average, its volume in m^3.

    Returns
    -------
    ndarray (n_nodes, 6)
        NaN at nodes of no element.
    """
    # the trilinear function through the Gauss points, at the corners: in Gauss coordinates a
    # corner lies at +-sqrt(3)
    corner = np.sign(GAUSS)
    E = np.prod(0.5 * (1 + np.sqrt(3.0) * corner[:, None, :] * corner[None, :, :]), axis=2)
    at_corners = np.einsum("ap,mps->mas", E, gauss)
    total, weight = np.zeros((n_nodes, gauss.shape[2])), np.zeros(n_nodes)
    np.add.at(total, quads, at_corners * volume[:, None, None])
    np.add.at(weight, quads, volume[:, None])
    with np.errstate(invalid="ignore"):
        return np.asarray(total / weight[:, None])

"""Stiffness and mass of eight-node hexahedra, for many elements at once.

Node order of an element (reference coordinates xi, eta, zeta = -1 or 1)::

    0 (-,-,-)  1 (+,-,-)  2 (+,+,-)  3 (-,+,-)  4 (-,-,+)  5 (+,-,+)  6 (+,+,+)  7 (-,+,+)

Degrees of freedom of an element: 3*node + component.
"""

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError

_CORNERS = np.array(
    [
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
    ],
    dtype=float,
)
GAUSS = _CORNERS / np.sqrt(3.0)
"""2 x 2 x 2 Gauss rule, weights 1: exact for the stiffness of a parallelepiped."""


def elasticity_matrix(youngs_modulus: float, poisson_ratio: float) -> Array:
    """Isotropic elasticity matrix (6, 6) [Pa] for the strains (xx, yy, zz, 2yz, 2zx, 2xy).

    E [Pa] must be positive, nu lie between -1 and 0.5 exclusive.

    Raises
    ------
    InputError
        If a constant is outside its range.
    """
    problems = []
    if not youngs_modulus > 0:
        problems.append(f"youngs_modulus = {youngs_modulus} Pa: must be positive")
    if not -1 < poisson_ratio < 0.5:
        problems.append(f"poisson_ratio = {poisson_ratio}: must lie between -1 and 0.5")
    if problems:
        raise InputError(problems)
    # Lame: lambda = E nu / ((1+nu)(1-2nu)), mu = E / (2(1+nu))
    lam = youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))
    mu = youngs_modulus / (2 * (1 + poisson_ratio))
    D = np.zeros((6, 6))
    D[:3, :3] = lam
    D[np.arange(3), np.arange(3)] += 2 * mu
    D[np.arange(3, 6), np.arange(3, 6)] = mu
    return D


def _shape(points: Array) -> tuple[Array, Array]:
    """Trilinear shape functions (p, 8) and their reference gradients (p, 8, 3) at points."""
    s = 1 + points[:, None, :] * _CORNERS[None]  # 1 + xi_a xi
    N = s.prod(axis=2) / 8
    dN = np.empty((len(points), 8, 3))
    for d in range(3):
        e, f = (d + 1) % 3, (d + 2) % 3
        dN[:, :, d] = _CORNERS[:, d] * s[:, :, e] * s[:, :, f] / 8
    return N, dN


def _strain(gradients: Array) -> Array:
    """Strain-displacement matrices (..., 6, 3k) of scalar gradients (..., k, 3)."""
    *lead, k, _ = gradients.shape
    B = np.zeros((*lead, 6, k, 3))
    gx, gy, gz = gradients[..., 0], gradients[..., 1], gradients[..., 2]
    B[..., 0, :, 0] = gx
    B[..., 1, :, 1] = gy
    B[..., 2, :, 2] = gz
    B[..., 3, :, 1], B[..., 3, :, 2] = gz, gy
    B[..., 4, :, 0], B[..., 4, :, 2] = gz, gx
    B[..., 5, :, 0], B[..., 5, :, 1] = gy, gx
    return B.reshape(*lead, 6, 3 * k)


def _jacobians(coordinates: Array, gradients: Array) -> tuple[Array, Array]:
    """Inverse Jacobians (m, p, 3, 3) and determinants (m, p); refuses inverted elements."""
    # J_ij = d x_j / d xi_i
    J = np.einsum("pai,maj->mpij", gradients, coordinates)
    det = np.linalg.det(J)
    if not np.all(det > 0):
        bad = int(np.argmin(det.min(axis=1)))
        raise InputError(f"mesh: element {bad} is inverted or degenerate (Jacobian <= 0)")
    return np.linalg.inv(J), det


def strain_operators(coordinates: Array) -> tuple[Array, Array, Array]:
    """Strains at the Gauss points for unit corner displacements and unit bubbles.

    Returns
    -------
    nodal : ndarray (m, 8, 6, 24)
        B of ``strain = B u``, of corners (m, 8, 3) [m].
    bubbles : ndarray (m, 8, 6, 9)
        H of the three quadratic bubble modes of each displacement component.
    determinant : ndarray (m, 8)
        Volume in m^3 that a Gauss point stands for.

    Raises
    ------
    InputError
        If an element is inverted.
    """
    _, dN = _shape(GAUSS)
    inverse, det = _jacobians(coordinates, dN)
    # grad N = J^-1 dN/dxi
    B = _strain(np.einsum("mpij,paj->mpai", inverse, dN))
    # Bubbles 1 - xi_d^2: gradient -2 xi_d e_d in the reference element, mapped with the
    # Jacobian of the element centre and scaled by det J0/det J, so that the integral of the
    # bubble strains vanishes and constant strains are reproduced exactly.
    _, dN0 = _shape(np.zeros((1, 3)))
    inverse0, det0 = _jacobians(coordinates, dN0)
    bubble = -2.0 * GAUSS[:, :, None] * np.eye(3)  # (p, bubble, direction)
    G = np.einsum("mij,pbj->mpbi", inverse0[:, 0], bubble) * (det0 / det)[:, :, None, None]
    return B, _strain(G), det


def hex_stiffness(
    coordinates: Array, youngs_modulus: float, poisson_ratio: float, incompatible: bool = True
) -> Array:
    """Element stiffness matrices (m, 24, 24) [N/m] of corners (m, 8, 3) [m], E in Pa.

    The incompatible ones add the three quadratic bubble modes of each displacement component
    (Wilson, with the correction of Taylor, Beresford and Wilson 1976, Int. J. Numer. Meth. Eng.
    10:1211, so that the patch test is passed). They remove the shear locking of the plain element
    in bending and cost nothing after the condensation.

    Raises
    ------
    InputError
        If an element is inverted or an elastic constant impossible.
    """
    D = elasticity_matrix(youngs_modulus, poisson_ratio)
    B, H, det = strain_operators(np.asarray(coordinates, dtype=float))
    K = np.einsum("mpsi,st,mptj,mp->mij", B, D, B, det, optimize=True)
    if not incompatible:
        return np.asarray(K)
    Kua = np.einsum("mpsi,st,mptj,mp->mij", B, D, H, det, optimize=True)
    Kaa = np.einsum("mpsi,st,mptj,mp->mij", H, D, H, det, optimize=True)
    # static condensation of the bubbles: K - Kua Kaa^-1 Kau
    K = K - Kua @ np.linalg.solve(Kaa, Kua.transpose(0, 2, 1))
    return np.asarray(0.5 * (K + K.transpose(0, 2, 1)))


def hex_mass(coordinates: Array, density: float) -> Array:
    """Consistent mass matrices (m, 24, 24) [kg] of corners (m, 8, 3) [m], density in kg/m^3."""
    coordinates = np.asarray(coordinates, dtype=float)
    N, dN = _shape(GAUSS)
    _, det = _jacobians(coordinates, dN)
    scalar = density * np.einsum("pa,pb,mp->mab", N, N, det)
    return np.asarray(np.einsum("mab,ij->maibj", scalar, np.eye(3)).reshape(-1, 24, 24))

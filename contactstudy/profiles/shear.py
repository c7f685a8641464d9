"""Timoshenko's shear coefficient after Cowper, from Saint-Venant's flexure on a mesh."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray

_GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)


@dataclass(frozen=True)
class IntegrationMesh:
    """Bilinear quadrilaterals with their 2 x 2 Gauss points.

    Parameters
    ----------
    n_nodes : int
        Number of nodes.
    quads : ndarray of int, shape (m, 4)
        Corner nodes.
    shape : ndarray, shape (4, 4)
        Shape functions, (point, corner).
    gradient : ndarray, shape (m, 4, 4, 2)
        Their gradients, (element, point, corner, direction) [1/m].
    weight : ndarray, shape (m, 4)
        Area of each point [m^2].
    point : ndarray, shape (m, 4, 2)
        Coordinates of the points [m].
    """

    n_nodes: int
    quads: IntArray
    shape: Array
    gradient: Array
    weight: Array
    point: Array


def integration_mesh(nodes: Array, quads: IntArray) -> IntegrationMesh:
    """Gauss points, weights and gradients of a mesh of nodes (n, 2) [m] and quads (m, 4)."""
    s, t = (a.ravel()[:, None] for a in np.meshgrid(_GAUSS, _GAUSS, indexing="ij"))
    si, ti = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
    shape = (1.0 + s * si) * (1.0 + t * ti) / 4.0
    local = np.stack([si * (1.0 + t * ti), ti * (1.0 + s * si)], axis=-1) / 4.0
    corners = nodes[quads]
    jacobian = np.einsum("gia,mib->mgab", local, corners)
    det = np.linalg.det(jacobian)
    regular = np.where(det[..., None, None] == 0.0, np.eye(2), jacobian)
    gradient = np.einsum("mgba,gia->mgib", np.linalg.inv(regular), local)
    point = np.einsum("gi,mid->mgd", shape, corners)
    return IntegrationMesh(len(nodes), quads, shape, gradient, det, point)


def shear_coefficient(
    mesh: IntegrationMesh,
    centroid: Array,
    direction: int,
    poisson_ratio: float,
    antisymmetry_nodes: IntArray | None = None,
) -> float:
    """Cowper's kappa for a shear force along one principal direction.

    Cowper (1966), J. Appl. Mech. 33:335. With a along the force and b across it, centroidal,
    I_a = int a^2 and I_b = int b^2,

        kappa = 2 (1+nu) I_a / [nu/2 (I_b - I_a) - (A/I_a) int a (chi + a b^2)],

    where chi is Love's flexure function: lap chi = 0, d chi/dn = -F.n on the boundary,
    F = (nu a^2/2 + (1 - nu/2) b^2, (2 + nu) a b).

    Parameters
    ----------
    mesh : IntegrationMesh
        Section, or one half of a section symmetric about y = 0 (the ratio is the same).
    centroid : ndarray, shape (2,)
        Centroid (y, z) of the whole section [m].
    direction : int
        0 for a force along y, 1 along z.
    poisson_ratio : float
        Poisson's ratio [-].
    antisymmetry_nodes : ndarray of int, optional
        Nodes on a plane of symmetry normal to the force, where chi is zero.

    Returns
    -------
    float
        Shear coefficient [-].
    """
    from scipy.sparse.linalg import splu

    nu, weight, grad = poisson_ratio, mesh.weight, mesh.gradient
    a = mesh.point[..., direction] - centroid[direction]
    b = mesh.point[..., 1 - direction] - centroid[1 - direction]
    along = nu * a * a / 2.0 + (1.0 - nu / 2.0) * b * b
    across = (2.0 + nu) * a * b
    # div F = 2 (1+nu) a turns the boundary term into an area integral, so no edges are needed:
    #   int grad chi.grad v = -int (F.grad v + 2 (1+nu) a v)   for all v
    load = -(
        np.einsum("mg,mgi->mi", weight * along, grad[..., direction])
        + np.einsum("mg,mgi->mi", weight * across, grad[..., 1 - direction])
        + 2.0 * (1.0 + nu) * np.einsum("mg,gi->mi", weight * a, mesh.shape)
    )
    stiffness = np.einsum("mgid,mgjd,mg->mij", grad, grad, weight)
    quads, n = mesh.quads, mesh.n_nodes
    rhs = np.bincount(quads.ravel(), load.ravel(), minlength=n)
    rows, cols = np.repeat(quads, 4, axis=1).ravel(), np.tile(quads, (1, 4)).ravel()
    matrix = sp.coo_array((stiffness.ravel(), (rows, cols)), shape=(n, n)).tocsc()
    # without a plane of antisymmetry chi is known up to a constant, which int a = 0 removes
    fixed = quads[:1, 0] if antisymmetry_nodes is None else antisymmetry_nodes
    free = np.setdiff1d(np.unique(quads), fixed)
    chi = np.zeros(n)
    chi[free] = splu(matrix[free][:, free]).solve(rhs[free])
    chi_point = np.einsum("gi,mi->mg", mesh.shape, chi[quads])
    area, inertia_a, inertia_b = weight.sum(), (weight * a * a).sum(), (weight * b * b).sum()
    flexure = (weight * a * (chi_point + a * b * b)).sum()
    bottom = nu / 2.0 * (inertia_b - inertia_a) - area / inertia_a * flexure
    return float(2.0 * (1.0 + nu) * inertia_a / bottom)

"""Saint-Venant's flexure and torsion on a mesh: Cowper's shear coefficient, torsion constant."""

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
    # without a plane of antisymmetry chi is known up to a constant, which int a = 0 removes
    chi = _harmonic(mesh, load, antisymmetry_nodes)
    chi_point = np.einsum("gi,mi->mg", mesh.shape, chi[mesh.quads])
    area, inertia_a, inertia_b = weight.sum(), (weight * a * a).sum(), (weight * b * b).sum()
    flexure = (weight * a * (chi_point + a * b * b)).sum()
    bottom = nu / 2.0 * (inertia_b - inertia_a) - area / inertia_a * flexure
    return float(2.0 * (1.0 + nu) * inertia_a / bottom)


def torsion_constant(mesh: IntegrationMesh, antisymmetry_nodes: IntArray | None = None) -> float:
    """Saint-Venant's J of a mesh of a section, or of its half y >= 0 [m^4].

    With the warping function, lap phi = 0 and d phi/dn = z n_y - y n_z on the boundary,

        J = int y^2 + z^2 dA - int |grad phi|^2 dA,

    about any pole; of a half the pole lies on its plane of symmetry. Elements give an upper bound.

    Parameters
    ----------
    mesh : IntegrationMesh
        Section, or one half of it.
    antisymmetry_nodes : ndarray of int, optional
        Nodes of a half on y = 0, where phi is zero.
    """
    y, z = np.moveaxis(mesh.point, -1, 0)
    # about a pole amid the section, lest both integrals be large
    z = z - (mesh.weight * z).sum() / mesh.weight.sum()
    if antisymmetry_nodes is None:
        y = y - (mesh.weight * y).sum() / mesh.weight.sum()
    # the vector (z, -y) has no divergence: its flux is int (z dv/dy - y dv/dz) dA
    turned = np.stack([z, -y], axis=-1)
    load = np.einsum("mg,mgd,mgid->mi", mesh.weight, turned, mesh.gradient)
    phi = _harmonic(mesh, load, antisymmetry_nodes)
    warping = (load * phi[mesh.quads]).sum()  # = int |grad phi|^2
    return float((mesh.weight * (y * y + z * z)).sum() - warping)


def _harmonic(mesh: IntegrationMesh, load: Array, zero: IntArray | None) -> Array:
    """Nodal values (n,) of u: int grad u.grad v = load(v), element by element (m, 4).

    Zero at nodes, or else at one, where only differences count.
    """
    from scipy.sparse.linalg import splu

    grad, quads, n = mesh.gradient, mesh.quads, mesh.n_nodes
    stiffness = np.einsum("mgid,mgjd,mg->mij", grad, grad, mesh.weight)
    rhs = np.bincount(quads.ravel(), load.ravel(), minlength=n)
    rows, cols = np.repeat(quads, 4, axis=1).ravel(), np.tile(quads, (1, 4)).ravel()
    matrix = sp.coo_array((stiffness.ravel(), (rows, cols)), shape=(n, n)).tocsc()
    fixed = quads[:1, 0] if zero is None else zero
    free = np.setdiff1d(np.unique(quads), fixed)
    values = np.zeros(n)
    values[free] = splu(matrix[free][:, free]).solve(rhs[free])
    return values

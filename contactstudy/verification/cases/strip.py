"""A strip of hexahedra in plane strain that acts as an elastic half-space under line loads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.hexahedron import hex_stiffness
from contactstudy.verification.cases.element_stress import stress_at_nodes
from contactstudy.verification.cases.point_loads import flamant


@dataclass(frozen=True)
class Strip:
    """Half of a strip, x >= 0, one element of unit thickness; node index ``ix*nz + iz``.

    Attributes
    ----------
    x, depth : ndarray (nx,), (nz,)
        Mesh lines in m from 0.
    youngs_modulus : float
        In Pa.
    """

    x: Array
    depth: Array
    youngs_modulus: float = 210e9
    poisson_ratio: float = 0.3

    def displacement(self, n_loaded: int) -> Array:
        """Displacement (nx, nz, 2, n_loaded) for unit loads on the first surface nodes.

        A load is the total over the node and its image, 1 N per metre of thickness.
        """
        nx, nz = len(self.x), len(self.depth)
        X, Z = np.meshgrid(self.x, self.depth, indexing="ij")
        outer = np.zeros((nx, nz), dtype=bool)
        outer[-1], outer[:, -1] = True, True
        fixed = np.repeat(outer[:, :, None], 2, axis=2)
        fixed[0, :, 0] = True
        u = np.zeros((nx, nz, 2, n_loaded))
        for k in range(n_loaded):
            for px in (self.x[k], -self.x[k]):  # on the axis twice the half
                u[outer, :, k] += 0.5 * flamant(X[outer] - px, Z[outer], *self._constants)
        # both faces of the strip move alike and not across: one pair of dofs for two corners
        corner = np.tile(self._quads(), 2)
        dofs = (2 * corner[:, :, None] + np.arange(2)).reshape(len(corner), -1)
        K = hex_stiffness(self._corners(), *self._constants).reshape(-1, 8, 3, 8, 3)
        K = K[:, :, [0, 2]][:, :, :, :, [0, 2]].reshape(-1, 16, 16)
        row, column = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
        A = coo_matrix((K.ravel(), (row.ravel(), column.ravel()))).tocsc()
        free, flat = np.flatnonzero(~fixed.ravel()), u.reshape(-1, n_loaded)
        load = np.zeros_like(flat)
        surface = 2 * nz * np.arange(n_loaded) + 1
        load[surface, np.arange(n_loaded)] = 0.5
        flat[free] = splu(A[free][:, free]).solve((load - A @ flat)[free])
        return u

    def stress(self, displacement: Array) -> Array:
        """Nodal stresses (nx, nz, 6) in Pa for a displacement (nx, nz, 2)."""
        quads, corners = self._quads(), self._corners()
        u = np.zeros((len(quads), 8, 3))
        u[:, :4, [0, 2]] = u[:, 4:, [0, 2]] = displacement.reshape(-1, 2)[quads]
        nodal = stress_at_nodes(corners, u, np.tile(quads, 2), *self._constants)
        return nodal.reshape(*displacement.shape[:2], 6)

    @property
    def _constants(self) -> tuple[float, float]:
        return self.youngs_modulus, self.poisson_ratio

    def _quads(self) -> IntArray:
        """Corners (m, 4) round the y axis by the right hand: depth before x."""
        nz = len(self.depth)
        node = np.arange(len(self.x) * nz).reshape(-1, nz)
        quads = np.stack([node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]], axis=-1)
        return quads.reshape(-1, 4)

    def _corners(self) -> Array:
        """Coordinates (m, 8, 3) of the elements between y = 0 and y = 1."""
        X, Z = np.meshgrid(self.x, self.depth, indexing="ij")
        plane = np.stack([X, 0 * X, Z], axis=-1).reshape(-1, 3)[self._quads()]
        return np.concatenate([plane, plane + np.array([0.0, 1.0, 0.0])], axis=1)

"""A finite block of hexahedra that acts as an elastic half-space.

The displacements of Boussinesq's point load are imposed on the outer faces of the block, for
each nodal load separately. What the block leaves out is thereby replaced by the exact far
field, and its flexibility can be held against Hertz's, whose bodies are half-spaces.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.solids.chain import BlockTridiagonal
from contactstudy.solids.hexahedron import hex_stiffness
from contactstudy.verification.cases.element_stress import stress_at_nodes
from contactstudy.verification.cases.point_loads import boussinesq


@dataclass(frozen=True)
class HalfSpacePatch:
    """Flexibility of surface nodes on a rectangular grid, node index ``ix*ny + iy``.

    Attributes
    ----------
    x, y : ndarray (nx,), (ny,)
        Grid lines in m.
    flexibility : ndarray (nx*ny, nx*ny)
        Inward displacement in m for unit inward force in N. With a symmetry plane a nodal
        force is the total over the node and its images.
    """

    x: Array
    y: Array
    flexibility: Array


def _images(point: tuple[float, float], symmetric: tuple[bool, bool]) -> list[tuple[float, float]]:
    xs = (point[0], -point[0]) if symmetric[0] else (point[0],)
    ys = (point[1], -point[1]) if symmetric[1] else (point[1],)
    return [(x, y) for x in xs for y in ys]


def _elements(ny: int, nz: int) -> IntArray:
    """Corner nodes (m, 8) of the elements between planes 0 and 1, node ``iy*nz + iz`` of each.

    Reference axes (xi, eta, zeta) lie along (y, depth, x), a right-handed triple.
    """
    plane = np.arange(ny * nz).reshape(ny, nz)
    quads = np.stack(
        [plane[:-1, :-1], plane[1:, :-1], plane[1:, 1:], plane[:-1, 1:]], axis=-1
    ).reshape(-1, 4)
    return np.concatenate([quads, quads + ny * nz], axis=1)


def _slab_stiffness(nodes: Array, youngs_modulus: float, poisson_ratio: float) -> list[Array]:
    """Stiffness of every slab on its two planes [N/m]; equally thick ones share one array."""
    ny, nz = nodes.shape[1:3]
    elements, n = _elements(ny, nz), 3 * ny * nz
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    made: dict[float, Array] = {}
    slabs = []
    for k, thickness in enumerate(np.diff(nodes[:, 0, 0, 0]).round(12).tolist()):
        if thickness not in made:
            corners = nodes[k : k + 2].reshape(-1, 3)[elements]
            K = hex_stiffness(corners, youngs_modulus, poisson_ratio)
            made[thickness] = np.zeros((2 * n, 2 * n))
            np.add.at(made[thickness], (dofs[:, :, None], dofs[:, None, :]), K)
        slabs.append(made[thickness])
    return slabs


class HalfSpaceBlock:
    """The block, factored: any loads on its surface, then stresses where they are wanted.

    Parameters
    ----------
    x_lines, y_lines, depth_lines : ndarray
        Mesh lines in m; ``depth_lines[0] = 0`` is the surface. A symmetry plane lies at the
        first line, which must then be 0.
    youngs_modulus : float
        In Pa.
    symmetric : tuple of bool
        Symmetry about x = 0 and y = 0.

    Attributes
    ----------
    nodes : ndarray (nx, ny, nz, 3)
        Positions (x, y, depth) in m.

    Raises
    ------
    InputError
        If a symmetry plane is not at 0.
    """

    def __init__(
        self,
        x_lines: Array,
        y_lines: Array,
        depth_lines: Array,
        youngs_modulus: float = 210e9,
        poisson_ratio: float = 0.3,
        symmetric: tuple[bool, bool] = (True, True),
    ) -> None:
        x, y, z = (np.asarray(v, dtype=float) for v in (x_lines, y_lines, depth_lines))
        for name, line, sym in (("x", x, symmetric[0]), ("y", y, symmetric[1])):
            if sym and line[0] != 0.0:
                raise InputError(
                    f"half-space block: {name} lines must start at 0 on a symmetry plane"
                )
        self._lines, self._symmetric = (x, y, z), symmetric
        self._constants = (youngs_modulus, poisson_ratio)
        self.nodes = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1)
        nx, ny, nz = self.nodes.shape[:3]
        self._slabs = _slab_stiffness(self.nodes, youngs_modulus, poisson_ratio)
        # what is fixed: the outer faces wholly, the symmetry planes in their normal
        fixed = np.zeros((nx, ny, nz, 3), dtype=bool)
        fixed[-1], fixed[:, -1], fixed[:, :, -1] = True, True, True
        fixed[0, :, :, slice(0, 1) if symmetric[0] else slice(None)] = True
        fixed[:, 0, :, slice(1, 2) if symmetric[1] else slice(None)] = True
        self._outer = fixed.all(axis=3)
        self._free = ~fixed.reshape(nx, 3 * ny * nz)
        self._keep = [k for k in range(nx) if self._free[k].any()]
        n = 3 * ny * nz
        diagonal, upper = [], []
        for k in self._keep:
            on = self._free[k]
            D = np.zeros((n, n))
            if k > 0:
                D += self._slabs[k - 1][n:, n:]
            if k < nx - 1:
                D += self._slabs[k][:n, :n]
            diagonal.append(D[np.ix_(on, on)])
            if k + 1 in self._keep:
                upper.append(self._slabs[k][:n, n:][np.ix_(on, self._free[k + 1])])
        self._factor = BlockTridiagonal(diagonal, upper)

    def _loaded(self, loaded: tuple[slice, slice]) -> tuple[IntArray, IntArray]:
        nx, ny = self.nodes.shape[:2]
        return np.arange(nx)[loaded[0]], np.arange(ny)[loaded[1]]

    def displacement(self, loaded: tuple[slice, slice], forces: Array) -> Array:
        """Displacements under nodal forces.

        Parameters
        ----------
        loaded : tuple of slice
            Lines in x and y that make the grid of loaded surface nodes; not on an outer face.
        forces : ndarray (nodes, k)
            Into the body in N; node index ``ix*ny + iy`` of the loaded grid. With a symmetry
            plane a force is the total over the node and its images.

        Returns
        -------
        ndarray (nx, ny, nz, 3, k)
            Along (x, y, depth) in m.
        """
        (nx, ny, nz), (ix, iy) = self.nodes.shape[:3], self._loaded(loaded)
        n, k_loads = 3 * ny * nz, forces.shape[1]
        # the far field of all loads, on wholly fixed nodes only
        x, y, _ = self._lines
        outer = self.nodes[self._outer]
        unit = np.zeros((len(outer), 3, len(ix) * len(iy)))
        for column, (i, j) in enumerate((i, j) for i in ix for j in iy):
            images = _images((x[i], y[j]), self._symmetric)
            for px, py in images:
                unit[:, :, column] += boussinesq(
                    outer[:, 0] - px, outer[:, 1] - py, outer[:, 2], *self._constants
                ) / len(images)
        u = np.zeros((nx, ny, nz, 3, k_loads))
        u[self._outer] = unit @ forces
        imposed = u.reshape(nx, n, k_loads)
        nodal = forces.reshape(len(ix), len(iy), k_loads) / len(
            _images((1.0, 1.0), self._symmetric)
        )
        # K_ff u_f = f - K_fs u_s, slab by slab
        rhs = np.zeros((nx, n, k_loads))
        rhs[np.ix_(ix, 3 * nz * iy + 2)] = nodal
        for k, A in enumerate(self._slabs):
            reaction = A @ np.concatenate([imposed[k], imposed[k + 1]])
            rhs[k] -= reaction[:n]
            rhs[k + 1] -= reaction[n:]
        solution = self._factor.solve([rhs[k][self._free[k]] for k in self._keep])
        for k, values in zip(self._keep, solution, strict=True):
            imposed[k][self._free[k]] = values
        return u

    def patch(self, loaded: tuple[slice, slice]) -> HalfSpacePatch:
        """Flexibility of a grid of surface nodes.

        Symmetrised; Betti's reciprocity holds up to the discretisation of the far field.
        """
        ix, iy = self._loaded(loaded)
        count = len(ix) * len(iy)
        u = self.displacement(loaded, np.eye(count))
        F = u[ix][:, iy, 0, 2].reshape(count, count)
        x, y, _ = self._lines
        return HalfSpacePatch(x[ix], y[iy], 0.5 * (F + F.T))

    def stress(self, displacement: Array) -> Array:
        """Stresses (nx, ny, nz, 6) in Pa at the nodes for a displacement (nx, ny, nz, 3) in m.

        Averaged over the elements about each node, in the axes (x, y, depth).
        """
        nx, ny, nz = self.nodes.shape[:3]
        elements = np.concatenate([_elements(ny, nz) + k * ny * nz for k in range(nx - 1)])
        nodes, moved = self.nodes.reshape(-1, 3), displacement.reshape(-1, 3)
        nodal = stress_at_nodes(nodes[elements], moved[elements], elements, *self._constants)
        return nodal.reshape(nx, ny, nz, 6)

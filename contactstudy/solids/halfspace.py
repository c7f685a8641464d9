"""A finite block of hexahedra that acts as an elastic half-space.

The displacements of Boussinesq's point load are imposed on the outer faces of the block, for
each nodal load separately. What the block leaves out is thereby replaced by the exact far
field, and its flexibility can be held against Hertz's, whose bodies are half-spaces.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contactstudy.exceptions import InputError
from contactstudy.solids.chain import BlockTridiagonal
from contactstudy.solids.hexahedron import hex_stiffness

Array = NDArray[np.float64]


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
    symmetric : tuple of bool
        Whether x = 0 and y = 0 are symmetry planes.
    """

    x: Array
    y: Array
    flexibility: Array
    symmetric: tuple[bool, bool]


def graded_lines(fine_length: float, size: float, total: float, growth: float = 1.35) -> Array:
    """Lines from 0: equal steps up to `fine_length`, then growing geometrically to `total`.

    Parameters
    ----------
    fine_length, size, total : float
        Lengths in m; the fine part is rounded up to whole steps.
    growth : float
        Ratio of neighbouring steps in the graded part (adjusted so that it ends at `total`).

    Returns
    -------
    ndarray (n,)
        Increasing coordinates in m.
    """
    if not (0 < size <= fine_length < total) or growth < 1:
        raise InputError(
            f"graded mesh: needs 0 < size ({size} m) <= fine length ({fine_length} m) < total "
            f"({total} m) and growth >= 1 ({growth})"
        )
    n = int(np.ceil(fine_length / size - 1e-9))
    fine = size * np.arange(n + 1)
    rest = total - fine[-1]
    # size * (q + q^2 + ... + q^m) = rest: m from the wanted growth, then q by bisection
    m = max(int(np.ceil(np.log1p(rest / size * (growth - 1) / growth) / np.log(growth))), 1)
    low, high = 1e-3, growth
    for _ in range(200):
        q = 0.5 * (low + high)
        if size * np.sum(q ** np.arange(1, m + 1)) < rest:
            low = q
        else:
            high = q
    steps = size * q ** np.arange(1, m + 1)
    return np.concatenate([fine, fine[-1] + rest * np.cumsum(steps) / steps.sum()])


def boussinesq(
    x: Array, y: Array, depth: Array, youngs_modulus: float, poisson_ratio: float
) -> Array:
    """Displacement of a half-space under a unit normal point load at the origin.

    Johnson, Contact Mechanics (1985), eq. (3.18), with R = |(x, y, depth)|::

        u_r = P/(4 pi G) [ r z/R^3 - (1 - 2 nu) r/(R (R + z)) ]
        u_z = P/(4 pi G) [ z^2/R^3 + 2 (1 - nu)/R ]

    Parameters
    ----------
    x, y, depth : ndarray (...)
        Position in m, depth positive into the body; not the origin.
    youngs_modulus, poisson_ratio : float
        Elastic constants, E in Pa.

    Returns
    -------
    ndarray (..., 3)
        Displacement along (x, y, depth) in m/N for a load into the body.
    """
    G = youngs_modulus / (2 * (1 + poisson_ratio))
    R = np.sqrt(x**2 + y**2 + depth**2)
    radial = depth / R**3 - (1 - 2 * poisson_ratio) / (R * (R + depth))
    u = np.stack([radial * x, radial * y, depth**2 / R**3 + 2 * (1 - poisson_ratio) / R], axis=-1)
    return np.asarray(u / (4 * np.pi * G))


def _images(point: tuple[float, float], symmetric: tuple[bool, bool]) -> list[tuple[float, float]]:
    xs = (point[0], -point[0]) if symmetric[0] else (point[0],)
    ys = (point[1], -point[1]) if symmetric[1] else (point[1],)
    return [(x, y) for x in xs for y in ys]


def half_space_patch(
    x_lines: Array,
    y_lines: Array,
    depth_lines: Array,
    loaded: tuple[slice, slice],
    youngs_modulus: float = 210e9,
    poisson_ratio: float = 0.3,
    symmetric: tuple[bool, bool] = (True, True),
) -> HalfSpacePatch:
    """Flexibility of the surface nodes of a half-space modelled by a finite block.

    Parameters
    ----------
    x_lines, y_lines, depth_lines : ndarray
        Mesh lines in m; ``depth_lines[0] = 0`` is the surface. A symmetry plane lies at the
        first line, which must then be 0.
    loaded : tuple of slice
        Lines in x and y that make the grid of loaded surface nodes; not on an outer face.
    youngs_modulus, poisson_ratio : float
        Elastic constants, E in Pa.
    symmetric : tuple of bool
        Symmetry about x = 0 and y = 0.

    Returns
    -------
    HalfSpacePatch
        Symmetrised; Betti's reciprocity holds up to the discretisation of the far field.
    """
    x, y, z = (np.asarray(v, dtype=float) for v in (x_lines, y_lines, depth_lines))
    for name, line, sym in (("x", x, symmetric[0]), ("y", y, symmetric[1])):
        if sym and line[0] != 0.0:
            raise InputError(f"half-space block: {name} lines must start at 0 on a symmetry plane")
    nx, ny, nz = len(x), len(y), len(z)
    ix, iy = np.arange(nx)[loaded[0]], np.arange(ny)[loaded[1]]
    # quantities a plane x = const: node index iy*nz + iz, z counted as depth
    Y, Z = np.meshgrid(y, z, indexing="ij")
    plane = np.arange(ny * nz).reshape(ny, nz)
    quads = np.stack(
        [plane[:-1, :-1], plane[1:, :-1], plane[1:, 1:], plane[:-1, 1:]], axis=-1
    ).reshape(-1, 4)
    slabs = []
    for k in range(nx - 1):
        c = np.empty((len(quads), 8, 3))
        # element axes (xi, eta, zeta) = (y, depth, x): a right-handed triple
        c[:, :4, 0], c[:, 4:, 0] = x[k], x[k + 1]
        c[:, :4, 1] = c[:, 4:, 1] = Y.ravel()[quads]
        c[:, :4, 2] = c[:, 4:, 2] = Z.ravel()[quads]
        K = hex_stiffness(c, youngs_modulus, poisson_ratio)
        n = 3 * ny * nz
        dofs = (
            3 * np.concatenate([quads, quads + ny * nz], axis=1)[:, :, None] + np.arange(3)
        ).reshape(-1, 24)
        A = np.zeros((2 * n, 2 * n))
        np.add.at(A, (dofs[:, :, None], dofs[:, None, :]), K)
        slabs.append(A)
    # what is fixed: the outer faces wholly, the symmetry planes in their normal
    n = 3 * ny * nz
    fixed = np.zeros((nx, ny, nz, 3), dtype=bool)
    fixed[-1], fixed[:, -1], fixed[:, :, -1] = True, True, True
    if symmetric[0]:
        fixed[0, :, :, 0] = True
    else:
        fixed[0] = True
    if symmetric[1]:
        fixed[:, 0, :, 1] = True
    else:
        fixed[:, 0] = True
    free = ~fixed.reshape(nx, n)
    # far field of every loaded node, on fixed degrees of freedom only
    X3, Y3, Z3 = np.meshgrid(x, y, z, indexing="ij")
    outer = fixed.all(axis=3)
    far = np.zeros((nx, ny, nz, 3, len(ix) * len(iy)))
    for column, (i, j) in enumerate((i, j) for i in ix for j in iy):
        images = _images((x[i], y[j]), symmetric)
        for px, py in images:
            far[outer, :, column] += boussinesq(
                X3[outer] - px, Y3[outer] - py, Z3[outer], youngs_modulus, poisson_ratio
            ) / len(images)
    imposed = far.reshape(nx, n, -1)
    share = 1.0 / len(_images((1.0, 1.0), symmetric))
    diagonal, upper, rhs = [], [], []
    for k in range(nx):
        D = np.zeros((n, n))
        b = np.zeros((n, imposed.shape[2]))
        if k > 0:
            D += slabs[k - 1][n:, n:]
            b -= slabs[k - 1][n:, :n] @ imposed[k - 1]
        if k < nx - 1:
            D += slabs[k][:n, :n]
            b -= slabs[k][:n, n:] @ imposed[k + 1]
            upper.append(slabs[k][:n, n:][np.ix_(free[k], free[k + 1])])
        b -= D @ imposed[k]
        if k in ix:
            first = int(np.flatnonzero(ix == k)[0]) * len(iy)
            b[3 * plane[iy, 0] + 2, first + np.arange(len(iy))] += share
        diagonal.append(D[np.ix_(free[k], free[k])])
        rhs.append(b[free[k]])
    keep = [k for k in range(nx) if free[k].any()]
    solution = BlockTridiagonal([diagonal[k] for k in keep], [upper[k] for k in keep[:-1]]).solve(
        [rhs[k] for k in keep]
    )
    F = np.empty((len(ix) * len(iy), imposed.shape[2]))
    for row, k in enumerate(ix):
        u = np.zeros((n, imposed.shape[2]))
        u[free[k]] = solution[keep.index(k)]
        F[row * len(iy) : (row + 1) * len(iy)] = u[3 * plane[iy, 0] + 2]
    return HalfSpacePatch(x[ix], y[iy], 0.5 * (F + F.T), symmetric)

"""One rail cell condensed to a superelement, with residual flexibility at its surface."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.profiles.rail import rail_profile
from contactstudy.solids.chain import Slice
from contactstudy.solids.extrusion import ExtrudedSlice, extrude
from contactstudy.solids.held_cell import HeldCell
from contactstudy.solids.interface import interface_basis
from contactstudy.solids.mapped import Grading
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.section_mesh import SectionMesh, rail_section_mesh
from contactstudy.solids.section_rows import SectionRows, section_rows
from contactstudy.solids.window import MARGIN, window_response


@dataclass(frozen=True)
class RailCell:
    """A condensed cell; coordinates are (left interface, internal modes, right interface).

    Slices are counted from the cell's left end, nodes of the running surface by y. All
    matrices stand for the whole rail, also if only half of it was meshed.

    Attributes
    ----------
    stiffness, mass : ndarray (nd, nd)
        In N/m and kg.
    surface_y, surface_arc : ndarray (ny,)
        Lateral positions of the running-surface nodes, and their arc lengths from the crown,
        in m.
    surface_map : ndarray (ns + 1, ny, nd)
        Displacement of the surface nodes along the outward normal.
    centre_map, foot_map : ndarray (ns + 1, nm, nd)
        Mean motions of the section and of the foot's underside, see `SectionRows`.
    residual : ndarray ((2*ns + 1)*ny, (2*ns + 1)*ny)
        Flexibility in m/N of the surface nodes of two neighbouring cells that the reduced
        cells leave out.
    centre_residual : ndarray (2*ns + 1, nm, (2*ns + 1)*ny)
        What surface loads add to the section's motions beyond the reduced cells, in m/N, the
        roll in rad/N.
    centre_compliance : ndarray (2, ns + 1)
        What a load spread over the section adds to that section's mean displacement, and to the
        next one's, beyond the reduced cells, in m/N (no next one for the last).
    section_map : ndarray (2*k, m)
        Displacements (y, z in turn) of the k nodes of an interface plane.
    section_residual : ndarray (2*k, (2*ns + 1)*ny)
        What surface loads on two cells add to those of the plane between them, in m/N.
    """

    recipe: CellRecipe
    stiffness: Array
    mass: Array
    surface_y: Array
    surface_arc: Array
    surface_map: Array
    centre_map: Array
    foot_map: Array
    residual: Array
    centre_residual: Array
    centre_compliance: Array
    section_map: Array
    section_residual: Array


GROWTH = 1.5
"""Ratio of neighbouring element sizes away from the running surface."""


def section_mesh_of(recipe: CellRecipe) -> SectionMesh:
    """Section mesh of a recipe."""
    return rail_section_mesh(
        rail_profile(recipe.profile),
        Grading(recipe.size, recipe.coarse, GROWTH),
        recipe.contact_centre,
        recipe.contact_half_width,
        recipe.symmetric,
    )


def section_of(recipe: CellRecipe) -> tuple[SectionMesh, ExtrudedSlice, SectionRows]:
    """Section mesh, one slice and the plane's functionals of a recipe."""
    section = section_mesh_of(recipe)
    piece = extrude(
        section,
        recipe.thickness,
        recipe.youngs_modulus,
        recipe.poisson_ratio,
        recipe.density,
    )
    return section, piece, section_rows(section, rail_profile(recipe.profile), piece)


def condense(recipe: CellRecipe) -> RailCell:
    """Condense one cell of a rail.

    Raises
    ------
    InputError
        If the mesh cannot be built.
    NumericalError
        If a pivot of the elimination is not positive definite.
    """
    _, piece, rows = section_of(recipe)
    ns, ny, m = recipe.n_slices, len(rows.surface_y), recipe.interface_modes
    held = HeldCell(piece, ns)
    response = window_response(held, rows)
    basis = interface_basis(response, rows, piece.free % 3 == 0, m)
    shapes = _cell_shapes(held, basis, recipe.internal_modes)
    stiffness = _project(piece.stiffness, shapes)
    mass = _project(piece.mass, shapes)
    surface_map = np.stack([rows.surface @ T for T in shapes])
    centre_map = np.stack([rows.centre @ T for T in shapes])
    foot_map = np.stack([rows.foot @ T for T in shapes])

    # residual = exact window flexibility - flexibility of the same window of reduced cells
    F = _reduced_window(stiffness, m)
    pair_surface = pair_rows(surface_map, m)
    pair_centre = pair_rows(centre_map, m)
    exact = _by_reflection(response.surface, ns, ny)
    exact_centre = _by_reflection(response.centre, ns, ny)
    S = pair_surface.reshape(-1, F.shape[0])
    residual = exact.reshape(S.shape[0], -1) - S @ F @ S.T
    # the second of the two cells; its exact values are those of the first, mirrored
    own = pair_centre[ns:, 0]
    reduced_own = own @ F @ own.T
    centre_compliance = np.zeros((2, ns + 1))
    centre_compliance[0] = response.own_centre[0, ::-1] - np.diag(reduced_own)
    centre_compliance[1, :-1] = response.own_centre[1, -2::-1] - np.diag(reduced_own, 1)
    # the same for all nodes of the plane between the two cells, for drawing the section
    plane = _by_reflection(response.interfaces[None, 2, :, : (ns + 1) * ny], ns, ny)[0]
    drawn = _transverse(piece)
    centre_residual = exact_centre - pair_centre @ (F @ S.T)
    return RailCell(
        recipe,
        stiffness,
        mass,
        rows.surface_y,
        rows.surface_arc,
        surface_map,
        centre_map,
        foot_map,
        0.5 * (residual + residual.T),
        centre_residual,
        centre_compliance,
        drawn @ basis,
        drawn @ plane - drawn @ basis @ (F @ S.T)[len(stiffness) - m : len(stiffness)],
    )


def _cell_shapes(held: HeldCell, basis: Array, n_internal: int) -> list[Array]:
    """Displacement of every plane for unit coordinates: constraint and fixed-interface modes."""
    n, m = basis.shape
    # interior of the constraint modes: K_ii u_i = -K_ib Psi
    rhs = [np.zeros((n, 2 * m)) for _ in range(held.n_slices - 1)]
    rhs[0][:, :m] -= held.coupling.T @ basis
    rhs[-1][:, m:] -= held.coupling @ basis
    interior = held.solve(rhs)
    modes = _fixed_interface_modes(held, n_internal)
    left = np.hstack([basis, np.zeros((n, n_internal + m))])
    right = np.hstack([np.zeros((n, m + n_internal)), basis])
    inner = [np.hstack([u[:, :m], v, u[:, m:]]) for u, v in zip(interior, modes, strict=True)]
    return [left, *inner, right]


def _fixed_interface_modes(held: HeldCell, count: int) -> list[Array]:
    """Lowest vibration modes of a cell with both interfaces held (Craig and Bampton 1968)."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    n, ns, M = len(held.mirror), held.n_slices, held.piece.mass
    if count == 0:
        return [np.zeros((n, 0))] * (ns - 1)
    eye = sp.identity(ns - 1)
    shift = sp.diags_array(np.ones(ns - 2), offsets=1, shape=(ns - 1, ns - 1))
    coupling = sp.kron(shift, sp.csr_array(M.ab))
    mass = (sp.kron(eye, sp.csr_array(M.bb + M.aa)) + coupling + coupling.T).tocsr()

    def solve(b: Array) -> Array:
        return np.concatenate(held.solve(list(b.reshape(ns - 1, n, 1)))).ravel()

    N = mass.shape[0]
    _, V = eigsh(
        LinearOperator((N, N), matvec=lambda x: x, dtype=float),
        k=count,
        M=mass,
        sigma=0.0,
        OPinv=LinearOperator((N, N), matvec=solve, dtype=float),
        v0=np.cos(np.arange(N)),
    )
    V = V * np.sign(V[np.abs(V).argmax(axis=0), np.arange(count)])
    return list(V.reshape(ns - 1, n, count))


def _project(matrix: Slice, shapes: list[Array]) -> Array:
    """Sum over the slices of T^T A T."""
    aa, ab, bb = (sp.csr_array(block) for block in (matrix.aa, matrix.ab, matrix.bb))
    total = np.zeros((shapes[0].shape[1],) * 2)
    for A, B in pairwise(shapes):
        cross = A.T @ (ab @ B)
        total += A.T @ (aa @ A) + B.T @ (bb @ B) + cross + cross.T
    return 0.5 * (total + total.T)


def _reduced_window(stiffness: Array, m: int) -> Array:
    """Flexibility of the clamped window of reduced cells on the coordinates of its middle pair."""
    cells, step = 2 * MARGIN + 2, len(stiffness) - m
    K = np.zeros((cells * step + m,) * 2)
    for c in range(cells):
        at = slice(c * step, c * step + len(stiffness))
        K[at, at] += stiffness
    inner = K[m:-m, m:-m]
    pair = slice(MARGIN * step - m, (MARGIN + 2) * step)
    rhs = np.zeros((len(inner), pair.stop - pair.start))
    rhs[pair] = np.eye(rhs.shape[1])
    return np.asarray(np.linalg.solve(inner, rhs)[pair])


def pair_rows(cell_map: Array, m: int) -> Array:
    """Rows (ns + 1, k, nd) of one cell as rows (2*ns + 1, k, 2*nd - m) of two neighbours.

    Both cells speak of the same interface on the middle plane; the second one's rows stand
    there.
    """
    planes, k, nd = cell_map.shape
    step = nd - m
    out = np.zeros((2 * planes - 1, k, 2 * step + m))
    out[: planes - 1, :, :nd] = cell_map[:-1]
    out[planes - 1 :, :, step:] = cell_map
    return out


def _transverse(piece: ExtrudedSlice) -> sp.csr_array:
    """Picks u_y, u_z of every node in turn from a plane's free degrees of freedom."""
    node, component = piece.free // 3, piece.free % 3
    kept = np.flatnonzero(component > 0)
    rows = 2 * node[kept] + component[kept] - 1
    shape = (2 * piece.n_nodes, len(piece.free))
    return sp.csr_array((np.ones(len(kept)), (rows, kept)), shape=shape)


def _by_reflection(response: Array, ns: int, ny: int) -> Array:
    """Responses to loads on all planes of the pair from those on its first half.

    The response of the mirrored plane is that to the mirrored load; axial components, which
    would change their sign, must not be used.
    """
    planes, k, _ = response.shape
    first = response.reshape(planes, k, ns + 1, ny)
    second = first[::-1, :, ns - 1 :: -1] if ns > 0 else first[:, :, :0]
    return np.concatenate([first, second], axis=2).reshape(planes, k, -1)

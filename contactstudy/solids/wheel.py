"""Elastic wheel: flexibility of its tread nodes in the contact zone.

The wheel is a solid of revolution, meshed by slices between planes through its axis. It does
not turn: an axisymmetric wheel looks the same at every angle, so only its bottom is meshed
finely. The bore is held: displacements are relative to the hub. The mirror symmetry about the
vertical plane x = 0 is used: each load is the sum of a symmetric and an antisymmetric one on
half the ring, and both are solved by block elimination over the angle.

By itself this wheel is quasi-static, with all its inertia in the vehicle model's wheel mass;
its elastic modes are in `wheel_modes`.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.profiles.named import rail_curve
from contactstudy.solids.chain import BlockTridiagonal, Slice, repeat
from contactstudy.solids.ring import SparseSlice, ring_slice
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.solids.wheel_section import WheelSection

__all__ = ["WheelFlexibility", "WheelRecipe", "elastic_wheel", "rigid_wheel"]


@dataclass(frozen=True)
class WheelFlexibility:
    """Elastic wheel as the contact sees it.

    Node ``ix*len(y) + iy`` of the tread lies at ``(x[ix], y[iy])``. Forces and displacements are
    along the contact normal, positive into the wheel (upwards): the rail's outward normal on a
    symmetric wheel, the wheel's own inward normal in the plane (y, z) on a whole one. On a
    symmetric wheel a nodal force is the total of the node and its mirror image about y = 0.

    Attributes
    ----------
    recipe : WheelRecipe
        What it was made from.
    x, y : ndarray (nx,), (ny,)
        Grid lines in m; y as `WheelRecipe.y`, an arc length on a whole wheel.
    flexibility : ndarray (n, n)
        Displacement relative to the hub in m/N.
    section_nodes : ndarray (k, 2)
        Section in the plane x = 0: y and the height z above the lowest point of the tape
        circle, in m; half of it where the wheel is symmetric.
    section_quads : ndarray of int (m, 4)
        Its quadrilaterals.
    section_response : ndarray (k, 2, n)
        Displacement (y, z) of the section relative to the hub for unit nodal forces in m/N.
    """

    recipe: WheelRecipe
    x: Array
    y: Array
    flexibility: Array
    section_nodes: Array
    section_quads: IntArray
    section_response: Array


def rigid_wheel(recipe: WheelRecipe) -> WheelFlexibility:
    """Wheel with the recipe's tread grid that does not deform."""
    section = recipe.section()
    n = len(recipe.x) * len(recipe.y)
    return WheelFlexibility(
        recipe,
        recipe.x,
        recipe.y,
        np.zeros((n, n)),
        _upright(recipe, section),
        section.quads,
        np.zeros((len(section.nodes), 2, n)),
    )


def elastic_wheel(recipe: WheelRecipe) -> WheelFlexibility:
    """Condense a wheel to its tread nodes in the contact zone."""
    section = recipe.section()
    held = held_dofs(section)
    near, far = _slices(recipe, section, ~held)
    n_loaded, ny = len(recipe.x) // 2 + 1, len(section.tread)
    loads = [b[:, ~held] for b in normal_loads(recipe, section, recipe.angles[:n_loaded])]
    mirror = np.tile([1.0, 1.0, -1.0], len(section.nodes))[~held]
    # displacements of the mirror image: the tangential ones change sign, or all others do
    even, odd = (_half_ring(near, far, loads, sign) for sign in (mirror, -mirror))
    rows = [
        np.concatenate([load @ u for load, u in zip(loads, half, strict=True)])
        for half in (even, odd)
    ]
    F = _unfold(rows[0], rows[1], n_loaded, ny)
    # plane x = 0: only the symmetric part moves in y and z; components there are
    # (radial outwards = down, y, tangential), see `ring`
    moved = np.zeros((3 * len(section.nodes), n_loaded * ny))
    moved[~held] = even[0]
    bottom = moved.reshape(len(section.nodes), 3, n_loaded, ny)
    response = np.stack([bottom[:, 1], -bottom[:, 0]], axis=1)
    response = np.concatenate([response[:, :, :0:-1], response], axis=2)
    return WheelFlexibility(
        recipe,
        recipe.x,
        recipe.y,
        0.5 * (F + F.T),
        _upright(recipe, section),
        section.quads,
        response.reshape(len(section.nodes), 2, -1),
    )


def _slices(
    recipe: WheelRecipe, section: WheelSection, free: BoolArray
) -> tuple[list[SparseSlice], Slice]:
    """Slices from the bottom up, and the arc over the top to the mirror image of the last plane."""
    steps = [round(float(step), 12) for step in np.diff(recipe.angles)]
    material = recipe.youngs_modulus, recipe.poisson_ratio
    pieces = {step: ring_slice(section, step, *material, free) for step in set(steps)}
    n_near = len(steps) - recipe.n_far
    last = pieces[steps[-1]]
    full = Slice(last.aa.toarray(), last.ab.toarray(), last.bb.toarray())
    far = repeat(full, 2 * recipe.n_far)
    return [pieces[step] for step in steps[:n_near]], far


def _half_ring(near: list[SparseSlice], far: Slice, loads: list[Array], sign: Array) -> list[Array]:
    """Displacements (n, planes * ny) of the loaded planes under the loads' part of one symmetry.

    Of unit forces (ny, n) at the tread nodes of each loaded plane; `sign` (n,) multiplies the
    mirror image's displacements.
    """
    n_loaded, ny, n = len(loads), len(loads[0]), len(sign)
    # half of the arc's energy belongs to this half of the ring
    top = 0.5 * (far.aa + far.ab * sign + sign[:, None] * far.ab.T + sign[:, None] * far.bb * sign)
    moving = np.flatnonzero(sign > 0)  # in the plane of symmetry itself
    diagonal: list[Array | sp.csr_array] = [near[0].aa[moving][:, moving]]
    diagonal += [a.bb + b.aa for a, b in pairwise(near)]
    diagonal.append(near[-1].bb + top)
    upper = [near[0].ab[moving]] + [piece.ab for piece in near[1:]]
    # from the top down, so that the loaded planes are eliminated last
    factor = BlockTridiagonal(diagonal[::-1], [ab.T for ab in upper[::-1]])
    rhs = [np.zeros((block.shape[0], n_loaded * ny)) for block in diagonal]
    for i, load in enumerate(loads):
        # half of the load belongs to this symmetry
        rhs[i][:, i * ny : (i + 1) * ny] = 0.5 * (load.T if i else load.T[moving])
    solution = factor.solve(rhs[::-1])[::-1]
    bottom = np.zeros((n, n_loaded * ny))
    bottom[moving] = solution[0]
    return [bottom, *solution[1:n_loaded]]


def held_dofs(section: WheelSection) -> BoolArray:
    """Degrees of freedom (3n,) of a plane that the hub and the symmetry in y hold."""
    held = np.zeros((len(section.nodes), 3), dtype=bool)
    held[section.bore] = True
    held[section.plane_of_symmetry, 1] = True
    return held.ravel()


def normal_loads(recipe: WheelRecipe, section: WheelSection, angles: Array) -> list[Array]:
    """Unit forces along the contact normal at the tread nodes, (ny, 3n) a plane."""
    if recipe.symmetric:
        rail = rail_curve(recipe.rail_profile)
        normal_y, normal_z = rail.normal(rail.arc_of_y(section.nodes[section.tread, 0])).T
    else:
        normal_y, normal_z = -recipe.curve.normal(recipe.y).T
    rows = np.arange(len(section.tread))
    loads = []
    for theta in angles:
        load = np.zeros((len(rows), 3 * len(section.nodes)))
        # up = -cos(theta) radial + sin(theta) tangential (theta grows from the bottom)
        load[rows, 3 * section.tread] = -np.cos(theta) * normal_z
        load[rows, 3 * section.tread + 1] = normal_y
        load[rows, 3 * section.tread + 2] = np.sin(theta) * normal_z
        loads.append(load)
    return loads


def _upright(recipe: WheelRecipe, section: WheelSection) -> Array:
    """Section nodes as (y, z), z up from the lowest point of the tape circle."""
    y, rho = section.nodes.T
    return np.stack([y, recipe.dimensions.radius - rho], axis=1)


def _unfold(even: Array, odd: Array, n: int, ny: int) -> Array:
    """Flexibility of the whole zone from its symmetric and antisymmetric halves (n lines each)."""
    right = np.arange(n - 1, 2 * n - 1)  # lines x >= 0 of the whole zone
    left = right[0] - np.arange(n)
    F = np.empty((2 * n - 1, ny, 2 * n - 1, ny))
    E, D = even.reshape(n, ny, n, ny), odd.reshape(n, ny, n, ny)
    for rows, columns, sign in (
        (right, right, 1),
        (left, right, -1),
        (right, left, -1),
        (left, left, 1),
    ):
        F[np.ix_(rows, np.arange(ny), columns, np.arange(ny))] = E + sign * D
    return F.reshape((2 * n - 1) * ny, -1)

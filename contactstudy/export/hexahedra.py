"""Rail and wheel as hexahedra in their own axes: rail slices, and slices of a ring."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.cell import section_mesh_of
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel_recipe import WheelRecipe


@dataclass(frozen=True)
class Hexahedra:
    """One meshed body.

    Attributes
    ----------
    nodes : ndarray (n, 3)
        In m.
    elements : ndarray of int (m, 8)
        Four corners, then the four opposite ones; positive Jacobian.
    held : ndarray of int
        Nodes of the rail's two end planes, or of the wheel's bore.
    surface : ndarray of int (planes, k)
        Nodes of the surface that may touch, by growing X and growing lateral position.
    """

    nodes: Array
    elements: IntArray
    held: IntArray
    surface: IntArray


def rail_hexahedra(cell: CellRecipe, slices: int) -> Hexahedra:
    """Piece of rail about X = 0, in the rail's own axes, its crown at the origin."""
    section = section_mesh_of(cell)
    n, planes = len(section.nodes), np.arange(slices + 1)
    nodes = np.empty((len(planes), n, 3))
    nodes[:, :, 0] = (cell.thickness * (planes - 0.5 * slices))[:, None]
    nodes[:, :, 1:] = section.nodes
    q = section.quads
    # corners 0 3 7 4 on one plane, 1 2 6 5 on the next, as `solids.extrusion.extrude`
    element = np.stack([q[:, 0], q[:, 0] + n, q[:, 1] + n, q[:, 1]], axis=1)
    element = np.hstack([element, np.stack([q[:, 3], q[:, 3] + n, q[:, 2] + n, q[:, 2]], axis=1)])
    elements = (element[None] + n * planes[:-1, None, None]).reshape(-1, 8)
    ends = np.r_[np.arange(n), n * slices + np.arange(n)]
    return Hexahedra(nodes.reshape(-1, 3), elements, ends, n * planes[:, None] + section.surface)


def wheel_hexahedra(recipe: WheelRecipe) -> Hexahedra:
    """Whole ring in the wheel's axes, the lowest point of its tape circle at the origin."""
    section, right = recipe.section(), recipe.angles
    angles = np.concatenate([-right[-2:0:-1], right])  # the top, at pi, is there once
    n, planes = len(section.nodes), np.arange(len(angles))
    y, rho = section.nodes.T
    nodes = np.empty((len(angles), n, 3))
    nodes[:, :, 0] = np.sin(angles)[:, None] * rho
    nodes[:, :, 1] = y
    nodes[:, :, 2] = recipe.dimensions.radius - np.cos(angles)[:, None] * rho
    following = np.roll(planes, -1)
    # quads turn counter-clockwise in (y, rho), which looks along -X at the bottom
    q = section.quads
    elements = np.concatenate(
        [
            n * following[:, None, None] + q[None],
            n * planes[:, None, None] + q[None],
        ],
        axis=2,
    ).reshape(-1, 8)
    fine = np.flatnonzero(np.abs(angles) <= right[len(recipe.x) // 2] * (1 + 1e-9))
    return Hexahedra(
        nodes.reshape(-1, 3),
        elements,
        (n * planes[:, None] + section.bore).ravel(),
        n * fine[:, None] + section.tread,
    )

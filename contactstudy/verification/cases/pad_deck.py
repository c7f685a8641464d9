"""A rail on pads as an input file of CalculiX, with every node of the mesh."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import NumericalError
from contactstudy.export.calculix import element_lines, node_lines, set_lines
from contactstudy.export.hexahedra import Hexahedra
from contactstudy.profiles.rail import rail_profile
from contactstudy.solids.cell import section_mesh_of
from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.model import Ballast, DiscreteSupports, Track

CELL = CellRecipe(size=0.004)
BALLAST = Ballast()
SUPPORT = DiscreteSupports(layer=BALLAST)
REACH = 0.012
"""m, half the length of the loaded patch."""
LOAD = 80e3


@dataclass(frozen=True)
class LoadedPatch:
    """Loaded nodes (k,) of the surface of a `Hexahedra`, and their shares of the load, sum 1.

    Normals (k, 2) are (y, z) outwards; a node's share is that of its mirror image as well.
    """

    x: float
    nodes: IntArray
    normals: Array
    shares: Array


def shares(x: Array, y: Array) -> Array:
    """Shares (nx, ny) of nodes at x from the patch's middle; a node and its mirror image count."""
    along = np.sqrt(np.clip(1 - (x / REACH) ** 2, 0.0, None))
    across = np.select([y < 1e-9, y < 2.5 * CELL.size], [1.0, 2.0], 0.0)
    share = along[:, None] * across
    return np.asarray(share / share.sum())


def loaded_patch(mesh: Hexahedra, x: float) -> LoadedPatch:
    """The same patch on the nodes of the mesh, whose first plane is at X = 0."""
    y = mesh.nodes[mesh.surface[0], 1]
    from_start = mesh.nodes[mesh.surface[:, 0], 0] - mesh.nodes[0, 0]
    share = shares(from_start - x, y)
    on = share > 0
    curve = rail_profile(CELL.profile).curve
    normals = np.broadcast_to(curve.normal(curve.arc_of_y(y)), (*share.shape, 2))
    return LoadedPatch(x, mesh.surface[on], normals[on], share[on])


def pad_deck(track: Track, mesh: Hexahedra, patches: Sequence[LoadedPatch]) -> Iterator[str]:
    """Lines of the file: pads, ballast, and one static step for each patch."""
    section, count = section_mesh_of(CELL), len(mesh.nodes)
    n = len(section.nodes)
    seats = track.support_positions
    # for each support a node that moves as the foot does on the mean, and one on the ballast
    extra = np.column_stack([np.repeat(seats, 2), np.zeros((2 * len(seats), 2))])
    yield from node_lines(np.concatenate([mesh.nodes, extra]))
    yield from element_lines("RAIL", mesh.elements, 1)
    yield from set_lines("ENDS", mesh.held)
    yield from set_lines("SUPPORTS", count + np.arange(len(extra)))
    planes = np.arange(len(mesh.surface))
    yield from set_lines("SYMMETRY", (n * planes[:, None] + section.plane_of_symmetry).ravel())
    first = len(mesh.elements) + 1
    for name, step in (("PADS", 2), ("BALLAST", 1)):
        yield f"*ELEMENT, TYPE=SPRING{step}, ELSET={name}"
        for j in range(len(seats)):
            foot, seat = count + 2 * j + 1, count + 2 * j + 2
            yield f"{first + j}, {foot}, {seat}" if step == 2 else f"{first + j}, {seat}"
        first += len(seats)
    # half a section carries half of each spring
    for name, dofs, k in (
        ("PADS", "3,3", SUPPORT.pad_stiffness),
        ("BALLAST", "3", BALLAST.stiffness),
    ):
        yield from (f"*SPRING, ELSET={name}", dofs, f"{0.5e-3 * k:.12e}")
    y = section.nodes[section.foot, 0]
    across = _trapezoid(y) / (y[-1] - y[0])
    x = np.asarray(CELL.thickness * planes, dtype=float)
    for j, seat in enumerate(seats):
        on = np.flatnonzero(np.abs(x - seat) <= 0.5 * SUPPORT.pad_length + 1e-9)
        along = _trapezoid(x[on]) / (x[on[-1]] - x[on[0]])
        weights = along[:, None] * across
        nodes = n * on[:, None] + section.foot
        # what is held does not move
        moving = ~np.isin(nodes, mesh.held)
        terms = zip((nodes[moving] + 1).tolist(), weights[moving].tolist(), strict=True)
        yield from ("*EQUATION", f"{np.count_nonzero(moving) + 1}")
        yield f"{count + 2 * j + 1}, 3, -1."
        yield from (f"{node}, 3, {weight:.15g}" for node, weight in terms)
    yield from ("*MATERIAL, NAME=STEEL", "*ELASTIC")
    yield f"{1e-6 * CELL.youngs_modulus:.12g}, {CELL.poisson_ratio:.12g}"
    yield "*SOLID SECTION, ELSET=RAIL, MATERIAL=STEEL"
    for i, patch in enumerate(patches):
        yield from set_lines(f"PATCH{i}", patch.nodes)
    yield from ("*BOUNDARY", "ENDS, 1, 3", "SYMMETRY, 2, 2", "SUPPORTS, 1, 2")
    for i, patch in enumerate(patches):
        yield from ("*STEP", "*STATIC", "*CLOAD, OP=NEW")
        half = 0.5 * LOAD * patch.shares[:, None] * patch.normals
        for node, (y_force, z_force) in zip(patch.nodes + 1, half.tolist(), strict=True):
            yield from (f"{node}, 2, {-y_force:.12g}", f"{node}, 3, {-z_force:.12g}")
        yield from (f"*NODE PRINT, NSET=PATCH{i}", "U", "*END STEP")


def _trapezoid(x: Array) -> Array:
    return np.asarray(0.5 * (np.diff(x, prepend=x[0]) + np.diff(x, append=x[-1])))


def read_stiffness(path: Path, patches: Sequence[LoadedPatch]) -> list[float]:
    """Stiffness at each patch [N/m] from the displacements of its nodes [mm]."""
    rows = [line.split() for line in path.read_text("ascii").splitlines()]
    found = np.array([row for row in rows if len(row) == 4 and row[0].isdigit()], dtype=float)
    stiffness = []
    for patch in patches:
        k = len(patch.nodes)
        place, found = found[:k], found[k:]
        if not np.array_equal(np.sort(place[:, 0]), np.sort(patch.nodes + 1)):
            raise NumericalError("CalculiX: displacements of the loaded nodes are missing")
        u = place[np.argsort(place[:, 0])][:, 2:]
        order = np.argsort(patch.nodes)
        down = -np.sum(patch.shares[order, None] * patch.normals[order] * u)
        stiffness.append(LOAD / (1e-3 * float(down)))
    return stiffness

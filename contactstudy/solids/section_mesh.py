"""Structured quadrilateral meshes of a rail's cross-section, for extrusion to hexahedra.

The right half of the section is three mapped blocks, head, web and foot. The columns of the
web run on through head and foot, so the mesh conforms; on the running surface the columns
stand at a fixed spacing in the fine zone and grow away from it. Where that zone goes round the
gauge corner the head's upper edge goes on down the side face.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.profiles.rail import RailProfile
from contactstudy.profiles.section import SectionProperties, section_properties
from contactstudy.solids.mapped import Grading, along, join, on_mirror, transfinite
from contactstudy.solids.section_outline import Outline, columns_of, fine_reach


@dataclass(frozen=True)
class SectionMesh:
    """A conforming mesh of bilinear quadrilaterals in the plane (y, z).

    Attributes
    ----------
    nodes : ndarray (n, 2)
        Coordinates y, z in m; z = 0 on top of the rail, up.
    quads : ndarray (m, 4)
        Corner nodes, counter-clockwise.
    surface : ndarray (k,)
        Nodes of the fine part of the running surface, ordered by y.
    foot : ndarray (f,)
        Nodes of the foot's underside, ordered by y.
    symmetric : bool
        True if only the half y >= 0 is meshed.
    """

    nodes: Array
    quads: IntArray
    surface: IntArray
    foot: IntArray
    symmetric: bool

    @property
    def plane_of_symmetry(self) -> IntArray:
        """Nodes on y = 0 of a half section (empty for a whole one)."""
        return on_mirror(self.nodes, self.symmetric)

    def properties(self, poisson_ratio: float) -> SectionProperties:
        """Area, second moments and shear coefficients of the WHOLE section, as meshed."""
        return section_properties(self.nodes, self.quads, poisson_ratio, symmetric=self.symmetric)


def rail_section_mesh(
    profile: RailProfile,
    grading: Grading,
    contact_centre: float = 0.0,
    contact_half_width: float = 0.010,
    symmetric: bool = True,
) -> SectionMesh:
    """Mesh a rail section, or its half y >= 0, fine at the running surface.

    The fine part reaches `contact_half_width` to both sides of `contact_centre`, an arc length from
    the crown [m], 0 if symmetric.

    Raises
    ------
    InputError
        If a size is not positive or too large for the section.
    """
    problems = []
    size, coarse, growth = grading.size, grading.coarse, grading.growth
    if not 0 < size <= 0.008:
        problems.append(f"mesh size = {size} m: must be above 0 and at most 0.008 m")
    if not 0 < contact_half_width <= 0.028:
        problems.append(
            f"contact_half_width = {contact_half_width} m: must be above 0 and at most 0.028 m"
        )
    if symmetric and contact_centre != 0.0:
        problems.append(f"contact_centre = {contact_centre} m: must be 0 m in a half section")
    if not size <= coarse <= 0.02:
        problems.append(f"coarse = {coarse} m: must be at least the mesh size, at most 0.02 m")
    if not 1.0 < growth <= 3.0:
        problems.append(f"growth = {growth}: must be above 1 and at most 3")
    if problems:
        raise InputError(problems)
    low, high = contact_centre - contact_half_width, contact_centre + contact_half_width
    reach = fine_reach(profile, size)
    if max(-low, high) > reach:
        raise InputError(
            f"contact_centre = {contact_centre} m, contact_half_width = {contact_half_width} m: "
            f"the fine zone must lie within {reach:.4f} m of the crown on both sides"
        )

    def half(low: float, high: float) -> SectionMesh:
        outline = Outline.of(profile, round_corner=False)
        if high > outline.top_length - size:
            outline = Outline.of(profile, round_corner=True)
        return _half(outline, grading, low, high)

    if symmetric:
        return half(-high, high)
    return _whole(half(-high, -low), half(low, high))


def _half(outline: Outline, grading: Grading, low: float, high: float) -> SectionMesh:
    """Right half, its running surface fine from arc length `low` to `high`."""
    side, coarse = outline.side, grading.coarse
    shoulder, head_corner, web_top, web_bottom, foot_top, foot_bottom = outline.marks
    web_half = side[web_top, 0]
    lines, fine = columns_of(grading, low, high, outline.top_length)
    # the columns next to the axis are the web's
    nw = min(max(2, int(np.argmin(np.abs(lines - web_half)))), len(lines) - 2)
    columns = lines / lines[-1]
    top = along(side[0 : shoulder + 1], columns)
    top[fine, 1] = outline.profile.curve.height(top[fine, 0])
    web_fraction = np.linspace(0.0, 1.0, nw + 1)

    def straight(z: float, half: float) -> Array:
        return np.stack([web_fraction * half, np.full(nw + 1, z)], axis=1)

    # head: rows grow downwards from the running surface
    depth = -side[web_top, 1]
    rows = grading.steps(depth, grading.size)
    head_rows = 1 - rows[::-1] / depth  # fractions from bottom to top
    under = side[head_corner : web_top + 1][::-1]
    share = (columns[nw:] - columns[nw]) / (columns[-1] - columns[nw])
    bottom = np.r_[straight(side[web_top, 1], web_half), along(under, share)[1:]]
    left = np.stack([np.zeros(len(rows)), side[web_top, 1] * (1 - head_rows)], axis=1)
    right = along(side[shoulder : head_corner + 1][::-1], head_rows)
    head = transfinite(bottom, top, left, right)

    # web
    height = side[web_top, 1] - side[web_bottom, 1]
    web_rows = np.linspace(0.0, 1.0, 1 + max(4, round(height / coarse)))
    web_right = along(side[web_top : web_bottom + 1][::-1], web_rows)
    web = np.stack([web_fraction * p[0] for p in web_right])
    web = np.stack([web, np.broadcast_to(web_right[:, 1:2], web.shape)], axis=2)

    # foot
    reach = side[foot_bottom, 0] - side[web_bottom, 0]
    n_foot = round(reach / coarse)
    share = np.linspace(0.0, 1.0, n_foot + 1)
    over = along(side[web_bottom : foot_top + 1], share)
    foot_top_edge = np.r_[straight(side[web_bottom, 1], side[web_bottom, 0]), over[1:]]
    flat = side[web_bottom, 0] + share * reach
    foot_edge = np.r_[straight(side[-1, 1], side[web_bottom, 0])[:, 0], flat[1:]]
    foot_low = np.stack([foot_edge, np.full(len(foot_edge), side[-1, 1])], axis=1)
    z0, z1 = side[-1, 1], side[web_bottom, 1]
    layers = np.linspace(0.0, 1.0, 1 + max(3, round((z1 - z0) / coarse)))
    foot_left = np.stack([np.zeros(len(layers)), z0 + layers * (z1 - z0)], axis=1)
    foot_right = along(side[foot_top : foot_bottom + 1][::-1], layers)
    foot = transfinite(foot_low, foot_top_edge, foot_left, foot_right)

    nodes, quads, ids = join(foot, web, head)
    return SectionMesh(nodes, quads, ids[2][-1, fine], ids[0][0], True)


def _whole(left: SectionMesh, right: SectionMesh) -> SectionMesh:
    """The whole section from two right halves, the first one mirrored; they share the axis."""
    n = len(right.nodes)
    heights = {round(float(right.nodes[i, 1]), 9): int(i) for i in right.plane_of_symmetry}
    image = np.empty(len(left.nodes), dtype=np.int64)
    axis = left.plane_of_symmetry
    image[axis] = [heights[round(float(z), 9)] for z in left.nodes[axis, 1]]
    others = np.setdiff1d(np.arange(len(left.nodes)), axis)
    image[others] = n + np.arange(len(others))
    nodes = np.vstack([right.nodes, left.nodes[others] * [-1.0, 1.0]])
    quads = np.vstack([right.quads, image[left.quads][:, ::-1]])

    def both(a: IntArray, b: IntArray) -> IntArray:
        ids = np.r_[image[a[::-1]], b]
        return ids[np.r_[True, np.diff(ids) != 0]]

    surface, foot = both(left.surface, right.surface), both(left.foot, right.foot)
    return SectionMesh(nodes, quads, surface, foot, False)

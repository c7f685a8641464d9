"""Two elastic half-spaces of the program's hexahedra, pressed together over a Hertzian gap."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.contact.augmented import Penalty
from contactstudy.contact.complementarity import PatchForces, contact_forces, press
from contactstudy.contact.groups import contact_area
from contactstudy.geometry.interpolation import SplineLine, grid_rows
from contactstudy.geometry.points import ContactPoints
from contactstudy.geometry.quadrature import Quadrature, grid_facets, point_line
from contactstudy.verification.cases.contact_ellipse import ContactEllipse, contact_ellipse
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.halfspace_block import HalfSpaceBlock

MARGIN = 2
"""Surface lines beyond the contact points, for the spline of the lower body."""
REACH = 1.25
"""Half lengths of the contact points' grid over the largest semi-axes."""
OUTER = 5.0
"""Distance of the outer faces from the centre over the longer of the largest semi-axes."""
GROWTH = 1.5
"""Ratio of neighbouring steps of the mesh outside of the fine part."""


@dataclass(frozen=True)
class BlockPress:
    """One solution.

    Attributes
    ----------
    load, approach : float
        Resultant in N, and approach in m.
    ellipse : ContactEllipse
        With the moments of the pressure.
    nodal_pressure : float
        Largest pressure at a node by the L2 projection, Pa.
    points : ContactPoints
        With their images in x < 0.
    gap : ndarray (n,)
        Of the deformed bodies at them, m.
    active : ndarray of bool (n,)
        Points in contact.
    """

    load: float
    approach: float
    ellipse: ContactEllipse
    nodal_pressure: float
    points: ContactPoints
    gap: Array
    active: BoolArray

    @property
    def area(self) -> float:
        """Of the patch in m^2, as the program reports it."""
        return contact_area(self.points, self.gap, self.active.astype(float))


@dataclass(frozen=True)
class Blocks:
    """A quarter of two blocks that touch at the origin.

    Attributes
    ----------
    points : ContactPoints
        In x >= 0 and y >= 0, each standing for its four images; the gap is x^2/2R_x + y^2/2R_y.
    flexibility : ndarray (n, n)
        Of both bodies together at the points, m/N, without the penalty.
    """

    points: ContactPoints
    flexibility: Array

    def press(self, load: float, penalty: float) -> BlockPress:
        """Press with a resultant in N."""
        solution = press(self._coupling(penalty), self.points.gap, self.points.normal_z, load)
        return self._described(solution, load, solution.approach)

    def crush(self, approach: float, penalty: float) -> BlockPress:
        """Press by an approach in m."""
        solution = contact_forces(self._coupling(penalty), self.points.gap - approach)
        return self._described(solution, float(solution.forces.sum()), approach)

    def _coupling(self, penalty: float) -> Array:
        return self.flexibility + np.diag(Penalty(penalty).compliance(self.points.area))

    def _described(self, solution: PatchForces, load: float, approach: float) -> BlockPress:
        points, n = self.points, len(self.points.x)
        gap = points.gap - approach + self.flexibility @ solution.forces
        # the images in x < 0 are put back; a line at x = 0 has none
        first = 1 if points.x[0] == 0.0 else 0

        def whole(values: Array) -> Array:
            grid = values.reshape(n, -1)
            return np.concatenate([grid[first:][::-1], grid]).ravel()

        share = np.where(points.x_of_points > 0.0, 0.5, 1.0)
        both = replace(
            points,
            x=np.concatenate([-points.x[first:][::-1], points.x]),
            area=whole(np.asarray(share * points.area)),
        )
        mirrored = whole(np.asarray(share * solution.forces))
        nodal = float(points.nodal_pressure(solution.forces).max())
        ellipse = contact_ellipse(both, mirrored)
        return BlockPress(load, approach, ellipse, nodal, both, whole(gap), mirrored > 0.0)


@cache
def blocks(
    semi_axes: tuple[float, float],
    elements: int,
    radii: tuple[float, float],
    youngs_modulus: float = 210e9,
    poisson_ratio: float = 0.3,
    quadrature: Quadrature = "gauss",
) -> Blocks:
    """Two equal half-spaces whose mesh has so many elements over each of the largest semi-axes.

    Parameters
    ----------
    semi_axes : tuple of float
        Largest semi-axes that the mesh must hold, along x and y, m.
    elements : int
        Elements over each; the element's sides are in the ratio of the semi-axes.
    radii : tuple of float
        Relative radii R_x, R_y of the gap, m.
    youngs_modulus : float
        Of both bodies, Pa.
    """
    outer = OUTER * max(semi_axes)
    n = round(REACH * elements)
    lines = []
    for axis in semi_axes:
        h = axis / elements
        lines.append(graded_lines((n + MARGIN) * h, h, outer + axis, GROWTH))
    h = min(semi_axes) / elements
    depth = graded_lines(0.75 * min(semi_axes), h, outer, GROWTH)
    loaded = slice(0, n + MARGIN + 1)
    block = HalfSpaceBlock(lines[0], lines[1], depth, youngs_modulus, poisson_ratio)
    patch = block.patch((loaded, loaded))
    points = block_points(patch.x[: n + 1], patch.y[: n + 1], radii, quadrature)
    size = len(patch.x) * len(patch.y)
    # lower body: spline through its surface nodes, mirrored in both planes; as in the program
    lower = np.kron(
        SplineLine(patch.x, mirrored=True)(points.x), SplineLine(patch.y, mirrored=True)(points.y)
    )
    # upper body: bilinear on the facets that carry the points
    row, column = np.divmod(points.wheel_rows.index, n + 1)
    upper = replace(points.wheel_rows, index=row * len(patch.y) + column).matrix(size)
    F = patch.flexibility
    return Blocks(points, lower @ F @ lower.T + upper @ F @ upper.T)


def block_points(
    x: Array, y: Array, radii: tuple[float, float], quadrature: Quadrature
) -> ContactPoints:
    """Contact points of the facets between the lines, over Hertz's paraboloid."""
    along, across = point_line(x, quadrature), point_line(y, quadrature)
    gap = along.at[:, None] ** 2 / (2 * radii[0]) + across.at[None, :] ** 2 / (2 * radii[1])
    area = 4.0 * along.weight[:, None] * across.weight[None, :]
    return ContactPoints(
        x=along.at,
        y=across.at,
        arc=across.at,
        wheel_x=x,
        wheel_y=y,
        gap=gap.ravel(),
        normal_z=np.ones(gap.size),
        area=area.ravel(),
        facet=grid_facets(along, across, len(y)),
        wheel_rows=grid_rows(along.rows, across.rows, len(y)),
        symmetric=True,
    )

"""Functionals of a section plane: surface normals, section mean, mean of the foot."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.profiles.rail import RailProfile
from contactstudy.solids.extrusion import ExtrudedSlice
from contactstudy.solids.section_mesh import SectionMesh


@dataclass(frozen=True)
class SectionRows:
    """Rows on the free degrees of freedom of one plane.

    Attributes
    ----------
    surface : ndarray (ny, n)
        Displacement of the fine running-surface nodes along the outward normal.
    surface_y, surface_arc : ndarray (ny,)
        Their lateral positions, and their arc lengths from the crown, in m.
    centre : ndarray (nm, n)
        Mean motion of the section, weighted by area: vertical displacement, the deflection
        that beam theory speaks of (Cowper 1966, J. Appl. Mech. 33:335), in m; for a whole
        section (nm = 3) also lateral displacement in m and roll about X in rad.
    foot : ndarray (nm, n)
        Mean motion of the foot's underside, all in m: vertical displacement; for a whole
        section also lateral displacement, and the rise of the edge y > 0 by roll.
    weights : ndarray (n,)
        Share of the section's area that belongs to each degree of freedom.
    rigid : ndarray (n, r)
        Beam kinematics of the plane: axial, vertical, rotation about Y; for a whole section
        also lateral, rotation about Z and about X.
    """

    surface: Array
    surface_y: Array
    surface_arc: Array
    centre: Array
    foot: Array
    weights: Array
    rigid: Array


def section_rows(section: SectionMesh, profile: RailProfile, piece: ExtrudedSlice) -> SectionRows:
    """Build the functionals of a plane from its mesh and the smooth profile."""
    n_nodes = len(section.nodes)
    y, z = section.nodes.T
    area = _nodal_areas(section)
    area /= area.sum()

    def row(nodes: IntArray, direction: int, values: Array) -> Array:
        full = np.zeros(3 * n_nodes)
        np.add.at(full, 3 * nodes + direction, values)
        return np.asarray(full[piece.free])

    everywhere = np.arange(n_nodes)
    arc = profile.curve.arc_of_y(y[section.surface])
    outward = profile.curve.normal(arc)[:, :, None]
    surface = np.stack(
        [
            row(node, 2, normal[1]) + row(node, 1, normal[0])
            for node, normal in zip(section.surface[:, None], outward, strict=True)
        ]
    )
    width = np.gradient(y[section.foot])
    width[[0, -1]] *= 0.5
    width /= width.sum()
    zc = float(area @ z)
    centre = [row(everywhere, 2, area)]
    foot = [row(section.foot, 2, width)]
    rigid = [
        row(everywhere, 0, np.ones(n_nodes)),
        row(everywhere, 2, np.ones(n_nodes)),
        row(everywhere, 0, -(z - zc)),
    ]
    if not section.symmetric:
        rigid += [
            row(everywhere, 1, np.ones(n_nodes)),
            row(everywhere, 0, -y),
            row(everywhere, 1, -(z - zc)) + row(everywhere, 2, y),
        ]
        # theta = integral(y u_z - (z - z_c) u_y) / integral(y^2 + (z - z_c)^2)
        polar = float(area @ (y**2 + (z - zc) ** 2))
        turn = row(everywhere, 2, area * y) - row(everywhere, 1, area * (z - zc))
        centre += [row(everywhere, 1, area), turn / polar]
        # slope of the regression of u_z over y, times half the width of the foot
        y_foot = y[section.foot]
        tilt = width * y_foot * (y_foot[-1] / float(width @ y_foot**2))
        foot += [row(section.foot, 1, width), row(section.foot, 2, tilt)]
    return SectionRows(
        surface=surface,
        surface_y=y[section.surface],
        surface_arc=arc,
        centre=np.stack(centre),
        foot=np.stack(foot),
        weights=np.repeat(area, 3)[piece.free],
        rigid=np.stack(rigid, axis=1),
    )


def _nodal_areas(section: SectionMesh) -> Array:
    """Area that belongs to each node: integral of its bilinear shape function."""
    g = np.array([-1.0, 1.0]) / np.sqrt(3.0)
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    points = section.nodes[section.quads]
    area = np.zeros(len(section.nodes))
    for xi in g:
        for eta in g:
            N = (1 + xi * corners[:, 0]) * (1 + eta * corners[:, 1]) / 4
            dN = np.stack(
                [
                    corners[:, 0] * (1 + eta * corners[:, 1]) / 4,
                    corners[:, 1] * (1 + xi * corners[:, 0]) / 4,
                ]
            )
            det = np.linalg.det(np.einsum("ia,maj->mij", dN, points))
            np.add.at(area, section.quads, det[:, None] * N)
    return area

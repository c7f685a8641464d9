"""Integration points on the flat faces of a wheel's tread over the flat faces of a rail."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.geometry.interpolation import Rows, grid_rows, linear_rows
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.quadrature import PointLine, grid_facets
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.track.stretch import RailStretch


@dataclass(frozen=True)
class FlatPoints:
    """Points on all faces of the tread.

    Attributes
    ----------
    gap : ndarray (n,)
        Along the normal of the rail's face in m, at first touch of the smooth bodies.
    normal : ndarray (n, 2)
        The rail's outward normal in track (Y, Z); Y is 0 in a half model, whose halves cancel.
    area : ndarray (n,)
        In m^2, of both halves of a half model.
    on_rail, on_wheel : ndarray (n, nodes)
        Displacement along the normals at the points from those at the nodes of the patch and of
        the tread.
    face : ndarray of int (n,)
        Face ``i*(my-1) + j`` of the tread that holds the point.
    """

    gap: Array
    normal: Array
    area: Array
    on_rail: Array
    on_wheel: Array
    face: IntArray

    def by_face(self, values: Array, shape: tuple[int, int]) -> Array:
        """Sums (mx - 1, my - 1) of values at the points over each face."""
        sums = np.bincount(self.face, values, shape[0] * shape[1])
        return np.asarray(sums.reshape(shape), dtype=float)


def flat_points(
    rail: RailStretch, wheel: WheelFlexibility, x: float, order: int, geometry: Geometry
) -> FlatPoints:
    """Points of a wheel on a rail at X = x [m].

    The faces of the wheel are bilinear between its nodes; those of the rail are the strips along X
    between the nodes of its section. Faces of both bodies meet at their ridges, where the pressure
    is not smooth, so the rule is taken between the lines of both.
    """
    corner = geometry.rail.point(rail.arc)
    across = gauss_line(wheel.y, order, _lines_opposite(geometry, wheel.y, rail.arc))
    along = gauss_line(wheel.x, order)
    on_wheel = _on_wheel(along.rows, across.rows, wheel)
    nodes = _tread(wheel, geometry)
    at = on_wheel @ nodes
    by_x = _on_wheel(slopes(wheel.x, along.rows), across.rows, wheel) @ nodes
    by_s = _on_wheel(along.rows, slopes(wheel.y, across.rows), wheel) @ nodes
    stretch = np.linalg.norm(np.cross(by_x, by_s), axis=1)

    edge = np.diff(corner, axis=0)
    length = np.hypot(*edge.T)
    tangent = edge / length[:, None]
    outward = np.column_stack([-tangent[:, 1], tangent[:, 0]])
    away = at[:, None, 1:] - corner[None, :-1]
    share = np.einsum("nkc,kc->nk", away, tangent) / length
    # the strip whose span holds the point, or the nearest to it beside a ridge
    strip = (np.maximum(np.maximum(-share, share - 1.0), 0.0) * length).argmin(axis=1)
    n = np.arange(len(at))
    t = np.clip(share[n, strip], 0.0, 1.0)
    lines = Rows(np.stack([strip, strip + 1], axis=1), np.stack([1.0 - t, t], axis=1))
    slices = linear_rows(rail.x - x, at[:, 0])
    normal, both = geometry.pose.track_of_rail(outward[strip]), 1.0
    if wheel.recipe.symmetric:
        normal, both = normal * [0.0, 1.0], 2.0
    index = slices.index[:, :, None] * len(corner) + lines.index[:, None, :]
    weight = slices.weight[:, :, None] * lines.weight[:, None, :]
    on_rail = Rows(index.reshape(len(at), -1), weight.reshape(len(at), -1))
    return FlatPoints(
        gap=np.einsum("nc,nc->n", away[n, strip], outward[strip]),
        normal=normal,
        area=both * np.outer(along.weight, across.weight).ravel() * stretch,
        on_rail=on_rail.matrix(len(rail.x) * len(corner)),
        on_wheel=on_wheel,
        face=grid_facets(along, across, len(wheel.y)).ravel(),
    )


def _tread(wheel: WheelFlexibility, geometry: Geometry) -> Array:
    """Nodes (mx*my, 3) of the tread in rail axes at first touch, in m."""
    # planes through the axle: x = rho sin(theta), the grid's x at the radius of its middle
    rho = geometry.radius - geometry.wheel.point(wheel.y)[:, 1]
    x = np.outer(wheel.x / wheel.recipe.contact_radius, rho).ravel()
    nodes, _ = geometry.placed.points_and_normals(x, np.tile(wheel.y, len(wheel.x)))
    nodes[:, 1:] -= geometry.touch.travel * geometry.pose.vertical
    return nodes


def _lines_opposite(geometry: Geometry, s: Array, arc: Array) -> Array:
    """Arc lengths on the wheel, within s, that lie opposite to the rail's lines (k,)."""
    fine = np.linspace(s[0], s[-1], 20 * len(s))
    feet = geometry.feet(fine)
    inside = (arc > feet[0]) & (arc < feet[-1])
    return np.interp(arc[inside], feet, fine)


def gauss_line(lines: Array, order: int, cuts: Array | None = None) -> PointLine:
    """Gauss points of every interval between grid lines, which `cuts` divide further."""
    ends = np.union1d(lines, np.empty(0) if cuts is None else cuts)
    node, share = np.polynomial.legendre.leggauss(order)
    step = np.diff(ends)[:, None]
    at = (ends[:-1, None] + 0.5 * step * (1.0 + node)).ravel()
    rows = linear_rows(lines, at)
    return PointLine(at, (0.5 * step * share).ravel(), rows, rows.index[:, :1])


def slopes(lines: Array, rows: Rows) -> Rows:
    """Derivative of what `rows` interpolate on the lines."""
    return Rows(rows.index, np.array([-1.0, 1.0]) / np.diff(lines[rows.index], axis=1))


def _on_wheel(along: Rows, across: Rows, wheel: WheelFlexibility) -> Array:
    return grid_rows(along, across, len(wheel.y)).matrix(len(wheel.flexibility))

"""Contact points: where the pressure is taken on the wheel, and the gap of smooth surfaces.

Coordinates: x along the rail relative to the wheel's lowest point, y lateral in the rail's
axes, z up. Points are Gauss points or nodes of the wheel's tread facets and travel with it. The
gap is never taken from facets: it is the distance between the smooth profiles in double precision.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.exceptions import InputError, NumericalError
from contactstudy.geometry.interpolation import Rows, grid_rows
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.quadrature import Quadrature, grid_facets, point_line

EDGE_KEYS = {"along": "contact_half_length", "across": "contact_half_width"}
"""Way in which a patch reaches the edge of its points -> key that is too small."""


class EdgeReachedError(NumericalError):
    """A patch reaches the edge of its points.

    Parameters
    ----------
    way : str
        A key of `EDGE_KEYS`.
    """

    def __init__(self, message: str, way: str = "along") -> None:
        super().__init__(message)
        self.way = way


@dataclass(frozen=True)
class ContactPoints:
    """Points on the wheel's tread over the running surface of the rail.

    The points form a product grid, index ``i*ny + j``; wheel nodes one, index ``i*my + j``.

    Attributes
    ----------
    x, y : ndarray (nx,), (ny,)
        Grid lines of the points in m; y of their feet in the rail's own axes.
    arc : ndarray (ny,)
        Arc length of these feet along the running surface from its crown in m, positive with
        y: the coordinate in which the rail's surface nodes are interpolated.
    wheel_x, wheel_y : ndarray (mx,), (my,)
        Grid lines of the wheel's tread nodes in m; `wheel_y` is an arc length on its profile.
    gap : ndarray (nx*ny,)
        Distance of the undeformed surfaces along the rail's normal, in m, for zero approach
        (wheel's tape circle just level with the top of rail) and no irregularity.
    normal_z : ndarray (nx*ny,)
        Vertical component of the rail's outward normal.
    area : ndarray (nx*ny,)
        Area on the rail's surface that a point stands for, in m^2; of both halves where the
        model is symmetric.
    facet : ndarray of int (nx*ny, k)
        Facets (quadrilaterals) of the wheel's tread grid, ``i*(my-1) + j``, that a point belongs
        to: the one around a Gauss point, the four around a node (at an edge named twice).
    wheel_rows : Rows
        Interpolation from the wheel's tread nodes, (nx*ny, 4) or, at nodes, (nx*ny, 1).
    symmetric : bool
        Only y >= 0 is modelled.
    """

    x: Array
    y: Array
    arc: Array
    wheel_x: Array
    wheel_y: Array
    gap: Array
    normal_z: Array
    area: Array
    facet: IntArray
    wheel_rows: Rows
    symmetric: bool

    @property
    def x_of_points(self) -> Array:
        """X of every point relative to the wheel, (nx*ny,) in m."""
        return np.repeat(self.x, len(self.y))

    @property
    def y_of_points(self) -> Array:
        """Y of every point, (nx*ny,) in m."""
        return np.tile(self.y, len(self.x))

    def edge_reached(self, active: BoolArray) -> str:
        """Way in which points in contact (n,) reach the edge: "along", "across" the rail or ""."""
        grid = active.reshape(len(self.x), -1)
        if grid[:, -1].any() or (not self.symmetric and grid[:, 0].any()):
            return "across"
        return "along" if grid[0].any() or grid[-1].any() else ""

    def nodal_pressure(self, forces: Array) -> Array:
        """Pressure (mx*my,) [Pa] at the wheel's tread nodes from forces (nx*ny,) [N] at points.

        The lumped L2 projection ``p_a = sum_i N_a(i) lam_i / sum_i N_a(i) A_i``. With a stiff
        penalty four points a facet follow what the nodes cannot, and their own pressures scatter
        about this one. Points at the nodes have ``lam_a / A_a``.
        """
        n = len(self.wheel_x) * len(self.wheel_y)
        load, area = np.zeros(n), np.zeros(n)
        np.add.at(load, self.wheel_rows.index, self.wheel_rows.weight * forces[:, None])
        np.add.at(area, self.wheel_rows.index, self.wheel_rows.weight * self.area[:, None])
        return load / area

    def semi_axes(self, forces: Array) -> dict[str, float]:
        """Semi-axes of the ellipse of Hertz with the pressure's second moments, by name, in m.

        ``<x^2> = a^2/5`` under Hertz's pressure. Integrals vary smoothly with the load; the
        outermost point in contact does not.
        """
        total = float(forces.sum())
        if total <= 0.0:
            return {"semi_axis_along": 0.0, "semi_axis_across": 0.0}
        lines = forces.reshape(len(self.x), len(self.y)) / total
        along, across = lines.sum(axis=1), lines.sum(axis=0)
        middle = 0.0 if self.symmetric else float(across @ self.arc)
        return {
            "semi_axis_along": float(np.sqrt(5 * (along @ (self.x - along @ self.x) ** 2))),
            "semi_axis_across": float(np.sqrt(5 * (across @ (self.arc - middle) ** 2))),
        }

    def listed(self, facets: IntArray) -> BoolArray:
        """Points (nx*ny,) that have one of these facets."""
        return np.asarray(np.isin(self.facet, facets).any(axis=1))


def contact_points(
    geometry: Geometry,
    wheel_x: Array,
    wheel_s: Array,
    quadrature: Quadrature = "gauss",
    symmetric: bool = False,
) -> ContactPoints:
    """Contact points of the wheel's tread facets over the rail.

    The gap is the signed distance of the wheel's surface of revolution from the rail's running
    surface. It is 0 at the first touch of the smooth surfaces, which need not be a point of the
    grid; a downward travel d from there closes it by ``d normal_z`` to first order.

    The interpolation on the rail is a product of x and arc: its lines are the feet of the wheel's
    lines where these come nearest to the rail (`PlacedWheel.locus`), and x is counted in the
    wheel's axes. With yaw both depend on the other coordinate a little (by ``yaw * distance`` from
    the touch); the gap is exact.

    Parameters
    ----------
    wheel_x, wheel_s : ndarray (mx,), (my,)
        Grid lines of the wheel's tread nodes: position along the wheel in its own axes, and arc
        length on its profile [m].
    symmetric : bool
        Only y >= 0 is modelled; then ``wheel_s[0]`` must be 0 and the wheel stand centred and
        upright on an upright rail.

    Raises
    ------
    InputError
        If the grid is impossible, reaches beyond the wheel's profile, or the bodies do not touch.
    """
    wheel_x, wheel_s = np.asarray(wheel_x, dtype=float), np.asarray(wheel_s, dtype=float)
    rail, wheel, radius = geometry.rail, geometry.wheel, geometry.radius
    s0, s1 = wheel.s_range
    problems = []
    if symmetric and (abs(wheel_s[0]) > 1e-12 or geometry.pose != Pose()):
        problems.append(
            "symmetric contact: needs wheel lines from 0, no lateral shift, and no turn of wheel "
            "or rail"
        )
    if np.any(np.diff(wheel_x) <= 0) or np.any(np.diff(wheel_s) <= 0):
        problems.append("contact grid: lines must increase")
    if not (wheel_s[0] >= s0 - 1e-12 and wheel_s[-1] <= s1 + 1e-12):
        problems.append(
            f"contact grid: s = {wheel_s[0]:.4g} to {wheel_s[-1]:.4g} m reaches beyond the "
            f"profile {wheel.name}, {s0:.4g} to {s1:.4g} m"
        )
    if problems:
        raise InputError(problems)
    along, across = point_line(wheel_x, quadrature), point_line(wheel_s, quadrature)
    x, s = along.at, across.at
    nx, ny, my = len(x), len(s), len(wheel_s)
    facing = geometry.facing(np.repeat(x, ny), np.tile(s, nx))
    # on the wheel dA = dx ds / cos(a), x = r sin(a); projected along the rail's normal
    local = radius - wheel.point(s)[:, 1]
    cosine = np.sqrt(1.0 - (x[:, None] / local[None, :]) ** 2)
    area = (
        along.weight[:, None] * across.weight[None, :] / cosine * facing.alignment.reshape(nx, ny)
    )
    arc = geometry.feet(s)
    return ContactPoints(
        x,
        rail.point(arc)[:, 0],
        arc,
        wheel_x,
        wheel_s,
        facing.gap,
        facing.normal_z,
        (2.0 if symmetric else 1.0) * area.ravel(),
        grid_facets(along, across, my),
        grid_rows(along.rows, across.rows, my),
        symmetric,
    )

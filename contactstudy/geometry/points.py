"""Contact points: where the pressure is taken on the wheel, and the gap of smooth surfaces.

Coordinates: x along the rail relative to the wheel's lowest point, y lateral in the rail's
axes, z up. Points are Gauss points or nodes of the wheel's tread facets and travel with it. The
gap is never taken from facets: it is the distance between the smooth profiles in double precision.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array, BoolArray, IntArray
from contactstudy.exceptions import InputError
from contactstudy.geometry.interpolation import Rows, grid_rows
from contactstudy.geometry.quadrature import Quadrature, grid_facets, point_line
from contactstudy.profiles.rail import RailProfile
from contactstudy.profiles.wheel import WheelProfile


@dataclass(frozen=True)
class ContactPoints:
    """Points on the wheel's tread over the running surface of the rail.

    The points form a product grid, index ``i*ny + j``; wheel nodes one, index ``i*my + j``.

    Attributes
    ----------
    x, y : ndarray (nx,), (ny,)
        Grid lines of the points in m; y in the rail's own axes.
    arc : ndarray (ny,)
        Arc length of the lines y along the running surface from its crown in m, positive with
        y: the coordinate in which the rail's surface nodes are interpolated.
    wheel_x, wheel_y : ndarray (mx,), (my,)
        Grid lines of the wheel's tread nodes in m.
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

    def nodal_pressure(self, forces: Array) -> Array:
        """Pressure at the wheel's tread nodes from the forces at the points.

        The lumped L2 projection ``p_a = sum_i N_a(i) lam_i / sum_i N_a(i) A_i``. With a stiff
        penalty four points a facet follow what the nodes cannot, and their own pressures
        scatter about this one. Points at the nodes have ``lam_a / A_a``.

        Parameters
        ----------
        forces : ndarray (nx*ny,)
            Normal forces in N.

        Returns
        -------
        ndarray (mx*my,)
            Pressure in Pa.
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


def rolling_drop(x: Array, height: Array, radius: float) -> Array:
    """Height of the wheel's surface above its tape circle's lowest point, (nx, ny) in m.

    With the local rolling radius ``R_y = R - h(y)`` the surface is
    ``R - sqrt(R_y^2 - x^2) = h + x^2/(R_y + sqrt(R_y^2 - x^2))``; the second form keeps all
    digits.
    """
    local = radius - height[None, :]
    square = local**2 - x[:, None] ** 2
    if np.any(square <= 0) or np.any(local <= 0):
        raise InputError("wheel: contact points lie outside the rolling circle")
    return np.asarray(height[None, :] + x[:, None] ** 2 / (local + np.sqrt(square)))


def contact_points(
    wheel_x: Array,
    wheel_y: Array,
    radius: float,
    rail: RailProfile,
    wheel: WheelProfile,
    symmetric: bool = True,
    lateral_shift: float = 0.0,
    quadrature: Quadrature = "gauss",
) -> ContactPoints:
    """Contact points of the wheel's tread facets over the rail.

    Parameters
    ----------
    wheel_x, wheel_y : ndarray (mx,), (my,)
        Grid lines of the wheel's tread nodes in m, in the rail's axes.
    radius : float
        Rolling radius at the tape circle in m.
    rail : RailProfile
        Gives the running surface and its slope.
    wheel : WheelProfile
        Gives the height of the tread; even in y if `symmetric`.
    symmetric : bool
        Only y >= 0 is modelled; then ``wheel_y[0]`` must be 0.
    lateral_shift : float
        Position of the wheel's tape circle in m (0 if `symmetric`).
    quadrature : {"gauss", "nodes"}
        Gauss points of the facets, or the tread nodes with nodal areas.

    Returns
    -------
    ContactPoints

    Raises
    ------
    InputError
        If the grid is impossible or reaches beyond the running surface.
    """
    problems = []
    if not radius > 0:
        problems.append(f"wheel radius = {radius} m: must be positive")
    if symmetric and (abs(wheel_y[0]) > 1e-12 or lateral_shift != 0.0):
        problems.append("symmetric contact: needs wheel_y[0] = 0 and no lateral shift")
    if np.any(np.diff(wheel_x) <= 0) or np.any(np.diff(wheel_y) <= 0):
        problems.append("contact grid: lines must increase")
    if problems:
        raise InputError(problems)
    along = point_line(wheel_x, quadrature)
    across = point_line(wheel_y, quadrature)
    x, y = along.at, across.at
    top, slope = np.asarray(rail.running_surface(y)), np.asarray(rail.running_slope(y))
    if not np.all(np.isfinite(top)):
        raise InputError(
            f"contact grid from y = {y[0]:.4g} to {y[-1]:.4g} m reaches beyond the running "
            f"surface of {rail.name}"
        )
    # n = (0, -z', 1)/sqrt(1 + z'^2); a vertical distance d is d n_z along the normal
    normal = 1.0 / np.sqrt(1.0 + slope**2)
    drop = rolling_drop(x, np.asarray(wheel.height(y - lateral_shift)), radius)
    gap = (drop - top[None, :]) * normal[None, :]
    factor = 2.0 if symmetric else 1.0
    # dA = dx dy / n_z on the rail's surface
    area = factor * along.weight[:, None] * (across.weight / normal)[None, :]
    my = len(wheel_y)
    return ContactPoints(
        x,
        y,
        rail.running_arc(y),
        np.asarray(wheel_x, dtype=float),
        np.asarray(wheel_y, dtype=float),
        gap.ravel(),
        np.tile(normal, len(x)),
        area.ravel(),
        grid_facets(along, across, my),
        grid_rows(along.rows, across.rows, my),
        symmetric,
    )

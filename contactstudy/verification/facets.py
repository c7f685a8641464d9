"""Static press with the gap between flat faces, as general finite-element programs take it.

The program takes the gap between the smooth profiles and bends the rail's surface by a spline.
Here both bodies are what their faces say: gap and displacements are linear between the nodes.
It is the like-for-like counterpart of another program's press on the same mesh.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contactstudy.banded import Factor
from contactstudy.contact.interpolation import grid_rows, linear_rows
from contactstudy.contact.points import rolling_drop
from contactstudy.contact.surface import press
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.wheel import wheel_profile
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.track.solid import SolidTrack
from contactstudy.track.unreduced import UnreducedTrack

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FacetPress:
    """One solution; forces and areas of both halves.

    Attributes
    ----------
    approach : float
        Of the hub to the rail's clamped ends in m.
    area : float
        Area of the integration points in contact in m^2.
    face_pressure : ndarray (mx - 1, my - 1)
        Mean over each face of the tread in Pa.
    """

    approach: float
    area: float
    face_pressure: Array


def facet_press(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility,
    load: float,
    penalty: float,
    x: float,
    order: int = 5,
) -> FacetPress:
    """Press the faces of a symmetric wheel on those of a symmetric rail.

    Parameters
    ----------
    track : SolidTrack or UnreducedTrack
        With clamped ends and without supports: the approach is measured from the ends.
    wheel : WheelFlexibility
    load : float
        In N.
    penalty : float
        In Pa/m.
    x : float
        Position of the wheel on the track in m.
    order : int
        Gauss points along each side of a face.
    """
    patch = track.patch(x, float(wheel.x[-1]) + 2 * track.thickness)
    factor = Factor(track.stiffness)
    unit = np.zeros((factor.n, len(patch.dofs)))
    unit[patch.dofs, np.arange(len(patch.dofs))] = 1.0
    rail_flexibility = patch.map @ factor.solve(unit)[patch.dofs] @ patch.map.T + patch.residual

    node, share = np.polynomial.legendre.leggauss(order)

    def line(at: Array) -> tuple[Array, Array]:
        step = np.diff(at)[:, None]
        return (at[:-1, None] + 0.5 * step * (1 + node)).ravel(), (0.5 * step * share).ravel()

    (px, wx), (py, wy) = line(wheel.x), line(wheel.y)
    nx, ny = len(patch.x), len(patch.y)
    rows_x, rows_y = linear_rows(patch.x - x, px), linear_rows(patch.y, py)
    on_rail = grid_rows(rows_x, rows_y, ny).matrix(nx * ny)
    tread_x, tread_y = linear_rows(wheel.x, px), linear_rows(wheel.y, py)
    on_wheel = grid_rows(tread_x, tread_y, len(wheel.y)).matrix(len(wheel.flexibility))

    rail, recipe = rail_profile(track.recipe.profile), wheel.recipe
    height = np.asarray(wheel_profile(recipe.profile).height(wheel.y))
    drop = rolling_drop(wheel.x, height, recipe.dimensions.radius).ravel()
    top = np.tile(np.asarray(rail.running_surface(patch.y)), nx)
    normal = np.tile(1.0 / np.sqrt(1.0 + np.asarray(rail.running_slope(py)) ** 2), len(px))
    area = 2.0 * np.outer(wx, wy).ravel() / normal
    gap = (on_wheel @ drop - on_rail @ top) * normal

    M = on_rail @ rail_flexibility @ on_rail.T + on_wheel @ wheel.flexibility @ on_wheel.T
    M = 0.5 * (M + M.T) + np.diag(1.0 / (penalty * area))
    solution = press(M, gap, normal, load)

    def by_face(values: Array) -> Array:
        grid = values.reshape(len(wheel.x) - 1, order, len(wheel.y) - 1, order)
        return np.asarray(grid.sum(axis=(1, 3)))

    return FacetPress(
        approach=solution.approach,
        area=float(area[solution.active].sum()),
        face_pressure=by_face(solution.forces) / by_face(area),
    )

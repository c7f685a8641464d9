"""Static press with the gap between flat faces, as general finite-element programs take it.

The program takes the gap between the smooth profiles and bends the rail's surface by a spline.
Here both bodies are what their faces say: gap and displacements are linear between the nodes.
It is the like-for-like counterpart of another program's press on the same mesh.
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.complementarity import press
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.banded import Factor
from contactstudy.geometry.placement import Geometry
from contactstudy.track.meshed import MeshedTrack
from contactstudy.verification.cases.flat_points import flat_points

ORDER = 5
"""Gauss points along each side of a face, or of what the other body's lines cut from it."""


@dataclass(frozen=True)
class FacetPress:
    """One solution; forces and areas of a half model are of both halves.

    Attributes
    ----------
    approach : float
        Of the hub to the rail's clamped ends in m.
    area : float
        Area of the integration points in contact in m^2.
    face_pressure : ndarray (mx - 1, my - 1)
        Mean over each face of the tread in Pa.
    lateral_force : float
        On the wheel along the track's Y in N; 0 of a half model.
    """

    approach: float
    area: float
    face_pressure: Array
    lateral_force: float = 0.0


def flat_press(track: MeshedTrack, contact: SurfaceContact, load: float, x: float) -> FacetPress:
    """Press the faces of a wheel on those of a rail.

    Parameters
    ----------
    track : MeshedTrack
        With clamped ends and without supports: the approach is measured from the ends.
    contact : SurfaceContact
        Of it the wheel, its place and the penalty; without a place centred and upright.
    load, x : float
        In N, and the position of the wheel on the track in m.
    """
    wheel = contact.wheel
    geometry = contact.geometry or Geometry.of(wheel.recipe)
    rail = track.stretch(x, 1.05 * float(wheel.x[-1]) + 2 * track.thickness)
    factor = Factor(track.stiffness)
    unit = np.zeros((factor.n, len(rail.dofs)))
    unit[rail.dofs, np.arange(len(rail.dofs))] = 1.0
    rail_flexibility = rail.map @ factor.solve(unit)[rail.dofs] @ rail.map.T + rail.residual
    points = flat_points(rail, wheel, x, ORDER, geometry)
    M = points.on_rail @ rail_flexibility @ points.on_rail.T
    M += points.on_wheel @ wheel.flexibility @ points.on_wheel.T
    M = 0.5 * (M + M.T) + np.diag(1.0 / (contact.penalty * points.area))
    solution = press(M, points.gap, points.normal[:, 1], load)

    faces = len(wheel.x) - 1, len(wheel.y) - 1
    return FacetPress(
        approach=solution.approach,
        area=float(points.area[solution.active].sum()),
        face_pressure=points.by_face(solution.forces, faces) / points.by_face(points.area, faces),
        lateral_force=float(points.normal[:, 0] @ solution.forces),
    )

"""Wheel and rail at rest, ready to be pressed together."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.residual import ResidualFlexibility, patch_splines
from contactstudy.dynamics.banded import Factor
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import ContactPoints
from contactstudy.geometry.quadrature import Quadrature
from contactstudy.geometry.tread import wheel_points
from contactstudy.solids.wheel import WheelFlexibility
from contactstudy.track.solid import SolidTrack
from contactstudy.track.unreduced import UnreducedTrack


@dataclass(frozen=True)
class BodiesAtRest:
    """Contact points of both bodies and how they give way.

    Attributes
    ----------
    points : ContactPoints
    flexibility : ndarray (n, n)
        Growth of the gap at the points in m for unit normal forces in N, the hub held.
    centre_line : ndarray (n,)
        Downward displacement of the rail's centre line under the wheel in m for unit forces.
    """

    points: ContactPoints
    flexibility: Array
    centre_line: Array


def bodies_at_rest(
    track: SolidTrack | UnreducedTrack,
    wheel: WheelFlexibility,
    x: float | None = None,
    quadrature: Quadrature = "gauss",
    geometry: Geometry | None = None,
) -> BodiesAtRest:
    """Points and flexibility of a wheel that stands on the track.

    Parameters
    ----------
    track : SolidTrack or UnreducedTrack
    wheel : WheelFlexibility
    x : float, optional
        Position on the track in m; the middle of its middle bay when not given.
    quadrature, geometry
        As in `solvers.surface.surface_contact`.

    Returns
    -------
    BodiesAtRest
    """
    points = wheel_points(wheel, quadrature, geometry)
    x = (track.track.n_bays // 2 + 0.5) * track.track.bay_length if x is None else x
    half_length = float(np.abs(points.x).max()) + 2 * track.thickness
    patch = track.patch(x, half_length)
    factor = Factor(track.stiffness)
    unit = np.zeros((factor.n, len(patch.dofs)))
    unit[patch.dofs, np.arange(len(patch.dofs))] = 1.0
    solved = factor.solve(unit)
    C = solved[patch.dofs]
    along, across = patch_splines(patch, points)
    P = np.kron(along(x - patch.x[0] + points.x), across)
    residual = ResidualFlexibility(along, across, points.x, track.thickness, track.residual_period)
    PH = P @ patch.map
    tread = points.wheel_rows.matrix(len(wheel.flexibility))
    W = residual(x, patch).block(np.arange(len(points.gap)))
    W += tread @ wheel.flexibility @ tread.T
    W += PH @ residual.beyond(0.5 * (C + C.T), patch) @ PH.T
    # deflection of the centre line per unit nodal force; forces push the rail down
    reference = P @ (patch.map @ (patch.centre_map[0] @ solved[patch.centre_dofs]))
    reference += P @ patch.centre_residual[0]
    return BodiesAtRest(points, W, reference)

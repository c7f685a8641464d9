"""Wheel and rail at rest, ready to be pressed together."""

from dataclasses import dataclass, replace

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.nearby import NearbyColumns
from contactstudy.contact.press import PressCurve, press_curve
from contactstudy.contact.press_table import PressTable, press_table
from contactstudy.contact.rail_surface import RailSurface
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.banded import Factor
from contactstudy.geometry.points import ContactPoints
from contactstudy.track.meshed import MeshedTrack


@dataclass(frozen=True)
class BodiesAtRest:
    """Contact points of both bodies and how they give way.

    Attributes
    ----------
    flexibility : ndarray (n, n)
        Growth of the gap at the points in m for unit normal forces in N, the hub held.
    centre_line : ndarray (n,)
        Downward displacement of the rail's centre line under the wheel in m for unit forces.
    """

    points: ContactPoints
    flexibility: Array
    centre_line: Array


def bodies_at_rest(
    track: MeshedTrack,
    contact: SurfaceContact,
    x: float | None = None,
    level: Array | None = None,
) -> BodiesAtRest:
    """Points and flexibility of a wheel that stands on the track at x [m], by default in mid-bay.

    A level r (n,) at the points [m] closes their gaps, such as `SurfaceContact.level` of a flat.

    The wheel has all its static flexibility; its modes do not count.
    """
    points, x = contact.points, track.track.middle if x is None else x
    if level is not None:
        points = replace(points, gap=points.gap - level.ravel() * points.normal_z)
    under = RailSurface(track, points).under(x)
    stretch, every = under.stretch, np.arange(len(points.gap))
    near = NearbyColumns(Factor(track.stiffness))
    near.move_to(stretch)
    P = under.rows(every)
    PH = P @ stretch.map
    tread = points.wheel_rows.matrix(len(contact.wheel.flexibility))
    W = under.residual.block(every)
    W += tread @ contact.wheel.flexibility @ tread.T
    W += PH @ under.beyond(near.compliance) @ PH.T
    # deflection of the centre line per unit nodal force; forces push the rail down
    moved = near.displacement(stretch.centre_dofs) @ stretch.centre_map[0]
    return BodiesAtRest(points, W, PH @ moved + P @ stretch.centre_residual[0])


def geometry_press(
    track: MeshedTrack,
    contact: SurfaceContact,
    loads: Array,
    x: float | None = None,
    level: Array | None = None,
) -> PressCurve:
    """Static press by loads [N] at x, measured from the hub to the rail's centre line.

    The deflection of the rail as a beam is taken out with the centre line, so what is left is
    the local flexibility that a point model's contact spring stands for; its tangent at the
    static load (`contact.press.tangent_stiffness`) is the matching k_r.

    Parameters
    ----------
    track : MeshedTrack
        Any supported track with the rail. In the middle of a bay its supports hardly matter;
        over a sleeper the compression of the web by the pad adds 3 % to the approach.
    level : ndarray (n,), optional
        As in `bodies_at_rest`; the approach then counts from the round wheel's touch.
    """
    at = bodies_at_rest(track, contact, x, level)
    return press_curve(at.points, at.flexibility, loads, contact.enforcement, at.centre_line)


def geometry_table(track: MeshedTrack, contact: SurfaceContact, load: float) -> PressTable:
    """The press in mid-bay as a point law has it, from nothing to a multiple of a load [N]."""
    at = bodies_at_rest(track, contact)
    return press_table(at.points, at.flexibility, load, contact.enforcement, at.centre_line)

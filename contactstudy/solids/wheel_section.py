"""Section of a wheel with tread, flange, web and hub; fine anywhere on the tread.

Half sections end at the plane of the tape circle: rim and hub are shared evenly between the two
sides, and the flange, which stiffens the rim away from the contact only, is left out.
"""

from dataclasses import dataclass, replace

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.mapped import Grading, along, graded, join, on_mirror, transfinite
from contactstudy.solids.rim import Rim, half_rim, whole_rim


@dataclass(frozen=True)
class WheelSection:
    """Section in coordinates (y, rho), rho the distance from the wheel's axis.

    Attributes
    ----------
    nodes : ndarray (n, 2)
        In m.
    quads : ndarray (m, 4)
        Corner nodes, counter-clockwise in (y, rho).
    tread : ndarray (k,)
        Nodes of the fine part of the tread by growing arc length; in a half section from 0.
    bore : ndarray (b,)
        Nodes of the bore.
    symmetric : bool
        Half section y >= 0 of a symmetric wheel.
    """

    nodes: Array
    quads: IntArray
    tread: IntArray
    bore: IntArray
    symmetric: bool = True

    @property
    def plane_of_symmetry(self) -> IntArray:
        """Nodes on y = 0 of a half section; none of a whole one."""
        return on_mirror(self.nodes, self.symmetric)


def fine_arcs(centre: float, half_width: float, size: float, symmetric: bool = False) -> Array:
    """Lines of the fine part of the tread by arc length, equal steps about `centre` [m].

    Of a half section those from the centre on.
    """
    half = size * np.arange(max(2, round(half_width / size)) + 1)
    return np.asarray(centre + (half if symmetric else np.concatenate([-half[:0:-1], half])))


def wheel_section(
    dimensions: WheelDimensions,
    curve: ProfileCurve,
    contact_centre: float,
    contact_half_width: float,
    grading: Grading,
    symmetric: bool = False,
) -> WheelSection:
    """Mesh a section, or its half y >= 0, fine about a point of its profile.

    The fine part reaches `contact_half_width` to both sides of `contact_centre`, an arc length on
    the profile from the tape circle [m].

    Raises
    ------
    InputError
        If profile, rim and fine part do not fit together.
    """
    d = dimensions
    if symmetric:
        rim_side, hub_side = 0.5 * d.rim_width, 0.5 * d.hub_width
        d = replace(
            d, rim_inside=-rim_side, rim_outside=rim_side, hub_inside=-hub_side,
            hub_outside=hub_side,
        )  # fmt: skip
    fine = fine_arcs(contact_centre, contact_half_width, grading.size, symmetric)
    rim = (half_rim if symmetric else whole_rim)(d, curve, fine, grading)
    head = _head(d, rim, fine, contact_centre, grading)
    # the web's columns keep their shares of its thickness from rim to hub
    a, b = rim.web
    share = (rim.bottom[a : b + 1] - rim.bottom[a]) / (rim.bottom[b] - rim.bottom[a])
    length = d.inner_radius - d.hub_radius
    rows = np.linspace(
        d.hub_radius, d.inner_radius, 1 + max(4, round(length / grading.coarse / 1.5))
    )
    inside, outside = d.web(rows)
    if symmetric:
        inside = 0.0 * inside
    y = inside[:, None] + (outside - inside)[:, None] * share
    disc = np.stack(np.broadcast_arrays(y, rows[:, None]), axis=2)

    def beside_web(length: float) -> Array:
        return graded(length, grading.coarse, grading.growth, 2 * grading.coarse)[1:]

    left = np.empty(0) if symmetric else inside[0] - beside_web(inside[0] - d.hub_inside)[::-1]
    across = np.r_[left, y[0], outside[0] + beside_web(d.hub_outside - outside[0])]
    up = np.linspace(d.bore_radius, d.hub_radius, 4)
    hub = np.stack(np.broadcast_arrays(across[None, :], up[:, None]), axis=2)
    nodes, quads, ids = join(hub, disc, head)
    first = int(np.argmin(np.abs(rim.s - fine[0])))
    tread = ids[2][-1, first : first + len(fine)]
    return WheelSection(nodes, quads, tread, ids[0][0], symmetric)


def _head(d: WheelDimensions, rim: Rim, fine: Array, centre: float, grading: Grading) -> Array:
    """Nodes (rows, columns, 2) of the rim, rows from its inner edge to the tread."""
    base = np.c_[rim.bottom, np.full(len(rim.bottom), d.inner_radius)]
    middle = int(np.argmin(np.abs(rim.s - centre)))
    reach = float(np.linalg.norm(rim.top[middle] - base[middle]))
    up = 1 - grading.steps(reach, grading.size)[::-1] / reach
    side = d.rim_outside + 0 * up
    right = np.c_[side, d.inner_radius + (rim.top[-1, 1] - d.inner_radius) * up]
    head = transfinite(base, rim.top, along(rim.face, up), right)
    # columns start along the inward normal in and near the fine part: with the depth share t
    # from the tread, t (1-t)^4 (reach * inward normal - straight column) is added
    distance = np.maximum(np.maximum(fine[0] - rim.s, rim.s - fine[-1]), 0.0)
    edge = np.minimum(rim.s - rim.s[0], rim.s[-1] - rim.s)
    weight = np.exp(-((distance / 0.015) ** 2)) * np.clip(edge / 0.01, 0, 1)
    lean = weight[:, None] * (-reach * rim.normal - (base - rim.top))
    t = 1 - up
    return np.asarray(head + (t * (1 - t) ** 4)[:, None, None] * lean)

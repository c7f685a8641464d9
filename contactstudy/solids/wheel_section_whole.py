"""Whole section of a wheel with tread, flange, web and hub; fine anywhere on the tread."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.mapped import along, graded, join, transfinite
from contactstudy.solids.wheel_section import WheelSection, fine_lines

_LEAST_WEB_COLUMNS = 3


@dataclass(frozen=True)
class _Rim:
    """Outline of the rim: the tread's columns, and the face on the flange's side.

    The mapped block's upper left corner lies on the flange where the outward normal is half way
    between down and inside, so that the smooth outline bends as little as possible there.
    """

    s: Array  # arc lengths of the columns on the profile
    top: Array  # (columns, 2) their points (y, rho)
    normal: Array  # (columns, 2) outward in (y, rho)
    face: Array  # polyline (y, rho) from the rim's inner edge up to the corner


def fine_arcs(centre: float, half_width: float, size: float) -> Array:
    """Lines of the fine part of the tread by arc length, equal steps about `centre` [m]."""
    half = fine_lines(half_width, size)
    return centre + np.concatenate([-half[:0:-1], half])


def whole_wheel_section(
    dimensions: WheelDimensions,
    curve: ProfileCurve,
    size: float,
    contact_centre: float,
    contact_half_width: float,
    coarse: float = 0.012,
    growth: float = 1.6,
) -> WheelSection:
    """Mesh the whole section, fine about a point of its profile.

    Parameters
    ----------
    dimensions : WheelDimensions
        Rim, web and hub.
    curve : ProfileCurve
        Tread and flange; goes on straight to the faces of the rim where it ends before them,
        and is cut there where it ends beyond.
    size : float
        Element size in the fine part in m, along the profile and in depth.
    contact_centre : float
        Arc length of its middle on the profile in m, 0 at the tape circle.
    contact_half_width : float
        Its extent on each side in m.
    coarse, growth : float
        Element size far away in m, and ratio of neighbouring sizes.

    Returns
    -------
    WheelSection
        Tread nodes ordered by growing arc length.

    Raises
    ------
    InputError
        If profile and rim do not fit together or the fine part leaves the profile.
    """
    d = dimensions
    fine = fine_arcs(contact_centre, contact_half_width, size)
    rim = _rim(d, curve, fine, size, coarse, growth)
    bottom, web = _bottom(d, rim)
    head = _head(d, rim, bottom, fine, size, coarse, growth)
    # the web's columns keep their shares of its thickness from rim to hub
    a, b = web
    share = (bottom[a : b + 1] - bottom[a]) / (bottom[b] - bottom[a])
    rows = np.linspace(
        d.hub_radius,
        d.inner_radius,
        1 + max(4, round((d.inner_radius - d.hub_radius) / coarse / 1.5)),
    )
    inside, outside = d.web(rows)
    disc = np.stack(
        [
            inside[:, None] + (outside - inside)[:, None] * share,
            np.broadcast_to(rows[:, None], (len(rows), len(share))),
        ],
        axis=2,
    )
    left = graded(inside[0] - d.hub_inside, coarse, growth, 2 * coarse)
    right = graded(d.hub_outside - outside[0], coarse, growth, 2 * coarse)
    across = np.r_[inside[0] - left[:0:-1], disc[0, :, 0], outside[0] + right[1:]]
    hub = np.stack(
        np.broadcast_arrays(across[None, :], np.linspace(d.bore_radius, d.hub_radius, 4)[:, None]),
        axis=2,
    )
    nodes, quads, ids = join(hub, disc, head)
    first = int(np.argmin(np.abs(rim.s - fine[0])))
    tread = ids[2][-1, first : first + len(fine)]
    return WheelSection(nodes, quads, tread, ids[0][0], symmetric=False)


def tread_reach(d: WheelDimensions, curve: ProfileCurve, size: float) -> tuple[float, float]:
    """Arc lengths on a wheel's profile between which the fine part must lie, in m.

    Parameters
    ----------
    d : WheelDimensions
    curve : ProfileCurve
    size : float
        Element size in the fine part in m.

    Raises
    ------
    InputError
        If profile and rim do not fit together.
    """
    low, high = _ends(d, curve)
    return _corner(curve, low, high) + 2 * size, high - 2 * size


def _corner(curve: ProfileCurve, low: float, high: float) -> float:
    """First point where the outward normal leans less than 45 degrees to the inside."""
    s = np.linspace(low, high, 2000)
    leaning = np.flatnonzero(curve.normal(s)[:, 0] < -np.sqrt(0.5))
    return float(s[leaning[-1] + 1]) if len(leaning) else low


def _rim(
    d: WheelDimensions, curve: ProfileCurve, fine: Array, size: float, coarse: float, growth: float
) -> _Rim:
    low, high = _ends(d, curve)
    corner = _corner(curve, low, high)
    if not corner + 2 * size <= fine[0] < fine[-1] <= high - 2 * size:
        raise InputError(
            f"wheel contact zone from s = {fine[0]:.4g} to {fine[-1]:.4g} m: must lie on profile "
            f"{curve.name} from {corner + 2 * size:.4g} to {high - 2 * size:.4g} m"
        )
    first = size * growth
    left = fine[0] - graded(fine[0] - corner, first, growth, coarse)[:0:-1]
    right = fine[-1] + graded(high - fine[-1], first, growth, coarse)[1:]
    columns = np.r_[left, fine, right]
    columns[0] = corner
    point, normal = curve.point(columns), curve.normal(columns)
    back = curve.point(np.linspace(low, corner, 20)) if corner > low else curve.point([low])
    face = np.r_[[[d.rim_inside, d.inner_radius]], np.c_[back[:, 0], d.radius - back[:, 1]]]
    return _Rim(
        columns,
        np.c_[point[:, 0], d.radius - point[:, 1]],
        np.c_[normal[:, 0], -normal[:, 1]],
        face,
    )


def _ends(d: WheelDimensions, curve: ProfileCurve) -> tuple[float, float]:
    """Arc lengths at which the profile, cut or continued straight, meets the rim's faces."""
    ends, problems = [], []
    for s, face, side in (
        (curve.s_range[0], d.rim_inside, -1.0),
        (curve.s_range[1], d.rim_outside, 1.0),
    ):
        y, normal = float(curve.point(s)[0]), curve.normal(s)
        missing = side * (face - y)
        if missing < -1e-6:
            s = float(curve.arc_of_y(face))
        elif missing > 1e-6 and -normal[1] < np.sqrt(0.5):
            problems.append(
                f"wheel profile {curve.name} ends at y = {y:.6g} m on a slope steeper than 45 "
                f"degrees; it must reach the rim's face at {face:.6g} m or end on a flatter slope"
            )
        # dy/ds = -n_z of the downward normal
        elif missing > 1e-6:
            s += side * missing / float(-normal[1])
        ends.append(s)
    if problems:
        raise InputError(problems)
    return ends[0], ends[1]


def _bottom(d: WheelDimensions, rim: _Rim) -> tuple[Array, tuple[int, int]]:
    """y of the columns at the rim's inner edge, and the first and last column of the web."""
    by_arc = (rim.s - rim.s[0]) / (rim.s[-1] - rim.s[0])
    by_y = (rim.top[:, 0] - d.rim_inside) / d.rim_width
    # columns as upright as the flange lets them be
    natural = np.maximum.accumulate(0.5 * by_arc + 0.5 * np.clip(by_y, 0, 1))
    natural = d.rim_inside + d.rim_width * (natural - natural[0]) / (natural[-1] - natural[0])
    low, high = (float(v) for v in d.web(d.inner_radius))
    n = len(natural)
    a = int(np.clip(np.argmin(np.abs(natural - low)), 1, n - 2 - _LEAST_WEB_COLUMNS))
    b = int(np.argmin(np.abs(natural - high)))
    b = int(np.clip(b, a + _LEAST_WEB_COLUMNS, n - 2))
    knots = natural[[0, a, b, n - 1]]
    return np.interp(natural, knots, [d.rim_inside, low, high, d.rim_outside]), (a, b)


def _head(
    d: WheelDimensions,
    rim: _Rim,
    bottom: Array,
    fine: Array,
    size: float,
    coarse: float,
    growth: float,
) -> Array:
    """Nodes (rows, columns, 2) of the rim, rows from its inner edge to the tread."""
    base = np.c_[bottom, np.full(len(bottom), d.inner_radius)]
    middle = int(np.argmin(np.abs(rim.s - fine[len(fine) // 2])))
    reach = float(np.linalg.norm(rim.top[middle] - base[middle]))
    up = 1 - graded(reach, size, growth, coarse)[::-1] / reach
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

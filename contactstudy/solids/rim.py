"""Outline of a wheel's rim: columns of the mesh from the tread to the inner edge."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.mapped import Grading

_LEAST_WEB_COLUMNS = 3


@dataclass(frozen=True)
class Rim:
    """Columns of the rim.

    Attributes
    ----------
    s : ndarray (n,)
        Arc lengths of the columns on the profile in m.
    top, normal : ndarray (n, 2)
        Their points (y, rho) on the tread in m, and its outward normals there.
    face : ndarray (k, 2)
        Polyline (y, rho) from the rim's inner edge up to the first column in m.
    bottom : ndarray (n,)
        y of the columns at the rim's inner edge in m.
    web : tuple of int
        First and last column of the web.
    """

    s: Array
    top: Array
    normal: Array
    face: Array
    bottom: Array
    web: tuple[int, int]


def half_rim(d: WheelDimensions, curve: ProfileCurve, fine: Array, grading: Grading) -> Rim:
    """Columns of the half y >= 0 of a rim that is symmetric about the tape circle.

    The tread must be even in y, the fine arc lengths (k,) begin at 0 [m]. The columns of the web
    stand straight where the fine part ends within it.

    Raises
    ------
    InputError
        If the fine part does not fit on the rim, or tread or web are not symmetric.
    """
    rim, web = d.rim_outside, 0.5 * d.web_thickness[-1]
    problems = []
    if any(d.web_offset):
        problems.append(
            f"wheel web_offset = {list(d.web_offset)} m: a half model needs a web that is "
            "symmetric about the tape circle; use a whole section"
        )
    if fine[-1] >= rim - grading.size:
        problems.append(
            f"wheel contact_half_width = {fine[-1]:g} m: must be well inside the half rim "
            f"of {rim} m"
        )
    if not np.allclose(curve.point(-fine) * [-1.0, 1.0], curve.point(fine), rtol=0, atol=1e-12):
        problems.append(f"wheel profile '{curve.name}': a half model needs an even tread")
    if problems:
        raise InputError(problems)
    # columns: fine tread, to the side of the web, to the side of the rim
    columns = fine
    if web > fine[-1] + 0.3 * grading.size:
        columns = np.r_[fine, fine[-1] + grading.steps(web - fine[-1], grading.size)[1:]]
    n_web = int(np.argmin(np.abs(columns - web)))
    first = (columns[-1] - columns[-2]) * grading.growth
    columns = np.r_[columns, columns[-1] + grading.steps(rim - columns[-1], first)[1:]]
    top, normal = _points(d, curve, columns)
    bottom = np.r_[columns[: n_web + 1] * (web / columns[n_web]), columns[n_web + 1 :]]
    return Rim(columns, top, normal, np.array([[0.0, d.inner_radius], top[0]]), bottom, (0, n_web))


def whole_rim(d: WheelDimensions, curve: ProfileCurve, fine: Array, grading: Grading) -> Rim:
    """Columns of a whole rim with its flange, fine at given arc lengths (k,) [m].

    The mapped block's upper left corner lies on the flange where the outward normal is half way
    between down and inside, so that the smooth outline bends as little as possible there. The
    profile goes on straight to the faces of the rim where it ends before them, and is cut there
    where it ends beyond.

    Raises
    ------
    InputError
        If profile and rim do not fit together or the fine part leaves the profile.
    """
    low, high = _ends(d, curve)
    corner, size = _corner(curve, low, high), grading.size
    if not corner + 2 * size <= fine[0] < fine[-1] <= high - 2 * size:
        raise InputError(
            f"wheel contact zone from s = {fine[0]:.4g} to {fine[-1]:.4g} m: must lie on profile "
            f"{curve.name} from {corner + 2 * size:.4g} to {high - 2 * size:.4g} m"
        )
    left = fine[0] - grading.steps(fine[0] - corner)[:0:-1]
    columns = np.r_[left, fine, fine[-1] + grading.steps(high - fine[-1])[1:]]
    columns[0] = corner
    top, normal = _points(d, curve, columns)
    back = curve.point(np.linspace(low, corner, 20)) if corner > low else curve.point([low])
    face = np.r_[[[d.rim_inside, d.inner_radius]], np.c_[back[:, 0], d.radius - back[:, 1]]]
    return Rim(columns, top, normal, face, *_bottom(d, columns, top[:, 0]))


def _points(d: WheelDimensions, curve: ProfileCurve, s: Array) -> tuple[Array, Array]:
    """Points and outward normals of the profile in (y, rho)."""
    point, normal = curve.point_and_normal(s)
    return np.c_[point[:, 0], d.radius - point[:, 1]], np.c_[normal[:, 0], -normal[:, 1]]


def tread_reach(d: WheelDimensions, curve: ProfileCurve, size: float) -> tuple[float, float]:
    """Arc lengths on a wheel's profile between which the fine part must lie, in m.

    Parameters
    ----------
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


def _bottom(d: WheelDimensions, s: Array, y: Array) -> tuple[Array, tuple[int, int]]:
    """y of the columns at the rim's inner edge, and the first and last column of the web."""
    by_arc = (s - s[0]) / (s[-1] - s[0])
    by_y = (y - d.rim_inside) / d.rim_width
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

"""Worn profiles of rail and wheel from CSV files."""

from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import fit_cloud
from contactstudy.profiles.curve import ProfileCurve
from contactstudy.profiles.orientation import (
    TAPE,
    Way,
    shape_of_rail,
    shape_of_wheel,
    turned,
)
from contactstudy.profiles.outliers import (
    BEARABLE,
    KNOTS,
    LARGEST_RESIDUAL,
    MOST,
    most,
    outliers,
    steps,
)
from contactstudy.profiles.profile_file import SUFFIXES, FilePoints, read_points
from contactstudy.profiles.scatter import doubted
from contactstudy.profiles.worn_csv import points_of_csv
from contactstudy.profiles.worn_faults import POINTS, wrong_extent, wrong_order, wrong_width

Body = Literal["rail", "wheel"]

SPACINGS = (1.0, 1.07, 1.2, 1.4)
"""Distances of knots that are tried, over the least: where knots lie beside the joints of arcs is
chance, and the curvature swings there."""


def worn_curve(
    path: str | Path,
    body: Body,
    unit: str | None = None,
    smoothing: float = KNOTS,
    ways: tuple[Way, Way] = ("own", "own"),
) -> ProfileCurve:
    """Smooth profile through the measured points of a CSV file.

    A cubic spline by arc length is fitted by least squares along the normal, with knots
    `smoothing` or more apart, of several spacings that with the least Schwarz criterion: where the
    points' scatter does not ask for a knot there is none (`contactstudy.profiles.cloud`).

    Parameters
    ----------
    path : str or Path
        Comma-separated file, columns ``y`` and ``z``, points in walking order in either
        direction. y is positive to the field side, from the rail's middle plane or the wheel's
        tape circle; z is up. The header may state the unit: ``y [mm],z [mm]``.
    body : {"rail", "wheel"}
        Which of the two it is; the body lies below or above the curve.
    unit : {"mm", "m"}, optional
        Where the header does not state it.
    smoothing : float
        Least distance of the spline's knots [m].
    ways : tuple of str
        Where the file's y and z point; "own" is to the field side and up, in files of MiniProf and
        Simpack what their shape says.

    Returns
    -------
    ProfileCurve
        s = 0 and z = 0 at y = 0; `residual` is the RMS distance of the points from it [m].

    Raises
    ------
    InputError
        With every fault of the file: unreadable, missing columns, no unit or two, cells that are
        no numbers, points that repeat or go back, too few, gaps, an impossible width, or y = 0
        beyond the ends.
    """
    file = Path(path)
    if not smoothing > 0:
        raise InputError(f"{file}: smoothing = {smoothing:g} m; allowed: above 0")
    problems: list[str] = []
    foreign = file.suffix.lower() in SUFFIXES
    if foreign:
        read, unit = read_points(file, body), "mm"
    else:
        read, unit = points_of_csv(file, unit, problems)
    own = ways == ("own", "own")
    if foreign and own and (wrong := wrong_width(file, read.points, unit)):
        raise InputError(wrong)
    if foreign and own:
        read = _turned(file, read, body)
    elif foreign:
        read = _with_tape_circle(file, replace(read, points=turned(read.points, ways)[0]), body)
    else:
        read = replace(read, points=turned(read.points, ways)[0])
        problems += wrong_order(file, read.points, read.lines)
    problems += wrong_extent(file, read.points, read.lines, unit)
    if problems:
        raise InputError(problems)
    shape = shape_of_wheel if body == "wheel" else shape_of_rail
    if faults := shape(read.points).faults(body, ways):
        raise InputError(f"{file}: does not look like a {body}: {fault}" for fault in faults)
    points, notes = _without_outliers(file, read)
    curve = fitted_curve(points, body, smoothing, file.name)
    if curve.residual > LARGEST_RESIDUAL:
        raise InputError(
            f"{file}: the residual of the fitted curve is {1e6 * curve.residual:.4g} um rms; "
            f"allowed: up to {1e6 * LARGEST_RESIDUAL:g} um"
        )
    return replace(curve, notes=(*notes, *curve.notes))


def _turned(file: Path, read: FilePoints, body: Body) -> FilePoints:
    """Points of another program in our axes: its shape says z, and y of a wheel.

    Rails of Simpack have y to the field side, those of MiniProf to the gauge side.
    """
    p = read.points.copy()
    if len(p) < POINTS:
        return read
    wheel = body == "wheel"
    found = shape_of_wheel(p) if wheel else shape_of_rail(p)
    y, z = found.y, found.z
    if not z:
        raise InputError(f"{file}: {found.told} to be seen, so that it may be upside down")
    if not wheel:
        y = -1 if file.suffix.lower() == ".ban" else 1
    p *= (y, z)
    notes = [*read.notes]
    other = [name for name, factor in (("y", y), ("z", z)) if factor < 0]
    if other:
        notes.append(f"{file.name}: {' and '.join(other)} turned; {found.told} in the file's axes")
    return _with_tape_circle(file, FilePoints(p, read.lines, notes), body)


def _with_tape_circle(file: Path, read: FilePoints, body: Body) -> FilePoints:
    """A wheel whose points begin at the flange back, moved to have its tape circle at y = 0."""
    p = read.points
    if body == "rail" or not len(p) or p[:, 0].min() < -0.02:
        return read
    back = TAPE + min(float(p[:, 0].min()), 0.0)
    told = f"{file.name}: tape circle {1e3 * TAPE:g} mm from the flange back at y = 0"
    return FilePoints(p - [back, 0.0], read.lines, [*read.notes, told])


def _without_outliers(file: Path, read: FilePoints) -> tuple[Array, list[str]]:
    """Points without those that are off by themselves, and what is to be said of them."""
    which, off = outliers(read.points)
    if len(which) > most(len(read.points)):
        raise InputError(
            f"{file}: more than {100 * MOST:g} % of its points lie off their neighbours, the first "
            f"in line {read.lines[which[0]]} by {1e6 * off[0]:.3g} um: too much scatter for "
            "contact stresses"
        )
    notes = [
        f"{file.name}, line {read.lines[k]}: {1e6 * d:.3g} um off its neighbours, left out"
        for k, d in zip(which, off, strict=True)
    ]
    points, lines = np.delete(read.points, which, axis=0), np.delete(read.lines, which)
    notes += [
        f"{file.name}, line {lines[k]}: from here on the points lie {1e6 * height:.3g} um "
        f"higher or lower, a step that bends the curve by about {bend:.2g} 1/m (a 60E1 crown has "
        "3.3 1/m)"
        for k, height, bend in zip(*steps(points), strict=True)
        if bend > BEARABLE
    ]
    return points, [*read.notes, *notes]


def fitted_curve(
    points: Array, body: Body, smoothing: float = KNOTS, name: str = "worn profile"
) -> ProfileCurve:
    """Smooth profile through points (n, 2) = (y, z) along which y grows [m], as in `worn_curve`."""
    spacings = [smoothing * factor for factor in SPACINGS]
    fits = [fit_cloud(points, spacing, name) for spacing in spacings]
    fit = min(fits, key=lambda fit: fit.criterion)
    # z = 0 at y = 0: Newton along the curve from the nearest point
    s = float(fit.s[np.argmin(np.abs(points[:, 0]))])
    for _ in range(20):
        s = float(np.clip(s - fit.spline(s)[0] / fit.spline(s, 1)[0], 0.0, fit.length))
    down = np.array([0.0, float(fit.spline(s)[1])])
    curve = fit.curve(down, body == "rail", name)
    told = doubted(curve, fit.scatter, len(points), spacings)
    return replace(curve, notes=(told,) if told else ())

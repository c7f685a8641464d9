"""Worn profiles of rail and wheel from CSV files."""

import re
from pathlib import Path
from typing import Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.csv_rows import finite_number, listed, read_rows
from contactstudy.exceptions import InputError
from contactstudy.profiles.cloud import fit_cloud
from contactstudy.profiles.curve import ProfileCurve

Body = Literal["rail", "wheel"]

UNITS = {"m": 1.0, "mm": 1e-3}
POINTS = 20
"""Fewest points of a profile."""
WIDTHS = (0.02, 0.3)
"""Narrowest and widest profile [m]: anything else has the wrong unit."""
LARGEST_GAP = 4e-3
"""Longest stretch without a point [m]."""


def worn_curve(
    path: str | Path, body: Body, unit: str | None = None, smoothing: float = 1e-3
) -> ProfileCurve:
    """Smooth profile through the measured points of a CSV file.

    A cubic spline by arc length is fitted by least squares along the normal, with knots
    `smoothing` or more apart: where the points' scatter does not ask for a knot there is none
    (`contactstudy.profiles.cloud`).

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
    rows = read_rows(file)
    header = [cell.strip() for cell in rows[0][1]]
    index, stated, problems = _columns(file, rows[0][0], header, unit)
    if not smoothing > 0:
        problems.append(f"{file}: smoothing = {smoothing:g} m; allowed: above 0")
    if problems:
        raise InputError(problems)
    points, lines, faults = _points(rows[1:], index, header)
    points *= UNITS[stated]
    problems = listed(file, faults) + _order(file, points, lines)
    problems += _extent(file, points, lines, stated)
    if problems:
        raise InputError(problems)
    return fitted_curve(points, body, smoothing, file.name)


def fitted_curve(
    points: Array, body: Body, smoothing: float = 1e-3, name: str = "worn profile"
) -> ProfileCurve:
    """Smooth profile through points (n, 2) = (y, z) along which y grows [m], as in `worn_curve`."""
    fit = fit_cloud(points, smoothing, name)
    # z = 0 at y = 0: Newton along the curve from the nearest point
    s = float(fit.s[np.argmin(np.abs(points[:, 0]))])
    for _ in range(20):
        s = float(np.clip(s - fit.spline(s)[0] / fit.spline(s, 1)[0], 0.0, fit.length))
    down = np.array([0.0, float(fit.spline(s)[1])])
    return fit.curve(down, body == "rail", name)


def _columns(
    path: Path, line: int, header: list[str], unit: str | None
) -> tuple[list[int], str, list[str]]:
    """Places of the columns y and z, the unit, and what is wrong with the header."""
    problems, index, units = [], [], {unit} - {None}
    for name in ("y", "z"):
        found = [
            (k, match.group(1))
            for k, cell in enumerate(header)
            if (match := re.fullmatch(rf"{name}\s*(?:[\[(_ ]\s*([^\])\s]+)\s*[\])]?)?", cell))
        ]
        if len(found) != 1:
            problems.append(
                f"{path}, line {line}: there is {'no' if not found else 'more than one'} column "
                f"'{name}'; the file has: {', '.join(header)}"
            )
            continue
        index.append(found[0][0])
        units |= {found[0][1]} - {None}
    if len(units) != 1 or not units <= set(UNITS):
        given = " and ".join(f"'{u}'" for u in sorted(str(u) for u in units)) or "not stated"
        problems.append(
            f"{path}: the unit of y and z is {given}; allowed: mm or m, in the header as "
            "'y [mm],z [mm]' or beside the file's name"
        )
    return index, str(next(iter(units), "")), problems


def _points(
    rows: list[tuple[int, list[str]]], index: list[int], header: list[str]
) -> tuple[Array, list[int], list[str]]:
    """Points (n, 2) with their line numbers, and the cells that are no numbers."""
    points, lines, faults = [], [], []
    for line, cells in rows:
        values = []
        for k in index:
            cell = cells[k].strip() if k < len(cells) else ""
            value = finite_number(cell)
            if value is None:
                shown = f"'{cell}'" if cell else "empty"
                faults.append(
                    f"line {line}, column '{header[k]}' is {shown}; allowed: finite numbers"
                )
            else:
                values.append(value)
        if len(values) == 2:
            points.append(values)
            lines.append(line)
    return np.array(points, dtype=float).reshape(-1, 2), lines, faults


def _order(path: Path, points: Array, lines: list[int]) -> list[str]:
    """Points that repeat or go back on the walk, which may lead either way."""
    y = points[:, 0]
    steps = np.diff(y)
    if not len(steps):
        return []
    if np.median(steps) < 0:
        steps = -steps
    faults = [
        f"line {lines[k + 1]}: y = {1e3 * y[k + 1]:g} mm "
        + ("repeats" if steps[k] == 0 else "goes back behind")
        + f" line {lines[k]} ({1e3 * y[k]:g} mm); allowed: y grows, or falls, all the way"
        for k in np.flatnonzero(steps <= 0)
    ]
    return listed(path, faults)


def _extent(path: Path, points: Array, lines: list[int], unit: str) -> list[str]:
    """Too few points, gaps between them, an impossible width, no point at y = 0."""
    if len(points) < POINTS:
        return [f"{path}: {len(points)} points; allowed: {POINTS} or more"]
    problems = []
    low, high = float(points[:, 0].min()), float(points[:, 0].max())
    if not WIDTHS[0] <= high - low <= WIDTHS[1]:
        problems.append(
            f"{path}: the profile is {1e3 * (high - low):.4g} mm wide with y in {unit}; allowed: "
            f"{1e3 * WIDTHS[0]:g} to {1e3 * WIDTHS[1]:g} mm (is the unit right?)"
        )
        return problems
    if not low < 0.0 < high:
        problems.append(
            f"{path}: y goes from {1e3 * low:.4g} to {1e3 * high:.4g} mm; allowed: from below to "
            "above 0, the rail's middle plane or the wheel's tape circle"
        )
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    faults = [
        f"between lines {lines[k]} and {lines[k + 1]}: {1e3 * chords[k]:.3g} mm without a point; "
        f"allowed: at most {1e3 * LARGEST_GAP:g} mm"
        for k in np.flatnonzero(chords > LARGEST_GAP)
    ]
    return problems + listed(path, faults)

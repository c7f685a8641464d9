"""A wheel with a flat pressed on a rail, over its pitch angle, against the half-space."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.augmented import Penalty
from contactstudy.contact.press import press_curve
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.geometry.points import ContactPoints
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.halfspace.love import LoveGrid, contact_pressure
from contactstudy.irregularity import Flat, RollingDefect, RoundedFlat, TreadLines
from contactstudy.irregularity.flats import LocalDefect
from contactstudy.plot.curves import Plot, curve
from contactstudy.verification.cases.flat_shapes import (
    LENGTH,
    RADIUS,
    Depth,
    dish_depth,
    dish_map,
    fresh_depth,
    rounded_depth,
)
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.halfspace_block import HalfSpaceBlock
from contactstudy.verification.cases.pressed_blocks import block_points
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_shown

CROWN, LOAD = 0.30, 67.4e3
PITCH = (0.0, 0.75, 1.5, 2.5)
"""Degrees from the middle of the flat."""
HALF_LENGTH, HALF_WIDTH, SIZE = 0.024, 0.012, 1e-3
"""Of the contact points' grid, and its mesh, m."""
CELLS, HEIGHT, BREADTH = (256, 192), 0.052, 0.026
"""Of the half-space, and the sides of its grid in m."""
STEP = 0.1
"""Part of the load by which it is changed for the gradient."""
APPROACH_BAND, PEAK_BAND = 0.02, 0.05

METHOD = (
    "A cylindrical wheel of 0.43 m stands on a crown of 0.30 m under 67.4 kN, turned by pitch "
    "angles from the middle of its defect on: a fresh flat of 30 mm, one of the same depth with "
    "rounded ends, and a worn dish, 26 mm by 20 mm and 60 µm deep, whose bottom nearly fits the "
    "rail's crown. The dish is a depth map over s and y in a file, as a study names it. The bodies "
    "are two half-spaces of the program's hexahedra, 1 mm at the surface, as in hertz_ellipses: "
    "Gauss points, spline, penalty and "
    "active set are the program's. The reference is Love's half-space on 0.2 mm by 0.14 mm cells "
    "over gaps that are written down for this case alone; Tamaas agrees with it (tamaas_codes). "
    "The gradient is that of the force over the approach, between 0.9 and 1.1 of the load.\n\n"
    "The peak pressure of the fresh flat is reported, not judged: at its ends the profile has "
    "edges of 2°, under which the pressure of elastic bodies grows without bound as the cells get "
    "smaller."
)


@dataclass(frozen=True)
class Pressed:
    """Approach from the round wheel's touch [m], force gradient [N/m], peak pressure [Pa]."""

    approach: float
    gradient: float
    peak: float


@cache
def bodies() -> tuple[ContactPoints, Array]:
    """Contact points in y >= 0 without a defect, and their flexibility (n, n) [m/N]."""
    outer, n, m = 0.15, round(HALF_LENGTH / SIZE), round(HALF_WIDTH / SIZE)
    along = graded_lines(HALF_LENGTH + 2 * SIZE, SIZE, outer, 1.5)
    x = np.concatenate([-along[:0:-1], along])
    y = graded_lines(HALF_WIDTH + 2 * SIZE, SIZE, outer, 1.5)
    depth = graded_lines(6 * SIZE, SIZE, outer, 1.5)
    block = HalfSpaceBlock(x, y, depth, symmetric=(False, True))
    middle = len(along) - 1
    patch = block.patch((slice(middle - n - 2, middle + n + 3), slice(0, m + 3)))
    points = block_points(patch.x[2:-2], patch.y[: m + 1], (RADIUS, CROWN), "gauss")
    points = replace(points, area=0.5 * points.area)  # two images each, not four
    lower = np.kron(SplineLine(patch.x)(points.x), SplineLine(patch.y, mirrored=True)(points.y))
    row, column = np.divmod(points.wheel_rows.index, m + 1)
    index = (row + 2) * len(patch.y) + column
    upper = replace(points.wheel_rows, index=index).matrix(len(patch.x) * len(patch.y))
    F = patch.flexibility
    return points, lower @ F @ lower.T + upper @ F @ upper.T


def solid(defect: LocalDefect, pitch: float) -> Pressed:
    """The program's press at a pitch angle [deg] from the middle of a defect at X = 0."""
    points, flexibility = bodies()
    lines = TreadLines(points.y, np.zeros(len(points.y)))
    X = RADIUS * np.deg2rad(pitch)
    level = RollingDefect(defect, RADIUS).level(X + points.x, lines).ravel()
    here = replace(points, gap=points.gap - level)
    loads = LOAD * np.array([1 - STEP, 1.0, 1 + STEP])
    curve_ = press_curve(here, flexibility, loads, Penalty(1e16))
    peak = float(points.nodal_pressure(curve_.solutions[1].forces).max())
    low, middle, high = curve_.approach
    return Pressed(float(middle), 2 * STEP * LOAD / float(high - low), peak)


def half_space(depth: Depth, pitch: float) -> Pressed:
    """The half-space's press at the same place."""
    from scipy.optimize import brentq

    (nx, ny), modulus = CELLS, contact_modulus(210e9, 0.3)
    grid = LoveGrid(CELLS, HEIGHT / nx, BREADTH / ny, modulus)
    x = np.asarray((np.arange(nx) - 0.5 * (nx - 1)) * grid.width, dtype=np.float64)
    y = np.asarray((np.arange(ny) - 0.5 * (ny - 1)) * grid.breadth, dtype=np.float64)
    s = RADIUS * float(np.deg2rad(pitch)) + x[:, None]
    gap = x[:, None] ** 2 / (2 * RADIUS) + y**2 / (2 * CROWN) + depth(s, y)

    def pressure(approach: float) -> Array:
        return contact_pressure(grid, np.asarray(gap - approach))

    def excess(approach: float, load: float) -> float:
        return float(pressure(approach).sum()) * grid.cell_area - load

    first = float(gap.min())
    found = [
        float(brentq(excess, first, first + 3e-4, args=(share * LOAD,), xtol=1e-10))
        for share in (1 - STEP, 1.0, 1 + STEP)
    ]
    peak = float(pressure(found[1]).max())
    return Pressed(found[1], 2 * STEP * LOAD / (found[2] - found[0]), peak)


def wheel_flat() -> CaseResult:
    """Approach, force gradient and peak pressure over the pitch angle."""
    checks: list[Check] = []
    rows: list[tuple[str | float, ...]] = []
    plots = []
    source = "half-space, Love (1929)"
    with tempfile.TemporaryDirectory() as folder:
        shapes: dict[str, tuple[LocalDefect, Depth]] = {
            "fresh flat": (Flat(at=0.0, length=LENGTH), fresh_depth),
            "rounded flat": (RoundedFlat(at=0.0, length=LENGTH), rounded_depth),
            "worn dish": (dish_map(Path(folder)), dish_depth),
        }
        for name, (defect, depth) in shapes.items():
            pairs = [(solid(defect, p), half_space(depth, p)) for p in PITCH]
            for pitch, (own, exact) in zip(PITCH, pairs, strict=True):
                peak_band = None if name == "fresh flat" else PEAK_BAND
                of = f"{name}, {pitch:g}°"
                checks += [
                    check_shown(f"{of}: approach", own.approach, exact.approach, "µm", source,
                                APPROACH_BAND),
                    Check(f"{of}: force gradient", own.gradient * 1e-9, exact.gradient * 1e-9,
                          "GN/m", source, APPROACH_BAND),
                    check_shown(f"{of}: peak pressure", own.peak, exact.peak, "MPa", source,
                                peak_band),
                ]  # fmt: skip
                rows.append((name, pitch, 1e6 * own.approach, 1e-9 * own.gradient, 1e-6 * own.peak))
            plots.append((name, pairs))
    return CaseResult(
        "wheel_flat",
        "Wheel with a flat: static press over the pitch angle",
        METHOD,
        tuple(checks),
        (ResultTable("The program's press.", _HEADER, tuple(rows)),),
        (_plot(plots),),
    )


_HEADER = ("defect", "pitch (°)", "approach (µm)", "gradient (GN/m)", "peak (MPa)")


def _plot(found: list[tuple[str, list[tuple[Pressed, Pressed]]]]) -> Plot:
    curves = []
    for name, pairs in found:
        computed = [1e-9 * own.gradient for own, _ in pairs]
        curves.append(curve(name, np.array(PITCH), computed, "points"))
        exact = [1e-9 * e.gradient for _, e in pairs]
        curves.append(curve(f"{name}, half-space", np.array(PITCH), exact, "reference"))
    return Plot(
        "Gradient of the force over the approach at 67.4 kN against the pitch angle.",
        "Pitch angle (°)",
        "Gradient (GN/m)",
        tuple(curves),
    )

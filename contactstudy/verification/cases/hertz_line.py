"""Hertz's line contact: a cylinder on a flat, in plane strain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.contact.complementarity import press
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.geometry.quadrature import point_line
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.hertz_ellipses import (
    APPROACH_BAND,
    BAND,
    HERTZ,
    PENALTY,
    error_plot,
    order_check,
)
from contactstudy.verification.cases.line_contact import line_contact
from contactstudy.verification.cases.pressed_blocks import GROWTH, MARGIN, OUTER, REACH
from contactstudy.verification.cases.strip import Strip
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_shown

RADIUS = 0.43
LOADS = (2e6, 6e6, 20e6)
"""N/m."""
CURVE_LOADS = tuple(np.geomspace(2e6, 20e6, 9))
MESHES = (3, 6, 12, 24)
"""Elements over the half width at the largest load."""
YOUNG, POISSON = 210e9, 0.3

METHOD = (
    "A cylinder of R = 0.43 m lies on a flat; both are half-planes of the program's hexahedra (one "
    "layer in plane strain, E = 210 GPa, ν = 0.3). On their outer faces they have the "
    "displacements of a line load, for each nodal load separately. Gauss points, spline, penalty "
    "(10¹⁶ Pa/m) and active set are the program's own.\n\n"
    "Half width and peak pressure are those of Hertz's strip with the resultant and the second "
    "moment of the computed pressure, <x²> = b²/4 and P = π b p₀/2; the largest nodal pressure (L2 "
    "projection) stands beside them.\n\n"
    "A half-plane under a line load sinks without bound, so the approach of a line contact is that "
    "of two chosen points. It is measured here between the points 10 half widths (of the largest "
    "load) below each load in both bodies, for which Johnson, Contact Mechanics (1985), eq. (5.58) "
    "gives δ = 2 P (1−ν²)/(πE) [2 ln(2d/b) − ν/(1−ν)]."
)


@dataclass(frozen=True)
class _Line:
    """Computed and exact values of one load: half width, peak, nodal peak, approach (SI)."""

    load: float
    elements: float
    computed: tuple[float, float, float, float]
    exact: tuple[float, float, float, float]

    @property
    def errors(self) -> tuple[float, ...]:
        return tuple(c / e - 1 for c, e in zip(self.computed, self.exact, strict=True))


def line() -> CaseResult:
    """Cylinder on a flat over a decade of loads."""
    loads = np.array(sorted({*CURVE_LOADS, *LOADS}))
    found = {n: _pressed(n, loads) for n in MESHES}
    finest = [one for one in found[MESHES[-1]] if one.load in LOADS]
    checks = [check for one in finest for check in _checks(one)]
    every = [one for mesh in found.values() for one in mesh]
    over = [one.elements for one in every]
    width, peak, nodal, approach = ([abs(one.errors[k]) for one in every] for k in range(4))
    checks += [order_check("half width", over, width), order_check("peak", over, peak)]
    drawn = {"half width": width, "peak, nodes": nodal, "approach": approach}
    plot = error_plot(
        "Difference from Hertz",
        "the half width",
        {name: (over, errors) for name, errors in drawn.items()},
        (max(over), 10.0),
    )
    rows = tuple(
        (n, one.load * 1e-6, *(round(100 * e, 2) for e in one.errors))
        for n, mesh in found.items()
        for one in mesh
        if one.load in LOADS
    )
    header = ("elements at 20 MN/m", "load (MN/m)", "b", "peak", "peak, nodes", "approach")
    n = MESHES[-1]
    method = (
        f"{METHOD}\n\nThe finest mesh has {n} elements over the half width at 20 MN/m, so "
        f"{n / 10**0.5:.1f} at 2 MN/m."
    )
    return CaseResult(
        "hertz_line",
        "Cylinder on a flat, a decade of loads",
        method,
        tuple(checks),
        (ResultTable("All meshes: difference from Hertz in per cent.", header, rows),),
        (plot,),
    )


def _pressed(elements: int, loads: np.ndarray) -> list[_Line]:
    modulus = contact_modulus(YOUNG, POISSON)
    largest = line_contact(float(loads.max()), modulus, RADIUS).half_width
    datum, h, n = 10 * largest, largest / elements, round(REACH * elements)
    x = graded_lines((n + MARGIN) * h, h, (OUTER + 1) * largest, GROWTH)
    z = graded_lines(0.75 * largest, h, OUTER * largest, GROWTH)
    size = n + MARGIN + 1
    c = (1 - POISSON**2) / (np.pi * YOUNG)
    F = Strip(x, z, YOUNG, POISSON).displacement(size)[:size, 0, 1]
    # measured from the point at the depth `datum`, which the line load moves by -2 c ln(datum)
    F = 0.5 * (F + F.T) + 2 * c * np.log(datum)
    points = point_line(x[: n + 1], "gauss")
    lower = SplineLine(x[:size], mirrored=True)(points.at)
    upper = points.rows.matrix(size)
    area = 2 * points.weight  # both halves, unit thickness
    M = lower @ F @ lower.T + upper @ F @ upper.T + np.diag(1 / (PENALTY * area))
    gap = points.at**2 / (2 * RADIUS)
    made = []
    for load in map(float, loads):
        solution = press(M, gap, np.ones(len(gap)), load)
        width = float(np.sqrt(4 * (solution.forces @ points.at**2) / load))
        nodal = float(((upper.T @ solution.forces)[: n + 1] / (upper.T @ area)[: n + 1]).max())
        exact = line_contact(load, modulus, RADIUS)
        p0 = exact.peak_pressure
        bracket = 2 * np.log(2 * datum / exact.half_width) - POISSON / (1 - POISSON)
        made.append(
            _Line(
                load,
                elements * exact.half_width / largest,
                (width, 2 * load / (np.pi * width), nodal, solution.approach),
                (exact.half_width, p0, p0, float(2 * load * c * bracket)),
            )
        )
    return made


def _checks(one: _Line) -> list[Check]:
    names = ("half width", "peak", "peak, nodes", "approach")
    judged = (("mm", HERTZ, BAND), ("MPa", HERTZ, BAND), ("MPa", HERTZ, BAND),
              ("µm", "Johnson (1985), eq. (5.58)", APPROACH_BAND))  # fmt: skip
    return [
        check_shown(f"{one.load * 1e-6:g} MN/m: {name}", computed, exact, *how)
        for name, how, computed, exact in zip(names, judged, one.computed, one.exact, strict=True)
    ]

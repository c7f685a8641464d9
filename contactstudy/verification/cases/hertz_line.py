"""Hertz's line contact: a cylinder on a flat, in plane strain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contactstudy.compare.convergence import fitted_order
from contactstudy.contact.complementarity import press
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.geometry.quadrature import point_line
from contactstudy.halfspace.hertz import contact_modulus
from contactstudy.plot.curves import Plot, curve
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.hertz_ellipses import APPROACH_BAND, BAND, HERTZ, PENALTY
from contactstudy.verification.cases.line_contact import line_contact
from contactstudy.verification.cases.strip import Strip
from contactstudy.verification.check import CaseResult, Check, ResultTable

RADIUS = 0.43
LOADS = (2e6, 6e6, 20e6)
"""N/m."""
CURVE_LOADS = tuple(np.geomspace(2e6, 20e6, 9))
MESHES = (3, 6, 12, 24)
"""Elements over the half width at the largest load."""
YOUNG, POISSON = 210e9, 0.3
_MARGIN, _REACH, _OUTER, _GROWTH = 2, 1.25, 5.0, 1.5

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
    sizes = [1 / one.elements for one in every]
    for index, quantity in ((0, "half width"), (1, "peak")):
        order = fitted_order(sizes, [abs(one.errors[index]) for one in every])
        checks.append(
            Check(f"observed order, {quantity}", order, 1.0, "", "least expected", 0.0, "at_least")
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
        (_plot(every),),
    )


def _pressed(elements: int, loads: np.ndarray) -> list[_Line]:
    modulus = contact_modulus(YOUNG, POISSON)
    largest = line_contact(float(loads.max()), modulus, RADIUS).half_width
    datum, h, n = 10 * largest, largest / elements, round(_REACH * elements)
    x = graded_lines((n + _MARGIN) * h, h, (_OUTER + 1) * largest, _GROWTH)
    z = graded_lines(0.75 * largest, h, _OUTER * largest, _GROWTH)
    size = n + _MARGIN + 1
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
        bracket = 2 * np.log(2 * datum / exact.half_width) - POISSON / (1 - POISSON)
        made.append(
            _Line(
                load,
                elements * exact.half_width / largest,
                (width, 2 * load / (np.pi * width), nodal, solution.approach),
                (
                    exact.half_width,
                    exact.peak_pressure,
                    exact.peak_pressure,
                    float(2 * load * c * bracket),
                ),
            )
        )
    return made


def _checks(one: _Line) -> list[Check]:
    names = ("half width", "peak", "peak, nodes", "approach")
    units = (("mm", 1e3), ("MPa", 1e-6), ("MPa", 1e-6), ("µm", 1e6))
    return [
        Check(
            f"{one.load * 1e-6:g} MN/m: {name}",
            computed * scale,
            exact * scale,
            unit,
            HERTZ if name != "approach" else "Johnson (1985), eq. (5.58)",
            APPROACH_BAND if name == "approach" else BAND,
        )
        for name, (unit, scale), computed, exact in zip(
            names, units, one.computed, one.exact, strict=True
        )
    ]


def _plot(every: list[_Line]) -> Plot:
    n = [one.elements for one in every]
    x = np.array([min(n), max(n)])
    return Plot(
        "Difference from Hertz against the elements over the half width; each point is one load "
        "on one mesh.",
        "Elements over the half width",
        "Difference (%)",
        (
            curve("half width", n, [100 * abs(one.errors[0]) for one in every], "points"),
            curve("peak, nodes", n, [100 * abs(one.errors[2]) for one in every], "points"),
            curve("approach", n, [100 * abs(one.errors[3]) for one in every], "points"),
            curve("second order", x, 10.0 * (x / x[0]) ** -2, "reference"),
        ),
        "log",
        "log",
    )

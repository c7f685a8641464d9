"""Hertz's contact of crossed cylinders, of spheres, and code_aster's SSNV104."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import elliprd

from contactstudy.compare.convergence import fitted_order
from contactstudy.halfspace.hertz import HertzContact, contact_modulus, hertz_contact
from contactstudy.plot.curves import Plot, curve
from contactstudy.verification.cases.pressed_blocks import BlockPress, blocks
from contactstudy.verification.check import CaseResult, Check, ResultTable

RATIOS = (1.0, 1.5, 2.0, 3.0, 4.0)
LOADS = (20e3, 60e3, 200e3)
CURVE_LOADS = tuple(np.geomspace(20e3, 200e3, 7))
"""More loads, so that the scatter of points that enter the patch one by one averages out."""
RADIUS = 0.3
"""Smaller relative radius, m: the crown of 60E1."""
PENALTY = 1e16
"""Pa/m, the program's default."""
BAND, APPROACH_BAND, AREA_BAND = 0.01, 0.02, 0.03

HERTZ = "Hertz, closed form"
METHOD = (
    "Two half-spaces (E = 210 GPa, ν = 0.3) are finite blocks of the program's hexahedra; on their "
    "outer faces they have, for each nodal load, the displacements of Boussinesq's point load. So "
    "the far field is exact and the approach, of points far away in both bodies, needs no "
    "correction. Over them lies Hertz's gap x²/2R_x + y²/2R_y. The rest is the program's own: "
    "Gauss points on the upper body's facets, spline through the lower body's nodes, penalty "
    "10¹⁶ Pa/m, active set.\n\n"
    "Semi-axes and peak pressure are those of the ellipse of Hertz with the resultant and the "
    "second moments of the computed pressure: integrals, which the points that enter the patch one "
    "by one disturb least. The largest nodal pressure (L2 projection) stands beside it; it is held "
    "to the same band from 12 elements over the semi-axis at the largest load on. The area is that "
    "which a run reports, from the gap around the patch."
)


@dataclass(frozen=True)
class _Errors:
    """Relative errors of one load on one mesh, against elements over the smaller semi-axis."""

    elements: float
    peak: float
    axes: float
    approach: float


def relative_radii(ratio: float) -> tuple[float, float]:
    """Radii (R_x, R_y) in m whose ellipse has the semi-axes a_x/a_y = `ratio` >= 1.

    R_x/R_y = R_D(0, 1, k)/R_D(0, k, 1) with k = 1/ratio^2, see `contactstudy.halfspace.hertz`.
    """
    k = 1.0 / ratio**2
    return RADIUS * float(elliprd(0.0, 1.0, k) / elliprd(0.0, k, 1.0)), RADIUS


def ellipses() -> CaseResult:
    """Crossed cylinders with semi-axis ratios 1 to 4 over a decade of loads."""
    return _study(
        "hertz_ellipses",
        "Crossed cylinders, semi-axis ratios 1 to 4, a decade of loads",
        RATIOS,
        (3, 6, 12),
    )


def sphere() -> CaseResult:
    """Sphere on a flat over a decade of loads, on meshes that take seconds."""
    return _study("hertz_sphere", "Sphere on a flat, a decade of loads", (1.0,), (2, 4, 8))


def _study(name: str, title: str, ratios: tuple[float, ...], meshes: tuple[int, ...]) -> CaseResult:
    checks: list[Check] = []
    rows: list[tuple[float, ...]] = []
    errors: dict[float, list[_Errors]] = {}
    for ratio in ratios:
        errors[ratio] = []
        for elements in meshes:
            for load in sorted({*CURVE_LOADS, *LOADS}):
                exact, found = _pressed(ratio, elements, load)
                errors[ratio].append(_compared(exact, found, elements, ratio))
                if elements == meshes[-1] and load in LOADS:
                    checks += _checks(ratio, exact, found, BAND if elements >= 12 else None)
                if load in LOADS:
                    rows.append(_row(ratio, elements, exact, found))
    every = [e for found in errors.values() for e in found]
    for quantity, order in _orders(every).items():
        checks.append(
            Check(f"observed order, {quantity}", order, 1.0, "", "least expected", 0.0, "at_least")
        )
    n = meshes[-1]
    method = (
        f"{METHOD}\n\nThe finest mesh has {n} elements over each semi-axis at 200 kN, so "
        f"{n / 10 ** (1 / 3):.1f} at 20 kN; the others have "
        f"{' and '.join(map(str, meshes[:-1]))}. The checks are those of the finest mesh."
    )
    return CaseResult(
        name,
        title,
        method,
        tuple(checks),
        (ResultTable("All meshes: difference from Hertz in per cent.", _HEADER, tuple(rows)),),
        (_plot(errors),),
    )


def _pressed(ratio: float, elements: int, load: float) -> tuple[HertzContact, BlockPress]:
    radii = relative_radii(ratio)
    exact = hertz_contact(load, contact_modulus(), *radii)
    largest = hertz_contact(max(LOADS), contact_modulus(), *radii)
    bodies = blocks((largest.semi_axis_x, largest.semi_axis_y), elements, radii)
    return exact, bodies.press(load, PENALTY)


def _checks(
    ratio: float, exact: HertzContact, found: BlockPress, nodal_band: float | None
) -> list[Check]:
    where = f"a/b = {ratio:g}, {exact.load * 1e-3:g} kN"
    values = (
        ("semi-axis a", found.ellipse.along * 1e3, exact.semi_axis_x * 1e3, "mm", BAND),
        ("semi-axis b", found.ellipse.across * 1e3, exact.semi_axis_y * 1e3, "mm", BAND),
        ("peak", found.ellipse.peak_pressure * 1e-6, exact.peak_pressure * 1e-6, "MPa", BAND),
        ("peak, nodes", found.nodal_pressure * 1e-6, exact.peak_pressure * 1e-6, "MPa", nodal_band),
        ("approach", found.approach * 1e6, exact.approach * 1e6, "µm", APPROACH_BAND),
        ("area", found.area * 1e6, exact.area * 1e6, "mm²", AREA_BAND),
    )
    return [
        Check(f"{where}: {quantity}", computed, reference, unit, HERTZ, band)
        for quantity, computed, reference, unit, band in values
    ]


def _compared(exact: HertzContact, found: BlockPress, elements: int, ratio: float) -> _Errors:
    # patches grow with the cube root of the load
    over = elements * (exact.load / max(LOADS)) ** (1 / 3)
    a = abs(found.ellipse.along / exact.semi_axis_x - 1)
    b = abs(found.ellipse.across / exact.semi_axis_y - 1)
    return _Errors(
        over,
        abs(found.ellipse.peak_pressure / exact.peak_pressure - 1),
        max(a, b),
        abs(found.approach / exact.approach - 1),
    )


_HEADER = ("a/b", "elements at 200 kN", "load (kN)", "a", "b", "peak", "peak, nodes", "approach")


def _row(ratio: float, elements: int, exact: HertzContact, found: BlockPress) -> tuple[float, ...]:
    pairs = (
        (found.ellipse.along, exact.semi_axis_x),
        (found.ellipse.across, exact.semi_axis_y),
        (found.ellipse.peak_pressure, exact.peak_pressure),
        (found.nodal_pressure, exact.peak_pressure),
        (found.approach, exact.approach),
    )
    percent = tuple(round(100 * (computed / reference - 1), 2) for computed, reference in pairs)
    return (ratio, elements, exact.load * 1e-3, *percent)


def _orders(errors: list[_Errors]) -> dict[str, float]:
    size = [1 / e.elements for e in errors]
    return {
        "peak": fitted_order(size, [e.peak for e in errors]),
        "semi-axes": fitted_order(size, [e.axes for e in errors]),
        "approach": fitted_order(size, [e.approach for e in errors]),
    }


def _plot(errors: dict[float, list[_Errors]]) -> Plot:
    curves = [
        curve(
            f"peak, a/b = {ratio:g}",
            [e.elements for e in found],
            [100 * e.peak for e in found],
            "points",
        )
        for ratio, found in errors.items()
    ]
    x = np.array([min(e.elements for f in errors.values() for e in f), 12.0])
    curves.append(curve("second order", x, 4.0 * (x / x[0]) ** -2, "reference"))
    return Plot(
        "Difference of the peak pressure from Hertz's against the elements over a semi-axis; each "
        "point is one load on one mesh.",
        "Elements over a semi-axis",
        "Difference (%)",
        tuple(curves),
        "log",
        "log",
    )


def ssnv104() -> CaseResult:
    """Two spheres crushed by a given approach: the analytical case SSNV104 of code_aster."""
    radius, crush = 0.05, 4e-3
    relative = radius / 2  # 1/R = 1/R1 + 1/R2
    # a^2 = R approach
    axis = float(np.sqrt(relative * crush))
    bodies = blocks((axis, axis), 10, (relative, relative), 20e9, 0.3)
    found = bodies.crush(crush, PENALTY)
    modulus = contact_modulus(20e9, 0.3)
    load = 4 / 3 * modulus * float(np.sqrt(relative)) * crush**1.5
    source = "code_aster, SSNV104"
    checks = (
        Check("σ_zz at the centre", -found.nodal_pressure * 1e-6, -2798.3, "MPa", source, BAND),
        Check(
            "peak pressure (moments)",
            found.ellipse.peak_pressure * 1e-6,
            2798.3,
            "MPa",
            source,
            BAND,
        ),
        Check("contact radius", found.ellipse.along * 1e3, 10.0, "mm", source, BAND),
        Check("force", found.load * 1e-3, load * 1e-3, "kN", HERTZ, APPROACH_BAND),
    )
    method = (
        "Two spheres of R = 50 mm, E = 20 GPa, ν = 0.3 are crushed by 4 mm. The published values "
        "are Hertz's; both bodies are half-spaces here, as in his theory, with Boussinesq's "
        "displacements on the outer faces of the blocks and 10 elements over the radius of the "
        "patch. σ_zz is minus the largest nodal pressure."
    )
    return CaseResult("ssnv104", "Two spheres crushed by 4 mm (SSNV104)", method, checks)

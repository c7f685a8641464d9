"""Hertz's contact of crossed cylinders, of spheres, and code_aster's SSNV104."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import elliprd

from contactstudy.compare.refinement import fitted_order
from contactstudy.halfspace.hertz import HertzContact, contact_modulus, hertz_contact
from contactstudy.plot.curves import Plot, curve
from contactstudy.verification.cases.pressed_blocks import BlockPress, blocks
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_shown

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
    over = [e.elements for e in every]
    checks += [
        order_check("peak", over, [e.peak for e in every]),
        order_check("semi-axes", over, [e.axes for e in every]),
        order_check("approach", over, [e.approach for e in every]),
    ]
    peaks = {
        f"peak, a/b = {ratio:g}": ([e.elements for e in found], [e.peak for e in found])
        for ratio, found in errors.items()
    }
    of = "Difference of the peak pressure from Hertz's"
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
        (error_plot(of, "a semi-axis", peaks, (12.0, 4.0)),),
    )


def _pressed(ratio: float, elements: int, load: float) -> tuple[HertzContact, BlockPress]:
    radii = relative_radii(ratio)
    exact = hertz_contact(load, contact_modulus(), *radii)
    largest = hertz_contact(max(LOADS), contact_modulus(), *radii)
    bodies = blocks((largest.semi_axis_x, largest.semi_axis_y), elements, radii)
    return exact, bodies.press(load, PENALTY)


def _pairs(exact: HertzContact, found: BlockPress) -> dict[str, tuple[float, float]]:
    """Computed and exact values."""
    return {
        "semi-axis a": (found.ellipse.along, exact.semi_axis_x),
        "semi-axis b": (found.ellipse.across, exact.semi_axis_y),
        "peak": (found.ellipse.peak_pressure, exact.peak_pressure),
        "peak, nodes": (found.nodal_pressure, exact.peak_pressure),
        "approach": (found.approach, exact.approach),
    }


def _checks(
    ratio: float, exact: HertzContact, found: BlockPress, nodal_band: float | None
) -> list[Check]:
    where = f"a/b = {ratio:g}, {exact.load * 1e-3:g} kN"
    pairs = _pairs(exact, found) | {"area": (found.area, exact.area)}
    units = ("mm", "mm", "MPa", "MPa", "µm", "mm²")
    bands = (BAND, BAND, BAND, nodal_band, APPROACH_BAND, AREA_BAND)
    return [
        check_shown(f"{where}: {quantity}", *pair, unit, HERTZ, band)
        for (quantity, pair), unit, band in zip(pairs.items(), units, bands, strict=True)
    ]


def _compared(exact: HertzContact, found: BlockPress, elements: int, ratio: float) -> _Errors:
    # patches grow with the cube root of the load
    over = elements * (exact.load / max(LOADS)) ** (1 / 3)
    a, b, peak, _, approach = (abs(c / e - 1) for c, e in _pairs(exact, found).values())
    return _Errors(over, peak, max(a, b), approach)


_HEADER = ("a/b", "elements at 200 kN", "load (kN)", "a", "b", "peak", "peak, nodes", "approach")


def _row(ratio: float, elements: int, exact: HertzContact, found: BlockPress) -> tuple[float, ...]:
    pairs = _pairs(exact, found).values()
    percent = tuple(round(100 * (computed / reference - 1), 2) for computed, reference in pairs)
    return (ratio, elements, exact.load * 1e-3, *percent)


def order_check(quantity: str, elements: list[float], errors: list[float]) -> Check:
    """Observed order of errors (n,) over the elements (n,) that a semi-axis has."""
    order = fitted_order([1 / n for n in elements], errors)
    return Check(f"observed order, {quantity}", order, 1.0, "", "least expected", 0.0, "at_least")


def error_plot(
    of: str,
    axis: str,
    errors: dict[str, tuple[list[float], list[float]]],
    reference: tuple[float, float],
) -> Plot:
    """Errors beside a line of second order.

    Parameters
    ----------
    of, axis : str
        What differs from Hertz, and what the elements are counted over.
    errors : dict
        Elements (n,) and relative errors (n,) by name.
    reference : tuple of float
        Most elements, and per cent at the fewest, of the line of second order.
    """
    curves = [
        curve(name, elements, [100 * e for e in found], "points")
        for name, (elements, found) in errors.items()
    ]
    x = np.array([min(min(elements) for elements, _ in errors.values()), reference[0]])
    curves.append(curve("second order", x, reference[1] * (x / x[0]) ** -2, "reference"))
    return Plot(
        f"{of} against the elements over {axis}; each point is one load on one mesh.",
        f"Elements over {axis}",
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
    source, peak = "code_aster, SSNV104", found.ellipse.peak_pressure
    checks = (
        Check("σ_zz at the centre", -found.nodal_pressure * 1e-6, -2798.3, "MPa", source, BAND),
        Check("peak pressure (moments)", peak * 1e-6, 2798.3, "MPa", source, BAND),
        Check("contact radius", found.ellipse.along * 1e3, 10.0, "mm", source, BAND),
        check_shown("force", found.load, load, "kN", HERTZ, APPROACH_BAND),
    )
    method = (
        "Two spheres of R = 50 mm, E = 20 GPa, ν = 0.3 are crushed by 4 mm. The published values "
        "are Hertz's; both bodies are half-spaces here, as in his theory, with Boussinesq's "
        "displacements on the outer faces of the blocks and 10 elements over the radius of the "
        "patch. σ_zz is minus the largest nodal pressure."
    )
    return CaseResult("ssnv104", "Two spheres crushed by 4 mm (SSNV104)", method, checks)

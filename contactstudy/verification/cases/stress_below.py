"""Stresses below the patch: sphere, line and ellipses."""

from __future__ import annotations

import numpy as np

from contactstudy.halfspace.pressure_field import SurfacePressure
from contactstudy.halfspace.subsurface import stress_maxima
from contactstudy.verification.cases.block_stresses import (
    LargestStresses,
    line_stresses,
    shear_order,
    sphere_stresses,
)
from contactstudy.verification.check import CaseResult, Check, ResultTable

SOURCE = "Johnson 1985"
# nu = 0.3; rounded from the closed forms below (0.31002 at 0.4809 a, 0.30028 at 0.7862 b), which
# are K. L. Johnson, Contact Mechanics (1985), eqs (3.45) and (4.46)
SPHERE_SHEAR, SPHERE_DEPTH = 0.310, 0.48
LINE_SHEAR, LINE_DEPTH = 0.300, 0.786


def exact_sphere_shear(nu: float = 0.3) -> float:
    """Largest ``|s_zz - s_rr|/2`` over p0 on the axis below a sphere, Johnson eq. (3.45)."""
    t = np.linspace(0.3, 0.7, 4001)
    rr = -(1 + nu) * (1 - t * np.arctan(1 / t)) + 0.5 / (1 + t**2)
    return float(np.max(0.5 * np.abs(-1 / (1 + t**2) - rr)))


def exact_line_shear() -> float:
    """Largest shear over p0 below a line contact, ``s - s^2/sqrt(1 + s^2)``, Johnson eq. (4.46)."""
    s = np.linspace(0.6, 1.0, 4001)
    return float(np.max(s - s**2 / np.sqrt(1 + s**2)))


# b/a: depth of the maximum over b, maximum shear over p0; Johnson, table 4.1
ELLIPSES = {0.2: (0.745, 0.322), 0.4: (0.665, 0.325), 0.6: (0.590, 0.323), 0.8: (0.530, 0.317)}


def hertz_pressure(a: float, b: float, cells: int = 48) -> SurfacePressure:
    """Hertz's pressure of peak 1 Pa over an ellipse, on ``cells**2`` rectangles."""
    u = np.linspace(-1.0, 1.0, cells + 1)
    middle = 0.5 * (u[1:] + u[:-1])
    inside = 1.0 - middle[:, None] ** 2 - middle[None, :] ** 2
    return SurfacePressure(a * u, b * u, np.sqrt(np.maximum(inside, 0.0)))


def below_sphere() -> CaseResult:
    """Sphere on flat: the finite elements' stresses and the recovered field."""
    rows = sphere_stresses()
    best = rows[-1]
    checks = [
        *_maximum("a, finite elements", best.shear, SPHERE_SHEAR, best.depth, SPHERE_DEPTH),
        Check("von Mises over p0, finite elements", best.mises, 2 * SPHERE_SHEAR, "", SOURCE, 0.03),
        _order(rows, exact_sphere_shear()),
    ]
    for row in rows:
        where = f"a, recovered field, {row.elements:g} elements over a"
        checks += _maximum(where, row.field_shear, SPHERE_SHEAR, row.field_depth, SPHERE_DEPTH)
    return CaseResult(
        "subsurface_sphere",
        "Stress below a sphere on a flat",
        "Two equal half-spaces of hexahedra of 1 mm, pressed over a sphere's gap until Hertz's "
        "patch has 3 to 9 elements over its radius. The displacements under the contact forces "
        "give the stresses at the Gauss points, bubbles included; they are extrapolated to the "
        "nodes, averaged there, and read on the axis. Beside them stands the recovered field, "
        "that of an elastic half-space under the nodal pressure, which is what a run reports: it "
        "needs a third of the elements for the same error.",
        tuple(checks),
        (_table(rows, "a"),),
    )


def below_line() -> CaseResult:
    """Cylinder on flat in plane strain."""
    rows = line_stresses()
    best = rows[-1]
    return CaseResult(
        "subsurface_line",
        "Stress below a line contact",
        "Two equal strips of hexahedra in plane strain, one element thick, with Flamant's "
        "displacements on their outer faces, pressed over a cylinder's gap. Stresses as for the "
        "sphere.",
        (
            *_maximum("b, finite elements", best.shear, LINE_SHEAR, best.depth, LINE_DEPTH),
            _order(rows, exact_line_shear()),
        ),
        (_table(rows, "b"),),
    )


def below_ellipses() -> CaseResult:
    """Recovered stresses below Hertz's ellipses."""
    checks = []
    for ratio, (depth, shear) in ELLIPSES.items():
        found = stress_maxima(hertz_pressure(1.0, ratio))[1]
        name = f"b/a = {ratio:g}"
        checks += [
            Check(f"maximum shear over p0, {name}", found.value, shear, "", SOURCE, 0.01),
            Check(f"its depth over b, {name}", found.depth / ratio, depth, "", SOURCE, 0.02),
        ]
    return CaseResult(
        "subsurface_ellipse",
        "Stress below elliptic patches",
        "The half-space's stresses under Hertz's pressure, constant on 48 x 48 rectangles, whose "
        "largest shear is looked for in the whole body.",
        tuple(checks),
    )


def _maximum(
    where: str, shear: float, exact: float, depth: float, exact_depth: float
) -> tuple[Check, Check]:
    """Largest shear and its depth, `where` beginning with the axis."""
    return (
        Check(f"maximum shear over p0, {where[3:]}", shear, exact, "", SOURCE, 0.03),
        Check(f"its depth over {where}", depth, exact_depth, "", SOURCE, 0.03),
    )


def _order(rows: tuple[LargestStresses, ...], exact: float) -> Check:
    order = shear_order(rows, exact)
    return Check("order of the shear's error", order, 2.0, "", "linear hexahedra", 0.25)


def _table(rows: tuple[LargestStresses, ...], axis: str) -> ResultTable:
    header = (
        f"elements over {axis}", "shear/p0, elements", f"depth/{axis}", "von Mises/p0",
        "shear/p0, field", f"depth/{axis}", "von Mises/p0",
    )  # fmt: skip
    cells = tuple(
        tuple(
            None if np.isnan(v) else v
            for v in (
                r.elements, r.shear, r.depth, r.mises, r.field_shear, r.field_depth, r.field_mises,
            )
        )
        for r in rows
    )  # fmt: skip
    return ResultTable("Largest stresses below the patch", header, cells)

"""The Manchester benchmark A-2.2 as named cases: the published rows, and all of them."""

from __future__ import annotations

from contactstudy.geometry.wheelset import Side
from contactstudy.plot.curves import Curve, Plot, Style, curve
from contactstudy.verification.cases.manchester import ManchesterRow, manchester_rows
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_shown

SOURCE = "CONTACT 25.2, published reference output"
# case: approach [m], peak pressure [Pa], area [m^2], |y| on the rail [m], left wheel
PUBLISHED = {
    1: (15.96e-6, 338.3e6, 51.64e-6, 8.66e-3),
    11: (22.32e-6, 552.8e6, 27.68e-6, 2.637e-3),
}
_REFINED: tuple[tuple[int, Side], ...] = ((1, "left"), (11, "left"), (21, "right"))
APPROACH_BAND, PRESSURE_BAND, AREA_BAND, POSITION_BAND = 0.03, 0.05, 0.05, 0.05
"""Of the value; of the position: of the patch's semi-axis across."""

METHOD = (
    "One wheelset (S1002, 460 mm, flange backs 1360 mm apart, tape circle 70 mm outside them) on "
    "rails UIC60 inclined 1:40, gauge 1435 mm at 14 mm depth, shifted by 0 to 10 mm in steps of "
    "0.5 mm and yawed by 1.2 mrad a step; roll as in CONTACT's example. 10 kN vertical load a "
    "wheel, G = 82 GPa, ν = 0.28. The rail is the benchmark's own: arcs that reproduce its point "
    "file within 0.03 µm; crown R300 to 10.5 mm, where 60E1 has 10.228 mm.\n\n"
    "Wheel and rail are elastic half-spaces, as in CONTACT, the gap is the signed distance of the "
    "smooth surfaces; cells of 0.2 mm, as in CONTACT, and the area is that of the cells under "
    "pressure. CONTACT's vertical load includes the vertical part of the friction force; here it "
    "is that of steady rolling with μ = 0.30 after Vermeulen and Johnson, spin left out, and it "
    "enters the balance only. The contact position is the centroid of the overlap of the "
    "undeformed bodies, weighted with the square of its depth; that CONTACT's reference point is "
    "this one was concluded from both published positions."
)


def manchester_published() -> CaseResult:
    """Centred and 5 mm rows of the left wheel, for which figures are published here."""
    rows = manchester_rows(tuple(PUBLISHED), ("left",))
    return CaseResult(
        "manchester_published",
        "Manchester contact benchmark A-2.2, left wheel at 0 and 5 mm",
        METHOD,
        published_checks(rows),
        (rows_table(rows, "left"),),
    )


def manchester() -> CaseResult:
    """All 21 positions of both wheels."""
    rows = manchester_rows()
    return CaseResult(
        "manchester",
        "Manchester contact benchmark A-2.2, all positions",
        METHOD,
        published_checks(rows),
        (rows_table(rows, "left"), rows_table(rows, "right"), _smaller_cells()),
        tuple(
            _plot(rows, name, label, scale)
            for name, label, scale in (
                ("approach", "approach (µm)", 1e6),
                ("peak_pressure", "peak pressure (MPa)", 1e-6),
                ("area", "area (mm²)", 1e6),
            )
        ),
    )


def published_checks(rows: list[ManchesterRow]) -> tuple[Check, ...]:
    """Checks of the rows of the left wheel with published figures."""
    checks = []
    for row in rows:
        if row.wheel != "left" or row.case not in PUBLISHED or row.patch != 1:
            continue
        where = f"left wheel at {1e3 * row.shift:g} mm"
        approach, pressure, area, y = PUBLISHED[row.case]
        found = row.found
        checks += [
            check_shown(f"{quantity}, {where}", computed, reference, unit, SOURCE, band, scale)
            for quantity, computed, reference, unit, band, scale in (
                ("approach", found.approach, approach, "µm", APPROACH_BAND, None),
                ("peak pressure", found.peak_pressure, pressure, "MPa", PRESSURE_BAND, None),
                ("area", found.area, area, "mm²", AREA_BAND, None),
                ("contact position y", row.y, y, "mm", POSITION_BAND, found.across),
            )
        ]
    return tuple(checks)


def rows_table(rows: list[ManchesterRow], wheel: str) -> ResultTable:
    """Table of one wheel's patches."""
    return ResultTable(
        f"{wheel.capitalize()} wheel: contact patches at all positions computed. y to the right, "
        "z down from the top of the rail; N is the normal force.",
        ("shift (mm)", "yaw (mrad)", "patch", "y (mm)", "z (mm)", "s wheel (mm)",
         "contact angle (mrad)", "N (kN)", "approach (µm)", "peak pressure (MPa)", "area (mm²)"),
        tuple(
            (1e3 * r.shift, 1e3 * r.yaw, r.patch, 1e3 * r.y, 1e3 * r.z, 1e3 * p.wheel_s,
             1e3 * p.reference.angle, 1e-3 * p.normal_force, 1e6 * p.approach,
             1e-6 * p.peak_pressure, 1e6 * p.area)
            for r, p in ((r, r.found) for r in rows)
            if r.wheel == wheel
        ),
    )  # fmt: skip


def _smaller_cells() -> ResultTable:
    """The published rows, and the narrowest patch, on smaller cells."""
    sides = (0.2e-3, 0.1e-3, 0.05e-3)
    rows = []
    for case, wheel in _REFINED:
        for side in sides:
            r = manchester_rows((case,), (wheel,), side=side)[0]
            rows.append(
                (1e3 * r.shift, wheel, 1e3 * side, 1e3 * r.found.across, 1e6 * r.found.approach,
                 1e-6 * r.found.peak_pressure, 1e6 * r.found.area)
            )  # fmt: skip
    return ResultTable(
        "What the cells of 0.2 mm leave: the same positions on smaller ones. The area shrinks, "
        "since cells count whole.",
        ("shift (mm)", "wheel", "cell (mm)", "semi-axis across (mm)", "approach (µm)",
         "peak pressure (MPa)", "area (mm²)"),
        tuple(rows),
    )  # fmt: skip


def _plot(rows: list[ManchesterRow], name: str, label: str, scale: float) -> Plot:
    def drawn(name_shown: str, chosen: list[ManchesterRow], style: Style) -> Curve:
        x, y = [1e3 * r.shift for r in chosen], [scale * getattr(r.found, name) for r in chosen]
        return curve(name_shown, x, y, style)

    curves = []
    for wheel in ("left", "right"):
        chosen = [r for r in rows if r.wheel == wheel and r.patch == 1]
        curves.append(drawn(f"{wheel} wheel", chosen, "both"))
    second = [r for r in rows if r.patch > 1]
    if second:
        curves.append(drawn("second patch", second, "points"))
    quantity, unit = label.rstrip(")").split(" (")
    return Plot(
        f"{quantity.capitalize()} over the lateral shift of the wheelset. "
        f"Left wheel from {curves[0].y[0]:.4g} to {curves[0].y[-1]:.4g} {unit}, "
        f"right wheel up to {max(curves[1].y):.4g} {unit}.",
        "lateral shift (mm)",
        label,
        tuple(curves),
    )

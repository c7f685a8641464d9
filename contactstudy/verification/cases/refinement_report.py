"""Tables, figures and checks of a series of refinements."""

from __future__ import annotations

import re

import numpy as np

from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.plot.curves import Plot, curve
from contactstudy.plot.text import tick
from contactstudy.verification.cases.refinement import BAND, QUANTITIES, Refinement, common
from contactstudy.verification.check import Cell, Check, ResultTable, check_at_most


def tables(name: str, scale: float, series: Refinement) -> tuple[ResultTable, ...]:
    """Differences from the finest level and observed orders, for levels times `scale`."""
    short = ("force", "dynamic part", f"below {BAND:g} Hz", "peak pressure", "its mean")
    finest = _at(name, scale * series.levels[-1])
    rows: list[tuple[Cell, ...]] = []
    against = np.append(series.against_finest, np.zeros((1, len(QUANTITIES))), axis=0)
    for level, row, run in zip(series.levels, against, series.runs, strict=True):
        area = 1e6 * float(run.contact_area.mean())
        overlap = 1e9 * float(run.penetration.max())
        rows.append((scale * level, *(100.0 * row).tolist(), area, overlap))
    orders: list[tuple[Cell, ...]] = [
        (
            " – ".join(f"{scale * v:.4g}" for v in series.levels[k : k + 3]),
            *(None if np.isnan(p) else float(p) for p in row),
        )
        for k, row in enumerate(series.orders)
    ]
    columns = (*(f"{q} (%)" for q in short), "mean area (mm²)", "penetration (nm)")
    found = [
        ResultTable(f"Differences from the finest level, {finest}", (name, *columns), tuple(rows))
    ]
    if series.algebraic:
        caption = "Observed order of three neighbouring levels (–: their steps do not get smaller)"
        found.append(ResultTable(caption, (name, *short), tuple(orders)))
    return tuple(found)


def difference_plot(name: str, scale: float, series: Refinement) -> Plot:
    """Differences of the levels from the finest one."""
    against = series.against_finest
    curves = tuple(
        curve(quantity, scale * np.array(series.levels[:-1]), against[:, q], "both")
        for q, quantity in enumerate(QUANTITIES)
    )
    left = series.left_at_default
    caption = (
        "Relative difference from the finest level. At the default "
        f"({_at(name, scale * series.levels[series.default])}) "
        f"{100 * left[0]:.2g} % of the contact force, "
        f"{100 * left[1]:.2g} % of its dynamic part and {100 * left[4]:.2g} % of the mean peak "
        "pressure are left."
    )
    return Plot(caption, name, "relative difference", curves, "log", "log")


def _at(name: str, value: float) -> str:
    """A level with its quantity and unit: "mesh size 2 mm"."""
    what, unit, more = re.split(r" \((.+?)\)", name) if "(" in name else (name, "", "")
    return f"{what} {tick(float(f'{value:.4g}'))} {unit}".strip() + more


def left_checks(
    series: Refinement, what: str, limits: tuple[float, float, float]
) -> tuple[Check, ...]:
    """Error left at the default: contact force, dynamic part, mean peak pressure."""
    left = series.left_at_default
    source = "difference from the finest level and that one's own error"
    name = f"error left by the default {what}"
    return tuple(
        check_at_most(f"{name}: {QUANTITIES[q]}", 100 * float(left[q]), limit, "%", source)
        for q, limit in zip((0, 1, 4), limits, strict=True)
    )


def peak_over_hertz(series: Refinement) -> list[float]:
    """Mean of the peak pressure over that of Hertz's under the same forces, for each level."""
    modulus, radii = contact_modulus(), (0.43, 0.30)
    unit = hertz_contact(1.0, modulus, *radii).peak_pressure
    found = []
    for run in series.runs:
        late, _ = common(run, run)
        # p0 grows like the cube root of the force
        p0 = unit * np.cbrt(late.contact_force.values)
        found.append(float(late.peak_pressure.values.mean() / p0.mean()))
    return found

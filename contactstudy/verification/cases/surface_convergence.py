"""Observed convergence of surface contact in time: mesh, penalty, interface modes, time step."""

from __future__ import annotations

import numpy as np

from contactstudy.study.kinds.passage.own_error import DEFAULTS
from contactstudy.verification.cases import refined_runs
from contactstudy.verification.cases.refinement import BAND, QUANTITIES
from contactstudy.verification.cases.refinement_report import (
    difference_plot,
    left_checks,
    peak_over_hertz,
    tables,
)
from contactstudy.verification.check import CaseResult, Check, ResultTable, check_at_most

HERTZ = "Hertz under the same forces"
METHOD = (
    "The default study (36 m of track, Table 1's roughness, seed 1, 300 km/h) from 12 m on, over "
    "2.4 m after a fade-in of 1.2 m, solved at several levels of one thing; all else has its "
    "default. Differences are relative L2 norms over the positions that two levels share. The "
    f"dynamic part is also compared below {BAND:g} Hz: the roughness ends at 265 Hz, and what the "
    "force has above comes from the discretisation. The largest part of that are dips of some "
    "30 N, 0.05 % of the load, where the patch crosses an interface plane of the rail's cells, "
    "every 0.1 m: the static approach is 16 nm larger there. The error left at the default is its "
    "difference from the finest level and the estimate of what that one has itself: by the "
    "observed order, or, where there is none, the last step between levels."
)


def mesh() -> CaseResult:
    """Element size at the running surface, and of the section away from it."""
    fine, inner = refined_runs.mesh_series(), refined_runs.interior_series()
    peak = peak_over_hertz(fine)
    name, inner_name = "mesh size (mm)", "coarsest element (mm)"
    pressures = ResultTable(
        "Mean of the peak pressure over Hertz's under the same forces",
        (name, "ratio"),
        tuple((1e3 * h, p) for h, p in zip(fine.levels, peak, strict=True)),
    )
    method = (
        METHOD
        + "\n\nThe surfaces are smooth, but Gauss points come into contact one by one, and where "
        "those lie in the patch is another for every mesh. So the force settles to a "
        "scatter rather than to an order. The nodal pressure is a mean over the elements around "
        "the node: with the half axes a and b that makes its peak h²/12 (1/a² + 1/b²) too low, "
        "2.4 % at 2 mm. Away from the running surface the largest elements have 9 mm; the second "
        "series halves them, on a running surface of 4 mm."
    )
    checks = (
        *left_checks(fine, "mesh size, 2 mm", (0.1, 0.4, 3.0)),
        *left_checks(inner, "largest element, 9 mm", (0.15, 0.5, 1.0)),
        Check("mean peak pressure at 2 mm over Hertz's", peak[fine.default], 1.0, "", HERTZ, 0.04),
    )
    return CaseResult(
        "convergence_mesh",
        "Convergence in mesh size",
        method,
        checks,
        (*tables(name, 1e3, fine), pressures, *tables(inner_name, 1e3, inner)),
        (difference_plot(name, 1e3, fine), difference_plot(inner_name, 1e3, inner)),
    )


def penalty() -> CaseResult:
    """Penalty at Gauss points and at nodes; the augmented Lagrangian as its limit."""
    gauss, nodes = refined_runs.penalty_series("gauss"), refined_runs.penalty_series("nodes")
    name = "penalty (Pa/m)"
    method = (
        METHOD
        + "\n\nAt the nodes the last level is the augmented Lagrangian, which leaves a penetration "
        f"of {1e9 * refined_runs.TOLERANCE:g} nm; it stands at the penalty that would leave as "
        "much. The error is of first order in 1/penalty. Gauss points, the default, are four to "
        "a facet, more than there are nodes to follow them: from 1e16 Pa/m on a higher penalty "
        "only lets go of points, the pressure is spread over fewer of them, and no order is seen. "
        "What that leaves in the force is small."
    )
    left = "penetration left by the augmented Lagrangian"
    order, overlap = nodes.orders[1], float(nodes.runs[-1].penetration.max())
    checks = (
        *left_checks(gauss, "penalty, 1e16 Pa/m, Gauss points", (0.05, 0.2, 0.5)),
        *left_checks(nodes, "penalty, 1e16 Pa/m, nodes", (0.01, 0.02, 0.2)),
        *(
            Check(f"observed order of the {of}", float(order[q]), 1.0, "", "theory", 0.05)
            for of, q in (
                ("force in 1/penalty, nodes, 1e15 to 1e17 Pa/m", 0),
                ("peak pressure, the same", 3),
            )
        ),
        check_at_most(left, overlap, refined_runs.TOLERANCE, "m", "its tolerance"),
    )
    return CaseResult(
        "convergence_penalty",
        "Convergence in the penalty",
        method,
        checks,
        (*tables(f"{name}, Gauss points", 1.0, gauss), *tables(f"{name}, nodes", 1.0, nodes)),
        (
            difference_plot(f"{name}, Gauss points", 1.0, gauss),
            difference_plot(f"{name}, nodes", 1.0, nodes),
        ),
    )


def interface_modes() -> CaseResult:
    """Generalised modes of the rail's interface planes."""
    found = refined_runs.modes_series()
    name = "interface modes"
    method = (
        METHOD
        + "\n\nModes are the leading ones of static responses; their error follows no power of "
        "their number. With any number of them the static deflection under the wheel is that of "
        "the full mesh, because the residual flexibility makes up for the rest: what is left is "
        "dynamic."
    )
    return CaseResult(
        "convergence_modes",
        "Convergence in the interface modes",
        method,
        left_checks(found, "number of interface modes, 14", (0.05, 0.2, 0.05)),
        tables(name, 1.0, found),
        (difference_plot(name, 1.0, found),),
    )


def time_step() -> CaseResult:
    """Time step."""
    found = refined_runs.time_step_series()
    name = "time step (µs)"
    method = (
        METHOD + "\n\nAverage acceleration is of second order for smooth motion, and below "
        f"{BAND:g} Hz that is seen. The whole force is not smooth: a dip at an interface plane "
        "lasts 0.1 ms, and Gauss points enter "
        "and leave the patch every millimetre, at 83 kHz. At 4.2 mm a step, the default, neither "
        "is resolved, and the whole force converges with first order or less."
    )
    order = float(found.orders[-1, 2])
    slope = f"observed order of the force below {BAND:g} Hz"
    checks = (
        *left_checks(found, "time step, 50 µs", (0.1, 0.3, 0.05)),
        Check(f"{slope}, 50 to 12.5 µs", order, 2.0, "", "average acceleration", 0.2),
    )
    return CaseResult(
        "convergence_time_step",
        "Convergence in the time step",
        method,
        checks,
        tables(name, 1e6, found),
        (difference_plot(name, 1e6, found),),
    )


def defaults() -> CaseResult:
    """What the defaults leave, all of it together."""
    of = {
        "mesh size at the running surface, 2 mm": refined_runs.mesh_series(),
        "largest element of the rail's section, 9 mm": refined_runs.interior_series(),
        "penalty, 1e16 Pa/m at Gauss points": refined_runs.penalty_series("gauss"),
        "interface modes, 14": refined_runs.modes_series(),
        "time step, 50 µs": refined_runs.time_step_series(),
    }
    left = 100 * np.array([s.left_at_default for s in of.values()])
    total = np.sqrt((left**2).sum(axis=0))
    names = (*of, "all, root of the sum of squares")
    shown = np.vstack([left, total])[:, [0, 1, 4]].tolist()
    table = ResultTable(
        "Error left at the defaults",
        ("default", "force (%)", "dynamic part (%)", "mean peak pressure (%)"),
        tuple((name, *row) for name, row in zip(names, shown, strict=True)),
    )
    fine = refined_runs.mesh_series()
    peak = peak_over_hertz(fine)[fine.default]
    left_over = "error left at the defaults"
    checks = (
        *(
            check_at_most(
                f"{left_over}: {QUANTITIES[q]}", float(total[q]), limit, "%", "all series"
            )
            for q, limit in ((0, 0.2), (1, 0.6))
        ),
        *(
            Check(f"{QUANTITIES[q]}, as reports state it", float(total[q]), 100 * stated, "%",
                  "reports", 0.05)
            for q, stated in ((0, DEFAULTS.force), (1, DEFAULTS.dynamic))
        ),
        Check("mean peak pressure over Hertz's", float(peak), 1.0, "", HERTZ, 0.04),
    )  # fmt: skip
    method = METHOD + "\n\nThe series have cases of their own, with every level."
    return CaseResult(
        "convergence", "Error left at the defaults of surface contact", method, checks, (table,)
    )

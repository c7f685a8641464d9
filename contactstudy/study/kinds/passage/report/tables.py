"""Tables of the report as plain data: columns and rows of texts."""

import re
from collections.abc import Mapping
from typing import Any

from contactstudy.figures.passing_components import all_passing, component
from contactstudy.plot.text import label
from contactstudy.report.blocks import Block, table
from contactstudy.report.quantity import grouped, quantity, rounded
from contactstudy.study.kinds.passage.report.metrics import of_run
from contactstudy.study.results import StudyResults

# The template sets these as symbols.
K_R, K_H = "k_r", "k_H"


def describe(results: StudyResults, name: str) -> tuple[str, str]:
    """Rail and contact law of a run in words."""
    run: Mapping[str, Any] = results.config.get("runs", {}).get(name, {})
    if run.get("solver") == "surface":
        attrs = results.runs[name].attrs
        where = " at nodes" if attrs.get("quadrature") == "nodes" else ""
        model = attrs.get("wheel", "quasi-static")
        wheel = "" if model == "quasi-static" else f", {model} wheel"
        return "solid", f"surface, {attrs.get('law', 'penalty')}{where}{wheel}"
    rails = {"euler": "Euler beam", "timoshenko": "Timoshenko beam", "solid": "solid"}
    rail = rails.get(str(run.get("rail")), str(run.get("rail", "–")))
    if run.get("rail") != "solid" and "elements_per_bay" in run:
        rail += f", {run['elements_per_bay']} a bay"
    if run.get("local_compliance"):
        rail += ", local compliance"
    seen = {"trajectory": ", trajectory", "patch": ", mean over the patch"}
    contact = _law(run, results.runs[name].attrs) + seen.get(str(run.get("contact_filter")), "")
    if run.get("patch_filter") == "following":
        contact += " at the force of the moment"
    return rail, contact + (", modal wheel" if run.get("wheel") == "modal" else "")


def _law(run: Mapping[str, Any], attrs: Mapping[str, Any]) -> str:
    if run.get("contact_filter") == "bedding":
        return "point, Winkler bedding"
    if run.get("law") == "press":
        return "point, press"
    if run.get("law") == "moving_force":
        return "moving force"
    if run.get("law") == "hertz":
        return "point, Hertz" + _value(attrs.get("k_H"), "N/m^(3/2)", f"{K_H} = ")
    k_r = run.get("k_r")
    if isinstance(k_r, str):
        # Rigid contact has no stiffness; the tangent of the press or of Hertz has a value.
        value = None if k_r == "rigid" else attrs.get("k_r")
        words = re.sub(r"hertz_(\w+)", r"\1 of Hertz", k_r)
        return f"point, {K_R} {words}" + _value(value, "N/m")
    return "point" + _value(k_r, "N/m", f"{K_R} = ")


def _value(value: Any, unit: str, before: str = "") -> str:
    """Return a comma and the value to three digits, or nothing where there is none."""
    if value is None:
        return ""
    shown, prefixed = quantity(float(f"{float(value):.3g}"), unit)
    return f", {before}{shown} {prefixed}"


def run_table(results: StudyResults, timings: bool, noted: bool = True) -> Block:
    """Sizes of all runs; with `timings` also seconds and memory, which depend on the machine.

    A note says where those are, once a report: `noted`.
    """
    columns = ["Run", "Rail", "Contact", "DOFs", "Steps", "Time step (µs)"]
    if timings:
        columns += ["Setup (s)", "Stepping (s)", "Memory (MB)"]
    rows = []
    for name in results.runs:
        sizes = of_run(results, name)
        row = [label(name), *describe(results, name)]
        row += [grouped(int(sizes["dofs"])), grouped(int(sizes["steps"]))]
        row.append(quantity(1e6 * float(sizes["dt"]))[0])
        if timings:
            seconds = sizes.get("seconds", {})
            row += [rounded(seconds.get("setup")), rounded(seconds.get("stepping"))]
            row.append(rounded(sizes.get("peak_memory_mb")))
        rows.append(row)
    note = (
        "Times and memory were measured on the machine that made this report."
        if timings
        else "Times and memory depend on the machine: see metrics.json beside this report."
    )
    reference = f" Reference: {label(results.reference)}." if results.reference else ""
    return table(columns, rows, f"Runs and their sizes.{reference}", 3, note if noted else "")


def passing_table(results: StudyResults) -> Block | None:
    """Sleeper-, element- and cell-passing amplitudes of the contact force on a smooth rail."""
    found = all_passing(results)
    if not found:
        return None
    rows = []
    for name, p in found.items():
        row = [label(name), describe(results, name)[0], rounded(p.static * 1e-3, 5)]
        for kind in ("sleeper", "element", "cell"):
            amplitude = component(results, name, p, kind)
            share = None if amplitude is None else 100 * amplitude / p.static
            row += [rounded(amplitude), rounded(share, 2)]
        rows.append(row)
    columns = ["Run", "Rail", "Static (kN)", "Sleeper (N)", "(%)"]
    columns += ["Element (N)", "(%)", "Cell (N)", "(%)"]
    return table(
        columns,
        rows,
        "Amplitudes of the contact force on the smooth rail at the sleeper-, element- and "
        "cell-passing wavelengths, in N and in per cent of the static load.",
        2,
        "Element and cell: the largest amplitude at that length and its fractions down to a "
        "twelfth of a bay; a dash where a model has none.",
    )

"""The whole report as plain data, for the template to set."""

import re
from typing import Any

import contactstudy
from contactstudy.figures import Drawing, drawings
from contactstudy.figures.passing_components import is_smooth
from contactstudy.plot.text import label
from contactstudy.report.abstract import GRADES, abstract
from contactstudy.report.parameters import parameter_tables
from contactstudy.report.quantity import quantity
from contactstudy.report.stress_table import stress_tables
from contactstudy.report.tables import (
    Block,
    cited,
    error_tables,
    passing_table,
    run_table,
    text,
)
from contactstudy.study.results import StudyResults

Content = dict[str, Any]

# Parts of the results in their order, with the figures that belong to each.
_PARTS = (
    ("Irregularity", ("irregularity_spectrum", "irregularity_profile")),
    ("Contact force", ("contact_force", "third_octaves")),
    ("Motion of the wheel", ("wheel_displacement", "wheel_acceleration")),
    ("Motion of the rail", ("rail_displacement",)),
    (
        "Contact patch",
        (
            "patch_pressure",
            "patch_status",
            "stress_below",
            "patch_history",
            "deformed_section",
            "static_press",
        ),
    ),
    ("Passing frequencies", ("smooth_force", "passing_amplitudes")),
)


def content(results: StudyResults, timings: bool) -> Content:
    """Everything that the template inserts, with figures named relative to the study's folder.

    Parameters
    ----------
    results : StudyResults
        A finished study.
    timings : bool
        Whether the run table shows seconds and memory.
    """
    return {
        "title": results.title,
        "subtitle": f"Study {label(results.name)} · contactstudy {contactstudy.__version__}",
        "name": results.name,
        "abstract": abstract(results),
        "subject": _subject(results, timings),
        "parameters": _parameters(results),
        "results": [*_parts(results, ""), *_errors(results)],
        "companions": [
            {
                "title": companion.title,
                "parts": [_runs_part(companion, timings), *_companion_parts(companion)],
            }
            for companion in results.companions
        ],
        "provenance": _provenance(results),
    }


def _description(results: StudyResults) -> list[Block]:
    """Paragraphs of the study file's description: lines joined, names in quotation marks."""
    named = re.sub(r"`([^`\n]+)`", r"“\1”", results.description)
    paragraphs = [" ".join(p.split()) for p in re.split(r"\n\s*\n", named)]
    return [text(paragraph) for paragraph in paragraphs if paragraph]


def _subject(results: StudyResults, timings: bool) -> list[Block]:
    blocks = _description(results)
    if results.runs:
        blocks.append(
            text(
                "Each run changes one assumption or a few, so that their differences can be "
                "told apart: how the rail is modelled, by what law wheel and rail push on each "
                "other, and with what stiffness."
            )
        )
        blocks.append(run_table(results, timings))
    return blocks


def _parameters(results: StudyResults) -> list[Block]:
    sources = "The tables give the resolved values that the program used."
    if results.config.get("track", {}).get("support") == "discrete":
        sources += (
            " The default supports are the ballasted track of Zhai et al. {zhai}, per rail seat."
        )
    if results.config.get("vehicle", {}).get("type") == "wheel_column":
        sources += (
            " The default vehicle has the values of the Shinkansen S300 of Wu and Yang {wu}, per "
            "wheel: the paper does not give its train's, and this is the nearest open set."
        )
    if results.config.get("track", {}).get("rail") == "60E1":
        sources += " The default rail is the profile 60E1 {en13674}."
    return [cited(sources), *parameter_tables(results)]


def _figure(made: Drawing, prefix: str) -> Block:
    return {"kind": "figure", "file": f"{prefix}{made.name}.pdf", "caption": made.caption}


def _parts(results: StudyResults, prefix: str) -> list[Content]:
    """Parts with at least one figure; a figure belongs to the part that its name begins with."""
    made = drawings(results)
    parts = []
    for title, names in _PARTS:
        blocks = [_figure(d, prefix) for d in made if d.name.startswith(names)]
        if title == "Contact patch":
            blocks += stress_tables(results)
        if blocks:
            parts.append({"title": title, "blocks": blocks})
    return parts


def _errors(results: StudyResults) -> list[Content]:
    tables = error_tables(results)
    if not tables:
        return []
    grades = "; ".join(
        f"below {100 * limit:g} % “{words}”" for limit, words in GRADES if limit != float("inf")
    )
    note = text(
        "The errors are given twice, relative to the whole signal and relative to its dynamic "
        "part about the static value: whether two models look almost identical depends on which. "
        "M, P and C are the errors of magnitude, phase and both of Sprague and Geers, of the "
        f"dynamic part. The words of the abstract follow the error of the dynamic part: {grades}, "
        f"else “{GRADES[-1][1]}”."
    )
    return [{"title": "Errors", "blocks": [note, *tables]}]


def _runs_part(results: StudyResults, timings: bool) -> Content:
    blocks = _description(results)
    return {"title": "Runs", "blocks": [*blocks, run_table(results, timings)]}


def _companion_parts(results: StudyResults) -> list[Content]:
    """For a smooth rail the passing frequencies alone, else all parts."""
    prefix = f"{results.name}/"
    passing = passing_table(results)
    if passing is None or not is_smooth(results):
        return [*_parts(results, prefix), *_errors(results)]
    parts = [p for p in _parts(results, prefix) if p["title"] == "Passing frequencies"]
    return [{**part, "blocks": [passing, *part["blocks"]]} for part in parts]


def _provenance(results: StudyResults) -> list[Block]:
    provenance = results.provenance
    lines = [f"Study: {results.name}."]
    if provenance.get("seed") is not None:
        lines.append(f"Seed of the random phases: {provenance['seed']}.")
    if provenance.get("hash"):
        lines.append(f"Hash of all inputs and of the program: {provenance['hash']}.")
    if mesh := provenance.get("mesh"):
        parts = ", ".join(f"{label(key)} {quantity(value)[0]}" for key, value in mesh.items())
        lines.append(
            f"Mesh from which solid rail and beams take their section (SI units): {parts}."
        )
    for name, digest in (provenance.get("files") or {}).items():
        lines.append(f"Input file {name}, SHA-256 {digest}.")
    if versions := provenance.get("versions"):
        parts = ", ".join(f"{name} {version}" for name, version in versions.items())
        lines.append(f"Versions: {parts}.")
    lines.append(
        "The same inputs give the same bytes of this report; neither it nor its figures are dated."
    )
    return [{"kind": "list", "items": lines}]

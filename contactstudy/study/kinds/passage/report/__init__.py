"""What the report says of a passage."""

from typing import Any

from contactstudy.figures import model
from contactstudy.figures.histories import EXPLAINED
from contactstudy.figures.irregularity import irregularity_of
from contactstudy.figures.passing_components import is_smooth
from contactstudy.figures.signals import wheel_note
from contactstudy.report.blocks import Block, cited, figure, paragraphs, text
from contactstudy.study.kind import Part, Report
from contactstudy.study.kinds.passage.drawings import drawings
from contactstudy.study.kinds.passage.report.abstract import GRADES, abstract
from contactstudy.study.kinds.passage.report.comfort_table import comfort_table
from contactstudy.study.kinds.passage.report.conclusion import conclusion
from contactstudy.study.kinds.passage.report.deck_table import deck_table
from contactstudy.study.kinds.passage.report.error_tables import error_tables
from contactstudy.study.kinds.passage.report.measured_table import measured_tables
from contactstudy.study.kinds.passage.report.rungs import rung_tables
from contactstudy.study.kinds.passage.report.safety_table import safety_table
from contactstudy.study.kinds.passage.report.stress_table import stress_tables
from contactstudy.study.kinds.passage.report.support_table import support_table
from contactstudy.study.kinds.passage.report.tables import passing_table, run_table
from contactstudy.study.results import StudyResults

_NOT_GENERATED = ("smooth", "sinusoid", "measured", None)
# Parts of the results in their order, with the figures that belong to each.
_PARTS = (
    ("Map", ("trust_map",)),
    ("Contact stiffness", ("contact_stiffness",)),
    ("The ladder", ("ladder",)),
    ("Held against a measurement", ("measured",)),
    ("Irregularity", ("irregularity_spectrum", "irregularity_profile")),
    ("Contact force", ("contact_force", "third_octaves")),
    ("Motion of the wheel", ("wheel_displacement", "wheel_acceleration")),
    ("Motion of the rail", ("rail_displacement", "rail_acceleration")),
    ("Wheel forces", ("wheel_forces",)),
    (
        "Motion of the bridge",
        (
            "bridge_passage",
            "deck_motion",
            "velocity_levels",
            "deck_spectrum",
            "support_forces",
            "strains",
            "deck_damping",
        ),
    ),
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


def report(results: StudyResults, timings: bool = False) -> Report:
    """Comparison of the runs, with the model and what the paper leaves open."""
    parts = _parts(results)
    return Report(
        abstract=abstract(results),
        conclusion=conclusion(results),
        subject=_subject(results, timings),
        sources=_sources(results),
        parts=[*parts, *_cars(results), *_errors(results)],
        as_companion=_as_companion(results, parts, timings),
        topics=_topics(results),
        model="model.typ",
        limits="limits.typ",
    )


def _topics(results: StudyResults) -> list[str]:
    """Sections of the model that the study needs."""
    runs = results.config.get("runs", {}).values()
    found = {str(run.get("solver")) for run in runs}
    if "surface" in found or any(run.get("rail") == "solid" for run in runs):
        found.add("solid")
    if found:
        found.add("motion")
    if results.config.get("irregularity", {}).get("spectrum") not in _NOT_GENERATED:
        found.add("irregularity")
    return sorted(found | ({"errors"} if results.reference else set()))


def _subject(results: StudyResults, timings: bool) -> list[Block]:
    if not results.runs:
        return []
    pictures = [figure(made.name, made.caption) for made in model.drawings(results)]
    return [run_table(results, timings), *pictures]


def _sources(results: StudyResults) -> Block:
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
    return cited(sources)


def _parts(results: StudyResults) -> list[Part]:
    """Parts with at least one figure; a figure belongs to the part that its name begins with."""
    made = drawings(results)
    parts: list[Part] = []
    for title, names in _PARTS:
        own = [d for d in made if d.name.startswith(names)]
        blocks = [figure(d.name, d.caption) for d in own]
        if title == "Contact force" and own:
            blocks.insert(0, text(EXPLAINED + wheel_note(results)))
        if title == "Motion of the bridge":
            blocks += [*deck_table(results), *support_table(results)]
        if title == "Wheel forces":
            blocks += safety_table(results)
        if title == "Contact patch":
            after = [k for k, d in enumerate(own) if d.name.startswith("stress_below")]
            at = after[-1] + 1 if after else len(blocks)
            blocks[at:at] = stress_tables(results)
        if title == "Held against a measurement":
            blocks += measured_tables(results)
        if title == "The ladder":
            blocks += rung_tables(results)
        profile = irregularity_of(results).profile if title == "Irregularity" else None
        if profile is not None and not profile.level.any():
            blocks.append(text("The irregularity is zero throughout: the rail is smooth."))
        if blocks:
            parts.append({"title": title, "blocks": blocks})
    return parts


def _cars(results: StudyResults) -> list[Part]:
    blocks = comfort_table(results)
    return [{"title": "The cars", "blocks": blocks}] if blocks else []


def _errors(results: StudyResults) -> list[Part]:
    tables = error_tables(results)
    if not tables:
        return []
    grades = "; ".join(
        f"below {100 * limit:g} % “{words}”" for limit, words in GRADES if limit != float("inf")
    )
    told = [
        "Each error is given relative to the whole signal and relative to its dynamic part about "
        "the static value: whether two models look almost identical depends on which. Magnitude, "
        "phase and both are the errors of Sprague and Geers of the dynamic part."
    ]
    if not results.metrics.get("dynamic_part", {}).get("compared", True):
        told = [
            "The reference's contact force has next to no dynamic part: errors relative to it are "
            "not given."
        ]
    elif not results.metrics.get("rungs"):
        told.append(
            f"The abstract words the error of the dynamic part so: {grades}; else "
            f"“{GRADES[-1][1]}”."
        )
    if "wheel_displacement" in results.runs[str(results.reference)]:
        told.append(
            "Wheel displacements are compared from their values at rest: a linear spring carries "
            "the dynamic part of the force only, as the static load acts on the rail, so that its "
            "wheel stands higher by the static approach. That offset is no error."
        )
    return [{"title": "Errors", "blocks": [text(" ".join(told)), *tables]}]


def _as_companion(results: StudyResults, parts: list[Part], timings: bool) -> list[Part]:
    """Runs; then for a smooth rail the passing frequencies alone, else all parts."""
    blocks: list[Any] = [*paragraphs(results.description), run_table(results, timings, False)]
    runs = {"title": "Runs", "blocks": blocks}
    passing = passing_table(results)
    if passing is None or not is_smooth(results):
        return [runs, *parts, *_errors(results)]
    chosen = [p for p in parts if p["title"] == "Passing frequencies"]
    return [runs, *({**part, "blocks": [passing, *part["blocks"]]} for part in chosen)]

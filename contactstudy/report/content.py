"""The whole report as plain data, for the template to set; what is said, a kind of study says."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from contactstudy.plot.text import label
from contactstudy.report import axes
from contactstudy.report.blocks import Block, bullets, paragraphs
from contactstudy.report.parameters import parameter_tables
from contactstudy.report.quantity import quantity
from contactstudy.study.kind import Part, Report, find_kind
from contactstudy.study.results import StudyResults
from contactstudy.version import __version__

Content = dict[str, Any]


def content(results: StudyResults, timings: bool) -> Content:
    """Everything that the template inserts, with figures named relative to the study's folder."""
    report = _report(results, timings)
    chapters = list(_chapters(results, timings))
    tables = parameter_tables(results)
    compared = results.reference is not None or bool(results.companions)
    data: Content = {
        "title": results.title,
        "subtitle": f"Study {results.name} · contactstudy {__version__}",
        "name": results.name,
        "abstract": _abstract(results, report, chapters),
        "conclusion": [] if results.swept else list(report.conclusion),
        "subject-title": "What is compared" if compared else "What is computed",
        "subject": [*paragraphs(results.description), *report.subject],
        "parameters": [*([report.sources] if report.sources else []), *tables],
        "results": list(report.parts) if results.runs or results.swept or not chapters else [],
        "companions": [_companion(chapter) for chapter in chapters],
        "provenance": _provenance(results),
        "model": report.model,
        "topics": sorted({t for r in (report, *(c.report for c in chapters)) for t in r.topics}),
        "limits": report.limits,
    }
    parts = [*data["results"], *(p for c in data["companions"] for p in c["parts"])]
    texts = [
        *data["conclusion"],
        *data["subject"],
        *data["parameters"],
        *(b for p in parts for b in p["blocks"]),
    ]
    cites = any("cite" in part for b in texts if b["kind"] == "text" for part in b["parts"])
    return data | {"cites": cites or report.model != ""}


def _report(results: StudyResults, timings: bool) -> Report:
    """What a kind says of a study; of one with axes that of its axes first."""
    kind = find_kind(results.kind)
    own = kind.report(results, timings)
    if not results.swept:
        return own
    mapped = kind.drawings(results)[:1] if kind.draws_grid(results) else ()
    parts = [*own.parts, *axes.parts(results)]
    subject = axes.subject(results)
    companion = [{"title": "What is varied", "blocks": subject}, *parts]
    return replace(
        own,
        abstract=[
            *axes.abstract(results),
            *(drawing.found or drawing.caption for drawing in mapped),
        ],
        subject=subject,
        parts=parts,
        as_companion=companion,
    )


@dataclass(frozen=True)
class _Chapter:
    """A companion, what is said of it, and the folder of its figures."""

    results: StudyResults
    report: Report
    folder: str
    #: Whether it accompanies the study itself, and not a companion.
    own: bool


def _abstract(results: StudyResults, report: Report, chapters: Sequence[_Chapter]) -> list[str]:
    """Of a study that only gathers others, what those found."""
    if results.runs or results.swept or not chapters:
        return list(report.abstract)
    return [f"{c.results.title}: {' '.join(c.report.abstract)}" for c in chapters if c.own]


def _chapters(results: StudyResults, timings: bool, folder: str = "") -> Iterator[_Chapter]:
    """A chapter a companion, and a companion's companion."""
    for companion in results.companions:
        inner = f"{folder}{companion.name}/"
        yield _Chapter(companion, _report(companion, timings), inner, not folder)
        yield from _chapters(companion, timings, inner)


def _companion(chapter: _Chapter) -> Content:
    report = chapter.report
    parts = report.parts if report.as_companion is None else report.as_companion
    return {"title": chapter.results.title, "parts": _placed(parts, chapter.folder)}


def _placed(parts: Sequence[Part], folder: str) -> list[Part]:
    """Parts whose figures lie in a folder of their own."""

    def moved(block: Block) -> Block:
        return block | {"file": folder + block["file"]} if block["kind"] == "figure" else block

    return [part | {"blocks": [moved(block) for block in part["blocks"]]} for part in parts]


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
    return [bullets(lines)]

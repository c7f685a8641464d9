"""What the report says of a study with axes: a part a design, with its figures and tables."""

from __future__ import annotations

from collections import Counter

from contactstudy.figures import axes
from contactstudy.plot.text import capital, label
from contactstudy.report.blocks import Block, bullets, figure, table, text
from contactstudy.study.axes.axis import axis_of, title_of
from contactstudy.study.axes.convergences import convergences
from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.shown import shown
from contactstudy.study.axes.tables import tables
from contactstudy.study.kind import Part
from contactstudy.study.results import StudyResults

_FAILED = 12  # failures that are listed


def abstract(results: StudyResults) -> list[str]:
    """What is varied, what is found, and what failed."""
    told = []
    for name, data in results.designs.items():
        keys = [str(k) for k in data.coords if set(data[k].dims) <= set(data["variant"].dims)]
        ranges = "; ".join(_range(results, name, key) for key in keys)
        what = "varied" if not data.attrs["refined"] else "refined"
        told.append(f"{data['variant'].size} variants of the study: {what} are {ranges}.")
    lost = len(results.failures)
    if lost:
        told.append(f"{lost} variants could not be computed; they are left out of all numbers.")
    verdicts = Counter(
        line.verdict
        for quantity in shown(results)
        if quantity.data.attrs["refined"]
        for line in convergences(quantity)
    )
    if verdicts:
        counts = ", ".join(f"{n} “{verdict}”" for verdict, n in verdicts.items())
        told.append(f"Verdicts of the refinements: {counts}.")
    return [" ".join(told), *(drawing.caption for drawing in axes.drawings(results)[:1])]


def parts(results: StudyResults) -> list[Part]:
    """A part a design."""
    drawings, found = axes.drawings(results), tuple(tables(results))
    made: list[Part] = []
    for name, data in results.designs.items():
        stem = name.replace(".", "_")
        own = [d for d in drawings if d.name.startswith(f"{stem}_")]
        blocks: list[Block] = [figure(d.name, d.caption) for d in own]
        for one in found:
            if one.design == name and one.rows:
                columns = [capital(c) for c in one.columns]
                rows = [list(row) for row in one.rows]
                blocks.append(table(columns, rows, f"{one.title}.", one.left) | {"size": 8})
        if failed := _failures(results, name):
            blocks += [text("Variants that could not be computed:"), bullets(failed)]
        refined = data.attrs["refined"]
        title = f"Refinement of the {title_of(refined)}" if refined else "Sweep"
        made.append({"title": title, "blocks": blocks})
    if any(data.attrs["refined"] for data in results.designs.values()):
        made[-1]["blocks"].append(text(_REFINED))
    return made


_REFINED = (
    "Order, limit and band are fitted by least squares to all sizes; GCI is the band relative to "
    "the finest value. “asymptotic”: the sizes are fine enough for order, limit and band to be "
    "believed; “not yet”: they are not, or too few to tell; “round-off”: refining changes nothing "
    "any more."
)


def _range(results: StudyResults, design: str, key: str) -> str:
    data = results.designs[design]
    along = axis_of(data, key)
    if len(along.names) > 4:
        return f"{title_of(key)}, {along.names[0]} to {along.names[-1]} ({len(along.names)} values)"
    return f"{title_of(key)}, {', '.join(along.names)}"


def _failures(results: StudyResults, design: str) -> list[str]:
    data = results.designs[design]
    reasons = {
        str(name): str(reason)
        for name, reason in zip(data["variant"].values.flat, data[FAILURE].values.flat, strict=True)
        if reason
    }
    titles = {n: v["title"] for n, v in results.metrics["variants"].items()}
    listed = [f"{label(titles[name])}: {reason}" for name, reason in reasons.items()]
    more = [f"and {len(listed) - _FAILED} more"] if len(listed) > _FAILED else []
    return listed[:_FAILED] + more

"""What the report says of a study with axes: a part a design, with its figures and tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.figures import axes
from contactstudy.plot.text import capital, counted, label
from contactstudy.report.blocks import Block, bullets, figure, table, text
from contactstudy.report.parameters import origin
from contactstudy.report.quantity import quantity
from contactstudy.study.axes.axis import axis_of, title_of
from contactstudy.study.axes.convergences import convergences
from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.shown import shown
from contactstudy.study.axes.tables import tables
from contactstudy.study.kind import Part, find_kind
from contactstudy.study.results import StudyResults
from contactstudy.validation import entries

if TYPE_CHECKING:
    import xarray as xr

_FAILED = 12  # failures that are listed
_LISTED = 3  # refinements whose values an abstract tells


def abstract(results: StudyResults) -> list[str]:
    """What is varied, what is found, and what failed."""
    refined = {n: d for n, d in results.designs.items() if d.attrs["refined"]}
    told = _observed(results)
    if len(refined) > _LISTED:
        variants = counted(sum(d["variant"].size for d in refined.values()), "variant")
        told.append(f"{len(refined)} keys are refined one at a time, in {variants}.")
    for name, data in results.designs.items():
        if name in refined and len(refined) > _LISTED:
            continue
        ranges = [f"{title_of(key)} ({_values(results, name, key)})" for key in _how(data)]
        what = "refined" if data.attrs["refined"] else "varied"
        verb = "is" if len(ranges) == 1 else "are"
        told.append(
            f"{counted(data['variant'].size, 'variant')}: {' and '.join(ranges)} {verb} {what}."
        )
    lost = len(results.failures)
    if lost:
        told.append(f"{counted(lost, 'variant')} could not be computed, left out of all numbers.")
    for reason, count in results.metrics.get("left_out", {}).items():
        told.append(f"{counted(count, 'variant')} left out: {reason}.")
    verdicts = Counter(
        line.verdict
        for one in shown(results)
        if one.data.attrs["refined"]
        for line in convergences(one)
    )
    if verdicts:
        counts = ", ".join(f"{n} “{verdict}”" for verdict, n in verdicts.items())
        told.append(f"Verdicts of the refinements: {counts}.")
    swept = [name for name, data in results.designs.items() if not data.attrs["refined"]]
    first = [d.found for d in axes.drawings(results) if swept and d.name.startswith(swept[0])]
    return [" ".join(told), *first[:1]]


def _observed(results: StudyResults) -> list[str]:
    """Where the expected orders are found: of the quantity that has most of them."""
    found: dict[str, list[tuple[bool, str, str]]] = {}
    for one in shown(results):
        expected = one.data.attrs.get("expected_order")
        if expected and one.name.startswith("from_finest"):
            what = f"{title_of(one.data.attrs['refined'])} {expected:g}"
            found.setdefault(one.quantity_and_unit[0], []).extend(
                (line.agrees(expected), what, f"{line.name} {line.order_text}".strip())
                for line in convergences(one)
            )
    if not any(found.values()):
        return []
    title, best = max(found.items(), key=lambda item: sum(agrees for agrees, *_ in item[1]))
    told = f"{title}: the expected order is observed in {sum(a for a, *_ in best)} of {len(best)}"
    for agrees, head in ((True, " cases"), (False, "; not")):
        runs: dict[str, list[str]] = {}
        for _, what, observed in (case for case in best if case[0] is agrees):
            runs.setdefault(what, []).append(observed.replace("order ", ""))
        listed = [f"{what} ({', '.join(texts)})" for what, texts in runs.items()]
        told += f"{head}: {'; '.join(listed)}" if listed else ""
    return [f"{told}."]


def subject(results: StudyResults) -> list[Block]:
    """The runs as the study has them, and the keys that are varied."""
    runs = results.config.get("runs", {})
    own = {name: chosen(results, run) for name, run in runs.items()}
    shared = _shared(list(own.values()))
    listed = []
    for name, keys in own.items():
        told = [_told(results, name, k, v) for k, v in keys.items() if k not in shared]
        listed.append(f"{label(name)}: {', '.join(told)}")
    if shared:
        told = [_told(results, next(iter(own)), k, v) for k, v in shared.items()]
        listed.append(f"all runs: {', '.join(told)}")
    rows = []  # of keys that several designs vary alike, one
    for name, data in results.designs.items():
        for key, how in _how(data).items():
            if (row := [title_of(key), _values(results, name, key), how]) not in rows:
                rows.append(row)
    columns = ["Key", "Values", "How"]
    varied = table(columns, rows, "Keys that are varied.", 3) | {"size": 8.5}
    return [*([bullets(listed)] if listed else []), varied]


def _shared(runs: list[dict[str, Any]]) -> dict[str, Any]:
    """What all runs have alike, if each has something of its own beside."""
    if len(runs) < 2:
        return {}
    same = {k: v for k, v in runs[0].items() if all((k, v) in r.items() for r in runs)}
    return same if all(len(run) > len(same) for run in runs) else {}


def chosen(results: StudyResults, run: Mapping[str, Any]) -> dict[str, Any]:
    """What a run has that is no default, and what tells what it is."""
    known: dict[str, Any] = {}
    first = next(iter(run))
    kind = find_kind(results.kind)
    for inner in kind.inner_tables.values():
        known |= entries(inner)
    told = {first, *kind.telling}
    return {k: v for k, v in run.items() if k in told or origin(known.get(k), v) != "default"}


def _told(results: StudyResults, run: str, key: str, value: Any) -> str:
    shown = " ".join(quantity(value, results.units.get(f"runs.{run}.{key}", ""))).strip()
    return f"{label(key)} {label(shown)}"


def _how(data: xr.Dataset) -> dict[str, str]:
    """Key of a design -> how it is varied."""
    refined, combine = data.attrs["refined"], data.attrs["combine"].replace("_", " ")
    keys = [str(k) for k in data.coords if set(data[k].dims) <= set(data["variant"].dims)]
    return {key: "refined" if key == refined else combine for key in keys}


def parts(results: StudyResults) -> list[Part]:
    """A part a design."""
    drawings, found = axes.drawings(results), tuple(tables(results))
    made: list[Part] = []
    for name, data in results.designs.items():
        stem = name.replace(".", "_")
        own = [d for d in drawings if d.name.startswith(f"{stem}_")]
        blocks: list[Block] = [text(told) for told in _orders(results, name)]
        blocks += [figure(d.name, d.caption) for d in own]
        for one in found:
            if one.design == name and one.rows:
                names = [label(run) for run in data["run"].values] if "run" in data else []
                columns = [c if c in names else capital(c) for c in one.columns]
                rows = [list(row) for row in one.rows]
                blocks.append(table(columns, rows, f"{one.title}.", one.left) | {"size": 8})
        if failed := _failures(results, name):
            blocks += [text("Variants that could not be computed:"), bullets(failed)]
        refined = data.attrs["refined"]
        title = f"Refinement of the {title_of(refined)}" if refined else "Sweep"
        made.append({"title": title, "blocks": blocks})
    if any(convergences(one) for one in shown(results) if one.data.attrs["refined"]):
        made[-1]["blocks"].append(text(_REFINED))
    return made


_REFINED = (
    "Order, limit and band are fitted by least squares to all sizes; GCI is the band relative to "
    "the finest value. “asymptotic”: the sizes are fine enough for order, limit and band to be "
    "believed; “not yet”: they are not, or too few to tell; “round-off”: refining changes nothing "
    "any more."
)


def _orders(results: StudyResults, design: str) -> list[str]:
    """Which order is expected and why, and which runs have it."""
    attrs = results.designs[design].attrs
    expected, why = attrs.get("expected_order"), attrs.get("why", "")
    if not attrs["refined"] or not (expected or why):
        return []
    head = f"Expected order {expected:g}" if expected else "No order is expected"
    told = f"{head}: {why}." if why else f"{head}."
    for one in shown(results):
        if one.data.attrs["design"] != design or not one.name.startswith("from_finest"):
            continue
        if expected and (lines := convergences(one)):
            yes = [f"{line.name} ({line.order_text})" for line in lines if line.agrees(expected)]
            no = [f"{line.name} ({line.order_text})" for line in lines if not line.agrees(expected)]
            told += f" {one.quantity_and_unit[0]}:"
            told += f" observed of {', '.join(yes)};" if yes else ""
            told += f" not of {', '.join(no)};" if no else ""
            told = told.removesuffix(";") + "."
    return [told]


def _values(results: StudyResults, design: str, key: str) -> str:
    along = axis_of(results.designs[design], key)
    if len(along.names) <= 4:
        return ", ".join(along.names)
    order = np.argsort(along.at)
    first, last = (along.names[k] for k in (order[0], order[-1]))
    return f"{first} to {last}, {len(along.names)} values"


def _failures(results: StudyResults, design: str) -> list[str]:
    data = results.designs[design]
    reasons = {
        str(name): str(reason)
        for name, reason in zip(data["variant"].values.flat, data[FAILURE].values.flat, strict=True)
        if reason
    }
    titles = {n: v["title"] for n, v in results.metrics["variants"].items()}
    listed = [f"{label(titles[n])}: {reason}" for n, reason in reasons.items() if n in titles]
    more = [f"and {len(listed) - _FAILED} more"] if len(listed) > _FAILED else []
    return listed[:_FAILED] + more

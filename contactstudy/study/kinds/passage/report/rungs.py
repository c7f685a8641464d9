"""What a ladder says: sentences that follow from the numbers, and tables of its errors."""

from collections.abc import Mapping
from itertools import pairwise

from contactstudy.figures.ladder import DYNAMIC, IRREGULARITY, PARTS, Rung, ladder
from contactstudy.figures.signals import DECK, SIGNALS, Signal
from contactstudy.plot.text import label
from contactstudy.report.blocks import Block, table
from contactstudy.report.quantity import rounded
from contactstudy.study.kinds.passage.report.error_tables import fast_note
from contactstudy.study.results import StudyResults

_LARGE = 3.0
"""A step that exceeds the error of the rung above so many times is called decisive."""
_WITH_DECK = ("contact_force", "wheel_acceleration")
"""Signals that are shown beside those of decks; a page holds no more columns."""


def sentences(results: StudyResults) -> list[str]:
    """The decisive steps, and what is left when only the others are taken."""
    rungs = [r for r in ladder(results) if DYNAMIC in r.from_top and DYNAMIC in r.step]
    if not rungs:
        return []
    last = rungs[-1]
    told = [
        f"From {label(str(results.reference))} down to {label(last.name)} the force's error grows "
        f"to {rounded(last.from_top[DYNAMIC])} % of the dynamic part in {len(rungs)} steps."
    ]
    largest = max(rungs, key=lambda r: r.step[DYNAMIC])
    told.append(
        f"The largest step, {rounded(largest.step[DYNAMIC])} %, is that from "
        f"{label(largest.above)} to {label(largest.name)}."
    )
    if (first := _decisive(rungs)) is not None:
        before = rungs[: rungs.index(first)]
        worst = max(before, key=lambda r: r.from_top[DYNAMIC])
        told.append(
            f"All rungs above {label(first.name)} are within {rounded(worst.from_top[DYNAMIC])} % "
            f"of the top{_irregularity(before)}; that step alone changes the force by "
            f"{rounded(first.step[DYNAMIC])} %."
        )
    back = [r for above, r in pairwise(rungs) if _nearer(above, r)]
    if back:
        names = ", ".join(f"{label(r.name)} ({rounded(r.from_top[DYNAMIC])} %)" for r in back)
        verb = "stands" if len(back) == 1 else "stand"
        told.append(f"Nearer to the top than the rung above {verb} {names}: errors that cancel.")
    return [" ".join(told)]


def _decisive(rungs: list[Rung]) -> Rung | None:
    """The first step that is much larger than all the error before it."""
    for above, rung in pairwise(rungs):
        if rung.step[DYNAMIC] > _LARGE * above.from_top[DYNAMIC]:
            return rung
    return None


def _irregularity(rungs: list[Rung]) -> str:
    found = [r.from_top[IRREGULARITY] for r in rungs if IRREGULARITY in r.from_top]
    if not found:
        return ""
    return f" ({rounded(max(found))} % of the part that the irregularity causes)"


def _nearer(above: Rung, rung: Rung) -> bool:
    return rung.from_top[DYNAMIC] < 0.95 * above.from_top[DYNAMIC]


def rung_tables(results: StudyResults) -> list[Block]:
    """Error of every rung against the top, and against the rung above: parts of all signals."""
    shown_of = (*(s for s in SIGNALS if s.name in _WITH_DECK), *DECK)
    decked = any(DYNAMIC in rung.from_top for rung in ladder(results, DECK[0].name))
    of_signals = {s: ladder(results, s.name) for s in (shown_of if decked else SIGNALS)}
    shown = [
        (signal, part)
        for signal, rungs in of_signals.items()
        for part in (PARTS if signal.name == "contact_force" else (DYNAMIC,))
        if any(part in rung.from_top for rung in rungs)
    ]
    columns = ["Rung", *(_heading(signal, part) for signal, part in shown)]
    tables: list[Block] = []
    for words, measured in (("the top", _from_top), ("the rung above", _from_above)):
        rows = [
            [
                label(rung.name),
                *(rounded(measured(of_signals[signal][k]).get(part)) for signal, part in shown),
            ]
            for k, rung in enumerate(ladder(results))
        ]
        if rows:
            caption = (
                f"Relative L₂ difference from {words} in per cent; of motions the dynamic part."
            )
            note = fast_note(results) if tables and not decked else ""
            tables.append(table(columns, rows, caption, note=note) | {"size": 8})
    return tables


def _heading(signal: Signal, part: str) -> str:
    return f"Force, {PARTS[part][0]}" if signal.name == "contact_force" else signal.label


def _from_top(rung: Rung) -> Mapping[str, float]:
    return rung.from_top


def _from_above(rung: Rung) -> Mapping[str, float]:
    return rung.step

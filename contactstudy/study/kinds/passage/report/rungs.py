"""What a ladder says: sentences that follow from the numbers, and the table of its steps."""

from itertools import pairwise

from contactstudy.figures.ladder import DYNAMIC, IRREGULARITY, Rung, ladder
from contactstudy.figures.signals import SIGNALS
from contactstudy.plot.text import label
from contactstudy.report.blocks import Block, table
from contactstudy.report.quantity import rounded
from contactstudy.study.results import StudyResults

_LARGE = 3.0
"""A step that exceeds the error of the rung above so many times is called decisive."""


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


def rung_table(results: StudyResults) -> Block | None:
    """Difference of each signal's dynamic part from the rung above."""
    steps = {
        signal: [rung.step.get(DYNAMIC) for rung in ladder(results, signal.name)]
        for signal in SIGNALS
    }
    shown = [signal for signal, values in steps.items() if any(values)]
    rows = [
        [label(rung.name), *(rounded(steps[signal][k]) for signal in shown)]
        for k, rung in enumerate(ladder(results))
    ]
    if not rows:
        return None
    return table(
        ["Rung", *(signal.label for signal in shown)],
        rows,
        "Difference from the rung above in per cent of the dynamic part, for each signal.",
    )

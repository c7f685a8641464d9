"""What is measured of each variant, once its pieces of work are finished, in processes here."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from contactstudy.exceptions import ContactStudyError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.reporter import Bars, Reporter
from contactstudy.store import Kept, Store
from contactstudy.study.axes.swept import Swept, finest_points
from contactstudy.study.kind import imported
from contactstudy.study.study import Study

if TYPE_CHECKING:
    from contactstudy.study.plan import Piece, Plan, Planned

MEASURED = "measured"
"""Entry of a variant that was measured."""
_CHUNK = 32  # variants that one task measures
_HERE = 16  # variants at most for which no process is started


@dataclass(frozen=True)
class Asked:
    """Something to measure: function, study, and keys of its pieces of work by name."""

    measuring: str
    study: Study
    keys: Mapping[str, str]
    #: Those of the finest variant, which it is compared with.
    finest: Mapping[str, str] | None = None


def measure(
    plan: Plan, found: Mapping[Piece, Kept], workers: int, reporter: Reporter
) -> tuple[dict[str, Kept], dict[str, str]]:
    """Key of each variant whose pieces are all finished: what is measured of it; what went wrong.

    What is measured already is not measured again.
    """
    store, wanted = plan.measures, dict(_wanted(plan, found))
    kept = {key: store.load(MEASURED, key) for key in wanted}
    todo = [key for key, one in kept.items() if one.value is None]
    tasks: list[Task] = []
    owners: dict[str, Sequence[str]] = {}
    size = min(_CHUNK, max(1, -(-len(todo) // (2 * workers))))
    for k in range(0, len(todo), size):
        name, own = f"norms {k + 1}", todo[k : k + size]
        arguments = (plan.store, [wanted[key] for key in own])
        tasks.append(Task(name, measure_all, arguments, here=len(todo) <= _HERE))
        owners[name] = own
    bars, wrong = Bars(reporter, dict.fromkeys(owners, "norms")), dict[str, str]()

    def finished(name: str, outcome: Outcome) -> None:
        results = outcome.value if outcome.error is None else [outcome.error] * len(owners[name])
        for key, value in zip(owners[name], results, strict=True):
            if isinstance(value, ContactStudyError):
                wrong[key] = f"norms: {value}"
            else:
                store.save(MEASURED, key, value)
        bars.end(name, outcome.error is None)

    run_tasks(tasks, workers, bars, finished)
    if wrong and len(wrong) == len(wanted):
        raise ContactStudyError(next(iter(wrong.values())))
    made = {key: store.load(MEASURED, key) for key in todo if key not in wrong}
    return {key: one for key, one in kept.items() if key not in wrong} | made, wrong


def _wanted(plan: Plan, found: Mapping[Piece, Kept]) -> Iterator[tuple[str, Asked]]:
    """All that can be measured, under its key."""
    from contactstudy.study.plan import refined_key

    def whole(variant: Planned) -> bool:
        return all(found[piece].value for piece in variant.pieces.values())

    for variant in plan.variants.values():
        if whole(variant):
            yield variant.key, Asked(plan.kind.measuring, variant.study, variant.keys)
    assert isinstance(plan.study, Swept)
    for name, best in finest_points(plan.study) if plan.kind.refining else ():
        if {name, best} & plan.left_out.keys():
            continue
        variant, finest = plan.variants[name], plan.variants[best]
        if whole(variant) and whole(finest):
            key = refined_key(plan.kind, variant, finest)
            yield key, Asked(plan.kind.refining, variant.study, variant.keys, finest.keys)


def measure_all(store: Store, asked: Sequence[Asked], progress: Progress) -> list[Any]:
    """What is measured of each, or the error; the body of a worker process."""
    found, finest = list[Any](), dict[str, Mapping[str, Any]]()
    for one in asked:
        try:
            arguments = [one.study, _pieces(store, one.keys)]
            if one.finest is not None:
                key = repr(one.finest)
                if key not in finest:
                    finest = {key: _pieces(store, one.finest)}
                arguments.append(finest[key])
            found.append(imported(one.measuring)(*arguments))
        except ContactStudyError as error:
            found.append(error)
    return found


def _pieces(store: Store, keys: Mapping[str, str]) -> dict[str, Any]:
    kept = {name: store.load(name, key) for name, key in keys.items()}
    for one in kept.values():
        if one.value is None:
            raise ContactStudyError(
                f"{one.damage or 'a finished run is lost'}; run the study again"
            )
    return {name: one.value for name, one in kept.items()}

"""What is measured of each variant, once its pieces of work are finished, in processes here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from contactstudy.exceptions import ContactStudyError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.reporter import Bars, Reporter
from contactstudy.store import Kept, Store
from contactstudy.study.kind import Study, imported

if TYPE_CHECKING:
    from contactstudy.study.plan import Piece, Plan, Planned

MEASURED = "measured"
"""Entry of a variant that was measured."""
_CHUNK = 32  # variants that one task measures
_HERE = 16  # variants at most for which no process is started


def measure(
    plan: Plan, found: Mapping[Piece, Kept], jobs: int, reporter: Reporter
) -> dict[str, Kept]:
    """Key of each variant whose pieces are all finished, and what is measured of it.

    What is measured already is not measured again.
    """
    store = plan.measures
    whole = [v for v in plan.variants.values() if all(found[p].value for p in v.pieces.values())]
    kept = {v.key: store.load(MEASURED, v.key) for v in whole}
    todo = [v for v in whole if kept[v.key].value is None]
    tasks: list[Task] = []
    owners: dict[str, Sequence[Planned]] = {}
    size = min(_CHUNK, max(1, -(-len(todo) // (2 * jobs))))
    for k in range(0, len(todo), size):
        name, own = f"norms {k + 1}", todo[k : k + size]
        variants = [(v.study, {n: p.key for n, p in v.pieces.items()}) for v in own]
        arguments = (plan.kind.measuring, plan.store, variants)
        tasks.append(Task(name, measure_variants, arguments, here=len(todo) <= _HERE))
        owners[name] = own
    bars, errors = Bars(reporter, dict.fromkeys(owners, "norms")), list[ContactStudyError]()

    def finished(name: str, outcome: Outcome) -> None:
        if outcome.error is not None:
            errors.append(outcome.error)
        for variant, value in zip(owners[name], outcome.value or (), strict=outcome.error is None):
            store.save(MEASURED, variant.key, value)
        bars.end(name, outcome.error is None)

    run_tasks(tasks, jobs, bars, finished)
    if errors:
        raise errors[0]
    return kept | {v.key: store.load(MEASURED, v.key) for v in todo}


def measure_variants(
    measuring: str,
    store: Store,
    variants: Sequence[tuple[Study, Mapping[str, str]]],
    progress: Progress,
) -> list[Any]:
    """Measure variants, given with the keys of their pieces; the body of a worker process."""
    function, found = imported(measuring), []
    for study, keys in variants:
        pieces = {name: store.load(name, key) for name, key in keys.items()}
        for kept in pieces.values():
            if kept.value is None:
                raise ContactStudyError(f"{kept.damage or 'a finished run is lost'}; run it again")
        found.append(function(study, {name: kept.value for name, kept in pieces.items()}))
    return found

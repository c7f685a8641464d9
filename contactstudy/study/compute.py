"""Compute the pieces of a plan that are not finished, in other processes unless all are light."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.files import ensure_writable
from contactstudy.process import peak_memory_mb
from contactstudy.reporter import Bars, Reporter
from contactstudy.store import Kept
from contactstudy.study.axes.measure import measure
from contactstudy.study.kind import imported
from contactstudy.study.plan import FAILED, Piece, Plan
from contactstudy.study.study import Study

BATCH = 64
"""Most pieces of work that are computed together."""
_HERE = 8  # light pieces at most for which no process is started


@dataclass(frozen=True)
class Found:
    """What became of the work of a plan and its companions."""

    #: Finished pieces; of studies with axes without their values.
    pieces: Mapping[Piece, Kept]
    #: Key of a variant -> what was measured of it.
    measured: Mapping[str, Kept] = field(default_factory=dict)
    #: Why pieces could not be computed.
    failures: Mapping[Piece, str] = field(default_factory=dict)


def compute(plan: Plan, jobs: int, reporter: Reporter, executor: Executor | None = None) -> Found:
    """Compute what is not finished yet, of a plan and its companions.

    Pieces run in the `executor`, by default in `jobs` processes of their own; what is measured of
    variants is always measured here.

    Raises
    ------
    NumericalError or InputError
        Listing the pieces of studies without axes that failed, when the others are finished.
    """
    for one in plan.all:
        ensure_writable(one.store.folder)
    found = {piece: kept for one in plan.all for piece, kept in _kept(one)}
    todo = [(one, p) for one in plan.all for p in one.pieces if found[p].value is None]
    for _, piece in todo:
        if found[piece].damage:
            reporter.note(f"{found[piece].damage}; computed again")
    for one in plan.all:
        _admit(one, [p for owner, p in todo if owner is one], reporter)
    failures: dict[Piece, str] = {}
    if todo:
        failures = _run(plan, todo, jobs, reporter, executor)
        again = dict.fromkeys(p for _, p in todo)
        found |= {p: k for one in plan.all for p, k in _kept(one, again) if p not in failures}
    for piece, kept in found.items():
        if kept.value is None and piece not in failures:
            lost = f"run {piece.label}: was computed but is not in the store"
            raise ContactStudyError(kept.damage or lost)
    measured = dict[str, Kept]()
    for one in plan.all:
        if one.swept:
            measured |= measure(one, found, jobs, reporter)
    return Found(found, measured, failures)


def _kept(plan: Plan, of: Iterable[Piece] | None = None) -> Iterator[tuple[Piece, Kept]]:
    """What the store has of pieces; only whether it has them of a study with axes."""
    asked = None if of is None else set(of)
    for piece in plan.pieces:
        if asked is None or piece in asked:
            yield piece, plan.whole(piece) if plan.swept else plan.kept(piece)


def _admit(plan: Plan, pieces: Sequence[Piece], reporter: Reporter) -> None:
    by_study: dict[int, list[Piece]] = {}
    for piece in pieces:
        by_study.setdefault(id(piece.study), []).append(piece)
    problems: list[str] = []
    for own in by_study.values():
        try:
            plan.kind.admit(own[0].study, [p.work.name for p in own], reporter)
        except InputError as error:
            title = f"{own[0].title}: " if own[0].title else ""
            problems += [f"{title}{problem}" for problem in error.problems]
    if problems:
        raise InputError(problems)


def _run(
    plan: Plan,
    todo: list[tuple[Plan, Piece]],
    jobs: int,
    reporter: Reporter,
    executor: Executor | None,
) -> dict[Piece, str]:
    """Compute and keep pieces; why those of studies with axes failed."""
    names, bodies, tasks = _Names(), dict[str, Task](), dict[str, Task]()
    bars, owners = dict[str, str](), dict[str, list[tuple[Plan, Piece]]]()
    few = len(todo) <= _HERE
    # The long ones first, so that the short ones fill the gaps.
    for group in _groups(sorted(todo, key=lambda pair: not pair[1].work.long), jobs):
        one, first = group[0]
        needed = (one.kind.before(p.study, p.work.name) for _, p in group)
        before = [task for own in needed for task in names.tasks(own)]
        bodies |= {task.name: task for task in before}
        of = "" if one is plan else f"{one.study.name}: "
        more = f" and {len(group) - 1} more" if len(group) > 1 else ""
        name = names.free(f"{of}{first.label}{more}")
        pieces = tuple((p.study, p.work.name) for _, p in group)
        arguments = (one.kind.computing, one.kind.batching, pieces)
        after = tuple(dict.fromkeys(task.name for task in before))
        here = few and all(p.work.light for _, p in group)
        tasks[name] = Task(name, execute, arguments, after, here)
        owners[name] = group
        if one.swept:
            bars[name] = of + "runs"
        elif first.work.bar:
            bars[name] = of + first.work.bar
    failures: dict[Piece, ContactStudyError] = {}
    shown = Bars(reporter, bars)

    def finished(name: str, outcome: Outcome) -> None:
        results = outcome.value if name in owners and outcome.error is None else []
        if outcome.error is not None and name in owners:
            results = [outcome.error] * len(owners[name])
        good = outcome.error is None
        for (one, piece), made in zip(owners.get(name, ()), results, strict=True):
            if isinstance(made, ContactStudyError):
                good, failures[piece] = False, made
                if one.swept:
                    one.measures.save(FAILED, piece.key, _lines(piece, made))
            else:
                one.store.save(piece.work.name, piece.key, *made)
                one.measures.discard(FAILED, piece.key)
        shown.end(name, good)

    outcomes = run_tasks([*bodies.values(), *tasks.values()], jobs, shown, finished, executor)
    lost = [o.error for name, o in outcomes.items() if name not in owners and o.error is not None]
    strict = {p: e for p, e in failures.items() if not p.title}
    for one in plan.all:  # nothing is left to show
        if all(failures.keys() & v.pieces.values() for v in one.variants.values()):
            strict |= {p: e for p, e in failures.items() if p in one.pieces}
    if strict:
        _raise(strict, lost, plan.store.folder)
    return {piece: "; ".join(_lines(piece, error)) for piece, error in failures.items()}


def _groups(todo: Sequence[tuple[Plan, Piece]], jobs: int) -> Iterator[list[tuple[Plan, Piece]]]:
    """Pieces that are computed together, at the place of the first of them."""
    batches: dict[tuple[int, str], list[tuple[Plan, Piece]]] = {}
    for one, piece in todo:
        if piece.work.batch and one.swept:
            batches.setdefault((id(one), piece.work.batch), []).append((one, piece))
    # some batches for each worker, so that all end at about the same time
    size = {key: min(BATCH, max(1, -(-len(own) // (2 * jobs)))) for key, own in batches.items()}
    for one, piece in todo:
        if not (piece.work.batch and one.swept):
            yield [(one, piece)]
        elif own := batches.pop((id(one), piece.work.batch), None):
            step = size[id(one), piece.work.batch]
            yield from (own[k : k + step] for k in range(0, len(own), step))


class _Names:
    """Gives equal tasks one name, and different ones different names."""

    def __init__(self) -> None:
        self._tasks, self._taken = dict[tuple[Any, ...], Task](), set[str]()

    def free(self, name: str) -> str:
        """A name that nothing else has."""
        made, number = name, 2
        while made in self._taken:
            made, number = f"{name} ({number})", number + 1
        self._taken.add(made)
        return made

    def tasks(self, tasks: Sequence[Task]) -> list[Task]:
        """Tasks under names of their own, also where they wait for each other; equal ones once."""
        made: dict[str, Task] = {}
        for task in tasks:
            after = tuple(made[name].name for name in task.after)
            key = (task.name, task.function, repr(task.arguments))
            if key not in self._tasks:
                self._tasks[key] = replace(task, name=self.free(task.name), after=after)
            made[task.name] = self._tasks[key]
        return list(made.values())


def execute(
    computing: str, batching: str, pieces: Sequence[tuple[Study, str]], progress: Progress
) -> list[tuple[Any, dict[str, Any]] | ContactStudyError]:
    """Compute pieces of work; the body of a worker process.

    Value and cost of each, or the error that ended it where there are several.
    """
    began = time.perf_counter()
    if len(pieces) == 1:
        ((study, name),) = pieces
        values = [imported(computing)(study, name, progress)]
    elif batching:
        values = imported(batching)(pieces, progress)
    else:
        values = [_one(imported(computing), study, name, progress) for study, name in pieces]
    each = (time.perf_counter() - began) / len(pieces)
    return [v if isinstance(v, ContactStudyError) else (v, _cost(v, each)) for v in values]


def _one(compute_one: Callable[..., Any], study: Study, name: str, progress: Progress) -> Any:
    try:
        return compute_one(study, name, progress)
    except ContactStudyError as error:
        return error


def _cost(value: Any, each: float) -> dict[str, Any]:
    attrs = getattr(value, "attrs", {"seconds_stepping": each})
    seconds = {k: float(attrs.get(f"seconds_{k}", 0.0)) for k in ("setup", "stepping")}
    return {"seconds": seconds, "peak_memory_mb": peak_memory_mb()}


def _lines(piece: Piece, error: ContactStudyError) -> list[str]:
    """What a piece failed with; each line says which it is."""
    title = piece.work.title or f"run {piece.label}"
    lines = error.problems if isinstance(error, InputError) else (str(error),)
    own = (piece.label, piece.work.title or title, piece.work.name)
    return [line if line.startswith(own) else f"{title}: {line}" for line in lines]


def _raise(
    failures: Mapping[Piece, ContactStudyError], lost: Sequence[ContactStudyError], folder: Path
) -> None:
    texts = [str(error) for error in lost]
    texts += [line for piece, error in failures.items() for line in _lines(piece, error)]
    errors = [*lost, *failures.values()]
    if all(isinstance(error, InputError) for error in errors):
        raise InputError(texts)
    texts.append(f"finished runs are kept in {folder}")
    numerical = any(isinstance(error, NumericalError) for error in errors)
    raise (NumericalError if numerical else ContactStudyError)("\n".join(texts))

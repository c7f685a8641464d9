"""Compute the pieces of a plan that are not finished, in other processes unless all are light."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from pathlib import Path

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import Outcome, Task, at_once, run_tasks
from contactstudy.files import ensure_writable
from contactstudy.reporter import Bars, Reporter
from contactstudy.store import Kept
from contactstudy.study.axes.measure import measure
from contactstudy.study.plan import FAILED, Piece, Plan
from contactstudy.study.tasks import Names, execute, groups

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
    #: Key of a variant -> why it could not be measured.
    unmeasured: Mapping[str, str] = field(default_factory=dict)


def compute(
    plan: Plan, workers: int, reporter: Reporter, executor: Executor | None = None
) -> Found:
    """Compute what is not finished yet, of a plan and its companions.

    Pieces run in the `executor`, by default in `workers` processes of their own, in which what
    is measured of variants always is.

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
        failures = _run(plan, todo, workers, reporter, executor)
        again = dict.fromkeys(p for _, p in todo)
        found |= {p: k for one in plan.all for p, k in _kept(one, again) if p not in failures}
    for piece, kept in found.items():
        if kept.value is None and piece not in failures:
            lost = f"run {piece.label}: was computed but is not in the store"
            raise ContactStudyError(kept.damage or lost)
    measured, unmeasured = dict[str, Kept](), dict[str, str]()
    for one in plan.all:
        if one.swept:
            made, wrong = measure(one, found, workers, reporter)
            measured, unmeasured = measured | made, unmeasured | wrong
    return Found(found, measured, failures, unmeasured)


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
    workers: int,
    reporter: Reporter,
    executor: Executor | None,
) -> dict[Piece, str]:
    """Compute and keep pieces; why those of studies with axes failed."""
    # The long ones first, so that the short ones fill the gaps.
    ordered = sorted(todo, key=lambda pair: not pair[1].work.long)
    round_ = _Round(plan, list(groups(ordered, at_once(workers, executor))), reporter, here=True)
    round_.run(workers, executor)
    failures, lost = round_.failures, round_.lost
    if round_.broken:  # a process that died took all of its batch along
        alone = _Round(plan, [[pair] for pair in round_.broken], reporter, here=False)
        alone.run(workers, executor)
        failures, lost = failures | alone.failures, lost + alone.lost
    strict = {p: e for p, e in failures.items() if not p.title}
    for one in plan.all:  # nothing is left to show
        if all(failures.keys() & v.pieces.values() for v in one.variants.values()):
            strict |= {p: e for p, e in failures.items() if p in one.pieces}
    if strict:
        _raise(strict, lost, plan.store.folder)
    return {piece: "; ".join(_lines(piece, error)) for piece, error in failures.items()}


class _Round:
    """Groups of pieces that are computed in one go, with the bodies that they need."""

    def __init__(
        self,
        plan: Plan,
        parts: Sequence[list[tuple[Plan, Piece]]],
        reporter: Reporter,
        here: bool,
    ) -> None:
        names, bars, few = Names(), dict[str, str](), here and sum(map(len, parts)) <= _HERE
        self._bodies, self._tasks = dict[str, Task](), dict[str, Task]()
        self._owners = dict[str, list[tuple[Plan, Piece]]]()
        self.failures: dict[Piece, ContactStudyError] = {}
        self.broken: list[tuple[Plan, Piece]] = []
        self.lost: list[ContactStudyError] = []
        for group in parts:
            one, first = group[0]
            needed = (one.kind.before(p.study, p.work.name) for _, p in group)
            before = [task for own in needed for task in names.tasks(own)]
            self._bodies |= {task.name: task for task in before}
            of = "" if one is plan else f"{one.study.name}: "
            more = f" and {len(group) - 1} more" if len(group) > 1 else ""
            name = names.free(f"{of}{first.label}{more}")
            pieces = tuple((p.study, p.work.name) for _, p in group)
            arguments = (one.kind.computing, one.kind.batching, pieces)
            after = tuple(dict.fromkeys(task.name for task in before))
            light = few and all(p.work.light for _, p in group)
            self._tasks[name] = Task(name, execute, arguments, after, light)
            self._owners[name] = group
            if bar := "runs" if one.swept else first.work.bar:
                bars[name] = of + bar
        self._shown = Bars(reporter, bars)

    def run(self, workers: int, executor: Executor | None) -> None:
        """Compute, and keep each piece as soon as it is there."""
        tasks = [*self._bodies.values(), *self._tasks.values()]
        run_tasks(tasks, workers, self._shown, self._finished, executor)

    def _finished(self, name: str, outcome: Outcome) -> None:
        group, results = self._owners.get(name, []), outcome.value or []
        if outcome.error is not None:
            if not group:
                self.lost.append(outcome.error)
            if len(group) > 1:
                self.broken += group
                group = []
            results = [outcome.error] * len(group)
        good = outcome.error is None
        for (one, piece), made in zip(group, results, strict=bool(group)):
            if isinstance(made, ContactStudyError):
                good, self.failures[piece] = False, made
                if one.swept:
                    one.measures.save(FAILED, piece.key, _lines(piece, made))
            else:
                one.store.save(piece.work.name, piece.key, *made)
                one.measures.discard(FAILED, piece.key)
        self._shown.end(name, good)


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

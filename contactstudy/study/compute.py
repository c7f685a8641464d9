"""Compute the pieces of a plan that are not finished, in other processes unless all are light."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.files import ensure_writable, remove_unfinished
from contactstudy.process import peak_memory_mb
from contactstudy.reporter import Bars, Reporter
from contactstudy.store import Kept, Store
from contactstudy.study.kind import Study, imported
from contactstudy.study.plan import Piece, Plan


def compute(plan: Plan, jobs: int, reporter: Reporter) -> dict[Piece, Kept]:
    """Compute what is not finished yet, of a plan and its companions; all of it, finished.

    Raises
    ------
    NumericalError or InputError
        Listing the pieces that failed, when the others are finished.
    """
    found = {piece: one.kept(piece) for one in plan.all for piece in one.pieces}
    todo = [(one, p) for one in plan.all for p in one.pieces if found[p].value is None]
    for _, piece in todo:
        if found[piece].damage:
            reporter.note(f"{found[piece].damage}; computed again")
    for one in plan.all:
        ensure_writable(one.store.folder)
        missing = [p.work.name for owner, p in todo if owner is one]
        if missing:
            one.kind.admit(one.study, missing, reporter)
    if todo:
        _run(plan, todo, jobs, reporter)
        found |= {piece: one.kept(piece) for one, piece in todo}
    for piece, kept in found.items():
        if kept.value is None:
            lost = f"run {piece.label}: was computed but is not in the store"
            raise ContactStudyError(kept.damage or lost)
    return found


def _run(plan: Plan, todo: list[tuple[Plan, Piece]], jobs: int, reporter: Reporter) -> None:
    first, tasks = dict[str, Task](), dict[str, Task]()
    bars, titles = dict[str, str](), dict[str, str]()
    # The long ones first, so that the short ones fill the gaps.
    for one, piece in sorted(todo, key=lambda pair: not pair[1].work.long):
        before = one.kind.before(piece.study, piece.work.name)
        first |= {task.name: task for task in before}
        of = "" if one is plan else f"{one.study.name}: "
        name, work = of + piece.label, piece.work
        arguments = (one.kind.computing, piece.study, work.name, one.store, piece.entry, piece.key)
        after = tuple(task.name for task in before)
        tasks[name] = Task(name, execute, arguments, after, here=work.light)
        titles[name] = work.title or f"run {name}"
        if work.bar:
            bars[name] = of + work.bar
    try:
        outcomes = run_tasks([*first.values(), *tasks.values()], jobs, Bars(reporter, bars))
    finally:
        for one, piece in todo:  # what a worker was writing when it was ended
            remove_unfinished(one.store.folder, f"{piece.entry}-{piece.key}")
    _raise_failures(outcomes, titles, plan.store.folder)


def execute(
    computing: str, study: Study, work: str, store: Store, entry: str, key: str, progress: Progress
) -> None:
    """Compute one piece of work and store it; the body of a worker process."""
    began = time.perf_counter()
    value = imported(computing)(study, work, progress)
    attrs = getattr(value, "attrs", {"seconds_stepping": time.perf_counter() - began})
    seconds = {k: float(attrs.get(f"seconds_{k}", 0.0)) for k in ("setup", "stepping")}
    store.save(entry, key, value, {"seconds": seconds, "peak_memory_mb": peak_memory_mb()})


def _raise_failures(
    outcomes: Mapping[str, Outcome], titles: Mapping[str, str], folder: Path
) -> None:
    failed = {name: o.error for name, o in outcomes.items() if o.error is not None}
    if not failed:
        return
    texts = []
    for name, error in failed.items():
        lines = error.problems if isinstance(error, InputError) else (str(error),)
        title = titles.get(name, f"run {name}")
        texts += [line if line.startswith((name, title)) else f"{title}: {line}" for line in lines]
    if all(isinstance(error, InputError) for error in failed.values()):
        raise InputError(texts)
    texts.append(f"finished runs are kept in {folder}")
    kinds: type[ContactStudyError] = ContactStudyError
    if any(isinstance(error, NumericalError) for error in failed.values()):
        kinds = NumericalError
    raise kinds("\n".join(texts))

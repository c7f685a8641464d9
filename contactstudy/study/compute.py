"""Compute the runs of a study that are not finished, each in a process of its own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.reporter import Reporter
from contactstudy.study import store
from contactstudy.study.files import ensure_writable
from contactstudy.study.kinds.passage.execution import (
    condense_body,
    execute_run,
    is_condensed,
    peak_memory_mb,
)
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.plan import Plan


def compute(plan: Plan, jobs: int, reporter: Reporter) -> None:
    """Compute the runs that are not finished yet, of a plan and its companions.

    Raises
    ------
    NumericalError or InputError
        Listing the runs that failed, when the others are finished.
    """
    tasks, labels, bodies = [], {}, dict[str, Task]()
    for one in plan.all:
        ensure_writable(one.out_dir / store.STORE)
        for name in one.study.runs:
            path = store.run_path(one.out_dir, name, one.run_key(name))
            finished, damage = store.load_run(path)
            if damage:
                reporter.note(f"{damage}; computed again")
            if finished is not None:
                continue
            label = name if one is plan else f"{one.study.name}: {name}"
            needs = [b for b in one.study.bodies(name) if not is_condensed(one.study, b)]
            for body in needs:
                # Studies of one report share their bodies, as a rule; a run makes what is lacking.
                task = Task(f"condensing the {body}", condense_body, (one.study, body))
                bodies.setdefault(task.name, task)
            after = tuple(f"condensing the {body}" for body in needs)
            tasks.append(Task(label, execute, (one.study, name, path), after))
            labels[label] = path
    if not tasks:
        return
    # The long ones first, so that the short ones fill the gaps.
    tasks.sort(key=lambda task: not task.arguments[0].runs[task.arguments[1]].needs_solid)
    tasks = [*bodies.values(), *tasks]
    for task in tasks:
        reporter.begin(task.name, 0)

    def ended(name: str, outcome: Outcome) -> None:
        reporter.end(name, outcome.error is None)

    try:
        outcomes = run_tasks(
            tasks,
            jobs,
            reporter.progress,
            ended,
            lambda name, text: reporter.note(f"{name}: {text}"),
        )
    finally:
        for path in labels.values():  # what a worker was writing when it was ended
            for rest in path.parent.glob(f".{path.stem}-*"):
                rest.unlink(missing_ok=True)
    _raise_failures(outcomes, plan.out_dir)


def execute(study: Study, run: str, path: Path, progress: Progress) -> None:
    """Compute one run and store it; the body of a worker process."""
    data = execute_run(study, run, progress)
    store.save_run(path, data, peak_memory_mb())


def _raise_failures(outcomes: Mapping[str, Outcome], out_dir: Path) -> None:
    failed = {name: o.error for name, o in outcomes.items() if o.error is not None}
    if not failed:
        return
    texts = []
    for name, error in failed.items():
        lines = error.problems if isinstance(error, InputError) else (str(error),)
        texts += [line if line.startswith(name) else f"run {name}: {line}" for line in lines]
    if all(isinstance(error, InputError) for error in failed.values()):
        raise InputError(texts)
    texts.append(f"finished runs are kept in {out_dir / store.STORE}")
    kinds: type[ContactStudyError] = ContactStudyError
    if any(isinstance(error, NumericalError) for error in failed.values()):
        kinds = NumericalError
    raise kinds("\n".join(texts))

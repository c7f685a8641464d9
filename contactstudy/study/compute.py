"""Compute the runs of a study that are not finished, each in a process of its own."""

from __future__ import annotations

from collections.abc import Mapping

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.files import ensure_writable, remove_unfinished
from contactstudy.process import peak_memory_mb
from contactstudy.reporter import Reporter
from contactstudy.solids.cache import is_cached
from contactstudy.store import Store
from contactstudy.study.kinds.passage.build import bodies
from contactstudy.study.kinds.passage.execution import condense_body, execute_run
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.plan import Plan


def compute(plan: Plan, jobs: int, reporter: Reporter) -> None:
    """Compute the runs that are not finished yet, of a plan and its companions.

    Raises
    ------
    NumericalError or InputError
        Listing the runs that failed, when the others are finished.
    """
    tasks, condensing, paths = [], dict[str, Task](), []
    for one in plan.all:
        ensure_writable(one.runs.folder)
        for name in one.study.runs:
            key = one.run_key(name)
            kept = one.runs.load(name, key)
            if kept.damage:
                reporter.note(f"{kept.damage}; computed again")
            if kept.value is not None:
                continue
            after = []
            for body in bodies(one.study, name):
                if not is_cached(body):
                    label = f"condensing the {body.name}"
                    # Studies of one report share their bodies, as a rule; a run makes what is
                    # lacking.
                    condensing.setdefault(label, Task(label, condense_body, (body,)))
                    after.append(label)
            label = name if one is plan else f"{one.study.name}: {name}"
            arguments = (one.study, name, one.runs, key)
            tasks.append((one.study.runs[name], Task(label, execute, arguments, tuple(after))))
            paths.append(one.runs.path(name, key))
    if not tasks:
        return
    # The long ones first, so that the short ones fill the gaps.
    tasks.sort(key=lambda pair: not pair[0].needs_solid)
    everything = [*condensing.values(), *(task for _, task in tasks)]
    try:
        outcomes = run_tasks(everything, jobs, reporter)
    finally:
        for path in paths:  # what a worker was writing when it was ended
            remove_unfinished(path.parent, path.stem)
    _raise_failures(outcomes, plan)


def execute(study: Study, run: str, store: Store, key: str, progress: Progress) -> None:
    """Compute one run and store it; the body of a worker process."""
    data = execute_run(study, run, progress)
    seconds = {k: float(data.attrs.get(f"seconds_{k}", 0.0)) for k in ("setup", "stepping")}
    store.save(run, key, data, {"seconds": seconds, "peak_memory_mb": peak_memory_mb()})


def _raise_failures(outcomes: Mapping[str, Outcome], plan: Plan) -> None:
    failed = {name: o.error for name, o in outcomes.items() if o.error is not None}
    if not failed:
        return
    texts = []
    for name, error in failed.items():
        lines = error.problems if isinstance(error, InputError) else (str(error),)
        texts += [line if line.startswith(name) else f"run {name}: {line}" for line in lines]
    if all(isinstance(error, InputError) for error in failed.values()):
        raise InputError(texts)
    texts.append(f"finished runs are kept in {plan.runs.folder}")
    kinds: type[ContactStudyError] = ContactStudyError
    if any(isinstance(error, NumericalError) for error in failed.values()):
        kinds = NumericalError
    raise kinds("\n".join(texts))

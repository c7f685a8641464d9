"""Studies to results: find finished runs, compute the others, compare, write everything."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Protocol

from contactstudy.exceptions import ContactStudyError, InputError, NumericalError
from contactstudy.provenance import provenance, versions
from contactstudy.study import store
from contactstudy.study.files import ensure_writable, writing
from contactstudy.study.loading import load_companions
from contactstudy.study.results import (
    METRICS_FILE,
    RESULT_FILE,
    IrregularityInfo,
    StudyResults,
    read_results,
    write_results,
)
from contactstudy.study.schema import Study
from contactstudy.sweep import Outcome, Progress, Task, run_tasks

FINISHED = "finished.json"


class Reporter(Protocol):
    """Who tells the user how far things are; all methods are called in the main process."""

    def note(self, text: str) -> None:
        """Something worth knowing that is no error."""

    def begin(self, name: str, total: int) -> None:
        """A run that is going to be computed, with its number of steps."""

    def progress(self, name: str, done: int, total: int) -> None:
        """Steps done of a run."""

    def end(self, name: str, ok: bool) -> None:
        """A run has ended."""

    def stage(self, text: str) -> contextlib.AbstractContextManager[None]:
        """A stage of the work without steps, as a context."""


class Quiet:
    """A `Reporter` that says nothing."""

    def note(self, text: str) -> None:
        """Nothing."""

    def begin(self, name: str, total: int) -> None:
        """Nothing."""

    def progress(self, name: str, done: int, total: int) -> None:
        """Nothing."""

    def end(self, name: str, ok: bool) -> None:
        """Nothing."""

    @contextlib.contextmanager
    def stage(self, text: str) -> Iterator[None]:
        """Nothing."""
        yield


@dataclass(frozen=True)
class Plan:
    """A study whose inputs have been read, and where its results go."""

    study: Study
    out_dir: Path
    irregularity: IrregularityInfo
    inputs: Mapping[str, Any]
    files: Mapping[str, str]
    warnings: tuple[str, ...] = ()
    companions: tuple[Plan, ...] = ()

    @property
    def all(self) -> tuple[Plan, ...]:
        """This plan, then its companions'."""
        return (self, *(p for c in self.companions for p in c.all))

    def run_key(self, run: str) -> str:
        """Hash of everything that goes into one run, code included."""
        study = self.study
        table = study.runs[run].resolved() | {"time_step": study.time_step(run)}
        shared = {k: v for k, v in self.inputs.items() if k not in ("runs", "compare", "solid")}
        # Beams take their section from the solid's mesh, so its size matters to them as well.
        solid = study.solid.resolved()
        shared["solid"] = solid if study.runs[run].needs_solid else solid["mesh_size"]
        shared["packages"] = versions()
        return store.digest([run, table, shared, dict(self.files), store.code_digest()])

    def key(self) -> str:
        """Hash of everything that goes into the results, drawing and printing included."""
        texts = [self.study.name, self.study.title, self.study.description]
        own = [texts, self.inputs, dict(self.files), versions(), store.code_digest(True)]
        return store.digest([own, [companion.key() for companion in self.companions]])


def plan_study(study: Study, out_dir: Path) -> Plan:
    """Read a study's inputs and its companions'.

    Raises
    ------
    InputError
        When an input file cannot be used, or a companion's study file.
    """
    from contactstudy.study.roughness import describe

    companions = [plan_study(c, out_dir / c.name) for c in load_companions(study)]
    described = describe(study)
    inputs = study.config()
    for key in ("file", "measured_overlay"):
        if inputs["irregularity"].get(key):  # the content counts, and paths are the machine's
            inputs["irregularity"][key] = Path(inputs["irregularity"][key]).name
    return Plan(
        study=study,
        out_dir=out_dir,
        irregularity=described.info,
        inputs=inputs,
        files=described.files,
        warnings=described.warnings,
        companions=tuple(companions),
    )


def run_study(
    study: Study, out_dir: Path, jobs: int = 2, reporter: Reporter | None = None
) -> StudyResults:
    """Run a study and write results, figures and report into `out_dir`.

    Runs that are finished there already are taken as they are; when everything is, so are the
    figures and the report.

    Parameters
    ----------
    study : Study
    out_dir : Path
    jobs : int
        Runs at once, each in a process of its own.
    reporter : Reporter, optional

    Raises
    ------
    InputError
        For input files that cannot be used or a folder that cannot be written; before any run.
    NumericalError
        When a run broke down; the others are finished and kept.
    """
    reporter = reporter or Quiet()
    ensure_writable(out_dir)
    with reporter.stage("reading the study"):
        plan = plan_study(study, out_dir)
    for warning in dict.fromkeys(w for p in plan.all for w in p.warnings):
        reporter.note(warning)
    if (done := finished_results(plan)) is not None:
        reporter.note(f"{out_dir}: all results are there and up to date")
        return done
    compute(plan, jobs, reporter)
    with reporter.stage("comparing the runs"):
        results = collect(plan)
        write_results(results, out_dir)
        for companion in results.companions:
            write_results(companion, out_dir / companion.name)
    render(results, out_dir, reporter)
    _mark_finished(plan)
    return results


def compute(plan: Plan, jobs: int, reporter: Reporter) -> None:
    """Compute the runs that are not finished yet, of a plan and its companions.

    Raises
    ------
    NumericalError or InputError
        Listing the runs that failed, when the others are finished.
    """
    from contactstudy.study.execution import condense_body, is_condensed

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
    from contactstudy.study.execution import execute_run, peak_memory_mb

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


def collect(plan: Plan) -> StudyResults:
    """Finished runs, their comparison and everything else that the report needs."""
    from contactstudy.study.build import recipe
    from contactstudy.study.metrics import study_metrics

    study = plan.study
    found = {name: _finished_run(plan, name) for name in study.runs}
    runs = {name: run.data for name, run in found.items()}
    compare_from = study.journey.start + study.journey.fade_in
    seed = plan.inputs["irregularity"].get("seed")
    mesh = asdict(recipe(study)) if study.runs and study.track.rail != "given" else None
    return StudyResults(
        name=study.name,
        title=study.title,
        description=study.description,
        config=plan.inputs,
        units=study.units(),
        runs=runs,
        reference=study.reference,
        metrics=study_metrics(
            runs, {name: run.cost for name, run in found.items()}, study.reference, compare_from
        ),
        irregularity=plan.irregularity,
        provenance=provenance(seed, plan.key(), mesh, dict(plan.files)),
        companions=tuple(collect(companion) for companion in plan.companions),
    )


def _finished_run(plan: Plan, name: str) -> store.StoredRun:
    run, damage = store.load_run(store.run_path(plan.out_dir, name, plan.run_key(name)))
    if run is None:
        raise ContactStudyError(damage or f"run {name}: was computed but is not in the store")
    return run


def render(results: StudyResults, out_dir: Path, reporter: Reporter) -> None:
    """Draw the figures and typeset the report."""
    from contactstudy.figures import write_figures
    from contactstudy.report import write_report

    with reporter.stage("drawing the figures"):
        write_figures(results, out_dir)
    with reporter.stage("typesetting the report"):
        write_report(results, out_dir)


def _outputs(plan: Plan) -> dict[str, str]:
    """Output file -> SHA-256 of its content."""
    out = plan.out_dir
    files = [out / "report.pdf"]
    for one in plan.all:
        files += [one.out_dir / RESULT_FILE, one.out_dir / METRICS_FILE]
        files += sorted((one.out_dir / "figures").glob("*"))
    return {path.relative_to(out).as_posix(): store.file_digest(path) for path in files}


def _mark_finished(plan: Plan) -> None:
    content = {"key": plan.key(), "files": _outputs(plan)}
    with writing(plan.out_dir / store.STORE / FINISHED) as path:
        path.write_text(json.dumps(content, indent=1) + "\n", "utf-8")


def finished_results(plan: Plan) -> StudyResults | None:
    """Results of a plan when all its output files are there, whole and up to date."""
    try:
        content = json.loads((plan.out_dir / store.STORE / FINISHED).read_text("utf-8"))
        if content["key"] != plan.key() or content["files"] != _outputs(plan):
            return None
        return read_results(plan.out_dir)
    except (OSError, ValueError, KeyError, TypeError, InputError):
        return None

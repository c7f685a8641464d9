"""A study of any kind from its inputs to its report: compute what is not finished, write all."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path

from contactstudy.cluster import Cluster
from contactstudy.exceptions import InputError, gathered
from contactstudy.executor import at_once, check_workers
from contactstudy.figures import write_figures
from contactstudy.files import alone, ensure_writable, file_digest, remove_unfinished
from contactstudy.plot.panels import Panels
from contactstudy.report import write_report
from contactstudy.reporter import Quiet, Reporter
from contactstudy.store import Store
from contactstudy.study.axes.collect import collect_swept
from contactstudy.study.axes.dataset import write_csv
from contactstudy.study.compute import Found, compute
from contactstudy.study.earlier import FINISHED, refuse_other, remove_stale
from contactstudy.study.kind import find_kind
from contactstudy.study.loading import load_companions
from contactstudy.study.plan import Plan, collect, plan_study
from contactstudy.study.results import (
    PAGE_FILE,
    REPORT_FILE,
    RUNS,
    StudyResults,
    read_results,
    write_results,
)
from contactstudy.study.status import write_plan
from contactstudy.study.study import Study
from contactstudy.workers import InThisProcess

_WAITING = "{}: {} is at work here; this one goes on when it has ended"


def run_study(
    study: Study,
    out_dir: str | Path,
    workers: int = 2,
    reporter: Reporter | None = None,
    quick: bool = False,
    scheduler: str = "",
    overwrite: bool = False,
) -> StudyResults:
    """Run a study and write results, figures and report into `out_dir`.

    What is finished there already is taken as it is; when everything is, so are the figures and
    the report.

    `workers` pieces of work are computed at once, each in another process, or as many as the
    Dask scheduler at the address `scheduler` has workers for. With `quick` companions have the
    values of their tables ``[quick]``. Results of another study, or of this one with other
    values, are replaced only with `overwrite`.

    Raises
    ------
    InputError
        For input files that cannot be used, and a folder that cannot be written or holds other
        results; before any run.
    NumericalError
        When a run broke down; the others are finished and kept.
    """
    reporter, out_dir = reporter or Quiet(), Path(out_dir)
    ensure_writable(out_dir)
    with (
        alone(out_dir / RUNS, lambda who: reporter.note(_WAITING.format(out_dir, who))),
        _executor(workers, scheduler, reporter) as executor,
    ):
        plan = _planned(study, out_dir, reporter, quick)
        refuse_other(plan, overwrite)
        if (done := _finished_results(plan)) is not None:
            reporter.note(f"{out_dir}: all results are there and up to date")
            return done
        write_plan(plan, at_once(workers, executor))
        results = _computed(plan, workers, reporter, executor)
        with reporter.stage("writing the results"):
            written = _write(results, out_dir)
        written += render(results, out_dir, reporter)
        for folder in {path.parent for path in written}:
            remove_unfinished(folder)
        sums = {p.relative_to(out_dir).as_posix(): file_digest(p) for p in written}
        remove_stale(plan, sums)
        if not results.failures:  # they are tried again the next time
            Store(out_dir / RUNS).save(FINISHED, plan.key(), sums)
        return results


def compute_study(
    study: Study,
    folder: Path,
    workers: int = 2,
    reporter: Reporter | None = None,
    quick: bool = False,
    scheduler: str = "",
    here: bool = False,
) -> StudyResults:
    """As `run_study`, but only the finished runs are kept, in ``folder/runs``.

    With `here` all is computed in this process, which small runs one after another take less time
    in than in new ones.
    """
    reporter = reporter or Quiet()
    with _executor(workers, scheduler, reporter) as executor:
        executor = InThisProcess(lambda message: None) if here else executor
        plan = _planned(study, folder, reporter, quick)
        return _computed(plan, workers, reporter, executor)


def render(results: StudyResults, out_dir: Path, reporter: Reporter) -> list[Path]:
    """Draw the figures of a study and its companions, and typeset the report."""
    shown: dict[Path, Panels] = {}
    with reporter.stage("drawing the figures"):
        written = write_figures(results, out_dir, shown)
    with reporter.stage("typesetting the report"):
        return [*written, *write_report(results, out_dir, shown=shown)]


@contextlib.contextmanager
def _executor(workers: int, scheduler: str, reporter: Reporter) -> Iterator[Executor | None]:
    """Where pieces of work are computed; None for processes here."""
    check_workers(workers)
    if not scheduler:
        yield None
        return
    with reporter.stage("connecting to the scheduler"):
        cluster = Cluster(scheduler)
    for remark in cluster.remarks:
        reporter.note(remark)
    with cluster:
        yield cluster


def _planned(study: Study, folder: Path, reporter: Reporter, quick: bool) -> Plan:
    ensure_writable(folder)
    with reporter.stage("reading the study"):
        plan = _plan(study, folder, quick)
    for warning in plan.warnings:
        reporter.note(warning)
    return plan


def _plan(study: Study, folder: Path, quick: bool, last: bool = False) -> Plan:
    """A study with its companions and theirs, each in a folder of its name."""
    problems, own, plan = list[str](), list[Plan](), None
    with gathered(problems):
        for companion in load_companions(study, quick, last):
            with gathered(problems):
                own.append(_plan(companion, folder / companion.name, quick, last=True))
    with gathered(problems):
        plan = plan_study(study, folder, tuple(own))
    if plan is None or problems:
        raise InputError(dict.fromkeys(problems))
    return plan


def _computed(
    plan: Plan, workers: int, reporter: Reporter, executor: Executor | None
) -> StudyResults:
    found = compute(plan, workers, reporter, executor)
    with reporter.stage("comparing the runs"):
        return _collected(plan, found)


def _collected(plan: Plan, found: Found) -> StudyResults:
    own = collect_swept(plan, found) if plan.swept else collect(plan, found.pieces)
    return replace(own, companions=tuple(_collected(c, found) for c in plan.companions))


def _write(results: StudyResults, out_dir: Path) -> list[Path]:
    """Write labelled results, and the kind's further files, of a study and its companions."""
    written = [*write_results(results, out_dir)]
    if results.swept:
        written += write_csv(results.designs, out_dir)
    else:
        written += find_kind(results.kind).write_files(results, out_dir)
    for companion in results.companions:
        written += _write(companion, out_dir / companion.name)
    return written


def _finished_results(plan: Plan) -> StudyResults | None:
    """Results of a plan when all its output files are there, whole and up to date."""
    sums = Store(plan.out_dir / RUNS).load(FINISHED, plan.key()).value
    try:
        # an older program wrote no page
        whole = sums and (PAGE_FILE in sums or REPORT_FILE not in sums)
        if whole and all(file_digest(plan.out_dir / name) == sums[name] for name in sums):
            return read_results(plan.out_dir)
    except (OSError, InputError):  # a file is missing or damaged
        pass
    return None

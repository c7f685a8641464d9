"""Studies to results: compute what is not finished, compare, write everything."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.files import ensure_writable, file_digest
from contactstudy.provenance import provenance
from contactstudy.reporter import Quiet, Reporter
from contactstudy.store import Kept, Store
from contactstudy.study.compute import compute
from contactstudy.study.kinds.passage.build import recipe
from contactstudy.study.kinds.passage.fields import FIELDS, write_fields
from contactstudy.study.kinds.passage.metrics import study_metrics
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.plan import RUNS, Plan, plan_study
from contactstudy.study.results import (
    METRICS_FILE,
    RESULT_FILE,
    StudyResults,
    read_results,
    write_results,
)

FINISHED = "finished"


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
        write_fields(results, out_dir)
    render(results, out_dir, reporter)
    _mark_finished(plan)
    return results


def collect(plan: Plan) -> StudyResults:
    """Finished runs, their comparison and everything else that the report needs."""
    study = plan.study
    found = {name: _finished_run(plan, name) for name in study.runs}
    runs = {name: run.value for name, run in found.items()}
    compare_from = study.journey.start + study.journey.fade_in
    seed = plan.inputs["irregularity"].get("seed")
    mesh = (
        asdict(recipe(study)) if study.runs and study.track.rail.profile_name is not None else None
    )
    return StudyResults(
        name=study.name,
        title=study.title,
        description=study.description,
        config=plan.inputs,
        units=study.units(),
        runs=runs,
        reference=study.reference,
        metrics=study_metrics(
            runs, {name: run.about for name, run in found.items()}, study.reference, compare_from
        ),
        irregularity=plan.irregularity,
        provenance=provenance(seed, plan.key(), mesh, dict(plan.files)),
        companions=tuple(collect(companion) for companion in plan.companions),
    )


def _finished_run(plan: Plan, name: str) -> Kept:
    run = plan.runs.load(name, plan.run_key(name))
    if run.value is None:
        raise ContactStudyError(run.damage or f"run {name}: was computed but is not in the store")
    return run


def render(results: StudyResults, out_dir: Path, reporter: Reporter) -> None:
    """Draw the figures and typeset the report."""
    from contactstudy.figures import write_figures
    from contactstudy.figures.animation import write_animations
    from contactstudy.report import write_report

    with reporter.stage("drawing the figures"):
        write_figures(results, out_dir)
        write_animations(results, out_dir)
    with reporter.stage("typesetting the report"):
        write_report(results, out_dir)


def _outputs(plan: Plan) -> dict[str, str]:
    """Output file -> SHA-256 of its content."""
    out = plan.out_dir
    files = [out / "report.pdf"]
    for one in plan.all:
        files += [one.out_dir / RESULT_FILE, one.out_dir / METRICS_FILE]
        for folder in ("figures", FIELDS):
            files += sorted((one.out_dir / folder).glob("*"))
    return {path.relative_to(out).as_posix(): file_digest(path) for path in files}


def _mark_finished(plan: Plan) -> None:
    Store(plan.out_dir / RUNS).save(FINISHED, plan.key(), _outputs(plan))


def finished_results(plan: Plan) -> StudyResults | None:
    """Results of a plan when all its output files are there, whole and up to date."""
    marked = Store(plan.out_dir / RUNS).load(FINISHED, plan.key())
    try:
        return read_results(plan.out_dir) if marked.value == _outputs(plan) else None
    except (OSError, InputError):  # a file is missing or damaged
        return None

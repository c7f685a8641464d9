"""Run the named cases one after the other and keep each as it ends."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from contactstudy.code import code_digest
from contactstudy.exceptions import ContactStudyError
from contactstudy.executor import Outcome, Progress, Task, run_tasks
from contactstudy.files import ensure_writable
from contactstudy.provenance import versions
from contactstudy.reporter import Quiet, Reporter
from contactstudy.store import Store, store_key
from contactstudy.verification.case import Case
from contactstudy.verification.outcome import CaseOutcome, from_data, judged, to_data

KEPT = "cases"
"""Folder of the output in which finished cases are kept."""
_OPTIONAL = ("tamaas",)


def run_cases(
    cases: Sequence[Case],
    out_dir: Path,
    quick: bool = False,
    reporter: Reporter | None = None,
    workers: int = 1,
) -> list[CaseOutcome]:
    """Run cases; those that are kept in `out_dir` from the same program are taken from there.

    A case that breaks down does not keep the others from running.

    Parameters
    ----------
    quick : bool
        Slow cases are not run.
    workers : int
        Cases at once, each in a process of its own; with 1 all run in this process.

    Raises
    ------
    InputError
        If the folder cannot be written.
    """
    reporter = reporter or Quiet()
    ensure_writable(out_dir)
    outcomes: dict[str, CaseOutcome] = {}
    todo = []
    for case in cases:
        found = _skipped(case, quick) or _kept(case, out_dir)
        if found is None:
            todo.append(case)
        else:
            outcomes[case.name] = found
            reporter.note(outcome_line(found))

    def finished(name: str, ended: Outcome) -> None:
        outcomes[name] = outcome = _of_task(name, ended)
        reporter.end(name, outcome.good)
        reporter.note(outcome_line(outcome))

    tasks = [Task(case.name, _run, (case, out_dir), here=workers == 1) for case in todo]
    run_tasks(tasks, workers, reporter, finished)
    return [outcomes[case.name] for case in cases]


def _of_task(name: str, ended: Outcome) -> CaseOutcome:
    if isinstance(ended.value, CaseOutcome):
        return ended.value
    return CaseOutcome(name, "broke down", str(ended.error))


def about() -> dict[str, Any]:
    """Versions of everything that computes, and the hash of the program's code."""
    return {"versions": {**versions(), **_optional_versions()}, "code": code_digest()[:16]}


def _optional_versions() -> dict[str, str]:
    found = {}
    for package in _OPTIONAL:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found


def complaints(outcomes: Sequence[CaseOutcome]) -> list[str]:
    """One line for each check that leaves its band and for each case that broke down."""
    lines = []
    for outcome in outcomes:
        if outcome.status == "broke down":
            lines.append(f"{outcome.name}: broke down: {outcome.reason}")
        for check in outcome.result.failed if outcome.result else ():
            lines.append(
                f"{outcome.name}: {check.quantity}: {check.computed:.6g} {check.unit} against "
                f"{check.reference:.6g} ({check.source}), {100 * check.error:+.3g} %; band "
                f"{100 * (check.band or 0.0):g} %"
            )
    return lines


def outcome_line(outcome: CaseOutcome) -> str:
    """One line on what became of a case."""
    if outcome.result is None:
        return f"{outcome.name}: {outcome.status}: {outcome.reason}"
    with_band = [c for c in outcome.result.checks if c.passed is not None]
    kept = len(with_band) - len(outcome.result.failed)
    rest = len(outcome.result.checks) - len(with_band)
    reported = f", {rest} reported without a band" if rest else ""
    return f"{outcome.name}: {kept} of {len(with_band)} checks within their bands{reported}"


def _skipped(case: Case, quick: bool) -> CaseOutcome | None:
    missing = case.missing()
    if missing:
        return CaseOutcome(
            case.name, "not run", f"needs {' and '.join(missing)}, not installed here"
        )
    if quick and case.slow:
        return CaseOutcome(case.name, "not run", "takes long and was left out by --quick")
    return None


def _key(case: Case) -> str:
    return store_key([case.name, _optional_versions()], case.function.partition(":")[0])


def _kept(case: Case, out_dir: Path) -> CaseOutcome | None:
    """The case as it was kept; None when there is none, or when the file is damaged."""
    data = Store(out_dir / KEPT).load(case.name, _key(case)).value
    return None if data is None else judged(from_data(data))


def _run(case: Case, out_dir: Path, progress: Progress) -> CaseOutcome:
    progress(0, 1)
    try:
        result = case.load()()
        if result.name != case.name:
            raise ContactStudyError(f"calls itself {result.name!r}")
    except Exception as error:  # the others shall run all the same; the command then ends with 1
        return CaseOutcome(case.name, "broke down", f"{type(error).__name__}: {error}")
    data = to_data(result)
    Store(out_dir / KEPT).save(case.name, _key(case), data)
    # as it is read again, so that a resumed command writes the same bytes
    return judged(from_data(json.loads(json.dumps(data))))

"""Studies from Python: load, check and run them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.console import Console

from contactstudy.driver import compute_study, run_study
from contactstudy.exceptions import InputError
from contactstudy.reporter import Quiet
from contactstudy.solids.cache import cache_directory
from contactstudy.study.kind import Study
from contactstudy.study.loading import load_study
from contactstudy.study.results import StudyResults
from contactstudy.study.terminal import TerminalReporter, print_check


def load(study: str | Path, values: Mapping[str, Any] | None = None) -> Any:
    """Read a study file of any kind and check it; the study is frozen.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    values : mapping, optional
        Dotted key -> value in place of the file's, as in a study file:
        ``{"irregularity.seed": 2, "journey.speed": "200 km/h"}``.

    Raises
    ------
    InputError
        Listing every problem.
    """
    return load_study(study, values or {})


def check(study: str | Path | Study, values: Mapping[str, Any] | None = None) -> None:
    """Print the resolved values of a study and what it will need; runs nothing.

    Parameters
    ----------
    study : str, Path or Study
    values : mapping, optional
        As in `load`; of a file only.

    Raises
    ------
    InputError
        Listing every problem.
    """
    print_check(_study(study, values), Console(), Quiet())


def run(
    study: str | Path | Study,
    values: Mapping[str, Any] | None = None,
    *,
    out: str | Path | None = None,
    jobs: int = 2,
) -> StudyResults:
    """Run a study.

    Runs that are finished are not computed again.

    Parameters
    ----------
    study : str, Path or Study
    values : mapping, optional
        As in `load`; of a file only.
    out : str or Path, optional
        Folder for results, figures and report. Nothing is written without it, but the finished
        runs are kept in the user's cache folder.
    jobs : int
        Runs at the same time, each in a process of its own.

    Returns
    -------
    StudyResults
        Its `runs` are labelled datasets; shown as one tree.

    Raises
    ------
    InputError
        For an impossible study, before anything runs.
    NumericalError
        When a run broke down; the others are finished and kept.
    """
    made = _study(study, values)
    with TerminalReporter(Console(stderr=True)) as reporter:
        if out is None:
            return compute_study(made, cache_directory(), jobs, reporter)
        return run_study(made, out, jobs, reporter)


def _study(study: str | Path | Study, values: Mapping[str, Any] | None) -> Study:
    if isinstance(study, str | Path):
        made: Study = load(study, values)
        return made
    if values:
        raise InputError("values go with a study file; use dataclasses.replace on a study")
    if not hasattr(study, "config"):
        raise InputError(
            f"study = {study!r}: must be a file, the name of a shipped study or a Study"
        )
    return study

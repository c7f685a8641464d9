"""Commands that run studies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from contactstudy.commands.options import (
    TALKING,
    Json,
    Out,
    Overrides,
    Overwrite,
    Quick,
    Scheduler,
    Sweep,
    Telling,
    Workers,
)
from contactstudy.exceptions import ContactStudyError, InputError

if TYPE_CHECKING:
    from contactstudy.study.study import Study


@Parameter(name="*")
@dataclass(frozen=True)
class Ways:
    """How a study is run, and what is said of it."""

    quick: Quick = False
    workers: Workers = 2
    scheduler: Scheduler = ""
    overwrite: Overwrite = False
    json: Json = False
    telling: Telling = TALKING


USUAL = Ways()


def run(
    study: Path,
    *,
    out: Out,
    overrides: Overrides = (),
    sweep: Sweep = (),
    ways: Ways = USUAL,
) -> None:
    """Run a study; write result.nc, metrics.json, figures/, report.pdf and report.html.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study.
    out
        Folder for the results; finished runs found there are not computed again.
    """
    from contactstudy.study.loading import load_study

    _run(load_study(study, overrides, sweep=sweep, quick=ways.quick), out, ways)


def reproduce(
    *names: str,
    every: Annotated[
        bool, Parameter(name="--all", negative="", help="The whole error study, in one report.")
    ] = False,
    out: Out = Path("reports/out"),
    overrides: Overrides = (),
    ways: Ways = USUAL,
) -> None:
    """Run shipped studies, by default the main comparison, into one folder.

    Parameters
    ----------
    names
        Shipped studies; the main one goes to the folder itself, others to folders below it.
    out
        Folder for the results.
    """
    from contactstudy.study.loading import load_study

    main_study = "error_study" if every else "point_vs_surface"
    if every and names:
        raise InputError(f"--all: goes without names of studies (given: {', '.join(names)})")
    chosen = dict.fromkeys(names or (main_study,))
    loaded = [load_study(name, overrides, quick=ways.quick) for name in chosen]
    folders = [out if study.name == main_study else out / study.name for study in loaded]
    _each_its_own(loaded, folders)
    for study, folder in zip(loaded, folders, strict=True):
        _run(study, folder, ways)


def _run(study: Study, out: Path, ways: Ways) -> None:
    from contactstudy.driver import run_study
    from contactstudy.plot.text import counted
    from contactstudy.study.terminal import print_results, results_json

    with ways.telling.reporter() as reporter:
        results = run_study(
            study, out, ways.workers, reporter, ways.quick, ways.scheduler, ways.overwrite
        )
    if ways.json:
        print(results_json(results, out))
    else:
        print_results(results, out, ways.telling.console())
    if failures := results.failures:
        told = [f"{title}: {reason}" for title, reason in failures.items()]
        raise ContactStudyError("\n".join([f"{counted(len(told), 'variant')} failed", *told]))


def _each_its_own(studies: Sequence[Study], folders: Sequence[Path]) -> None:
    """Refuse studies whose results would overwrite each other's."""
    taken, problems = dict[Path, str](), []
    for study, folder in zip(studies, folders, strict=True):
        own = {folder: f"study {study.name}"}
        own |= {folder / Path(c).stem: f"companion of {study.name}" for c in study.companions}
        problems += [
            f"{name}: its results go to {path} like those of the {taken[path]}; "
            "run it on its own with --out"
            for path, name in own.items()
            if path in taken
        ]
        taken |= own
    if problems:
        raise InputError(problems)

"""Studies from Python: load, check and run them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from contactstudy.driver import compute_study, run_study
from contactstudy.exceptions import InputError
from contactstudy.reporter import Quiet
from contactstudy.solids.cache import cache_directory
from contactstudy.study.axes.swept import Swept
from contactstudy.study.loading import load_study
from contactstudy.study.results import StudyResults
from contactstudy.study.results import open_results as open
from contactstudy.study.study import Study
from contactstudy.study.terminal import TerminalReporter, check_study, console

__all__ = ["check", "load", "open", "run", "sweep"]

if TYPE_CHECKING:
    import xarray as xr


def load(study: str | Path, values: Mapping[str, Any] | None = None, *, quick: bool = False) -> Any:
    """Read a study file of any kind and check it; the study is frozen.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    values : mapping, optional
        Dotted key -> value in place of the file's, as in a study file:
        ``{"irregularity.seed": 2, "journey.speed": "200 km/h"}``.
    quick : bool
        With the values of the file's table ``[quick]``.

    Raises
    ------
    InputError
        Listing every problem.
    """
    return load_study(study, _mapping("values", values), quick=quick)


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
    check_study(_study(study, values), Quiet()).print(console())


def run(
    study: str | Path | Study,
    values: Mapping[str, Any] | None = None,
    *,
    out: str | Path | None = None,
    workers: int = 2,
    scheduler: str = "",
    quick: bool = False,
    overwrite: bool = False,
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
    workers : int
        Runs at the same time, each in a process of its own.
    scheduler : str, optional
        Address of a Dask scheduler, ``"tcp://host:8786"``, whose workers run them instead.
    quick : bool
        With the values of the table ``[quick]``, of a file and of companions.
    overwrite : bool
        Results of another study in `out`, or of this one with other values, are replaced.

    Returns
    -------
    StudyResults
        Its `runs` are labelled datasets, of a study with axes its `designs`; shown as one tree.

    Raises
    ------
    InputError
        For an impossible study, before anything runs.
    NumericalError
        When a run broke down; the others are finished and kept.
    """
    return _run(_study(study, values, quick), out, workers, scheduler, quick, overwrite)


def sweep(
    study: str | Path,
    series: Mapping[str, Any],
    values: Mapping[str, Any] | None = None,
    *,
    out: str | Path | None = None,
    workers: int = 2,
    scheduler: str = "",
    overwrite: bool = False,
) -> xr.Dataset:
    """Vary keys of a study.

    Parameters
    ----------
    study : str or Path
    series : mapping
        Dotted key -> its values, as in the table ``[sweep]``:
        ``{"irregularity.seed": "1 to 50", "journey.speed": ["200 km/h", "300 km/h"]}``; also
        ``combine``, ``samples``, ``seed`` and ``keep``. They replace those of the file.
    values, out, workers, scheduler, overwrite
        As of `run`.

    Returns
    -------
    xarray.Dataset
        What was measured, labelled with the varied keys; nan and ``failure`` where a variant
        failed. A notebook shows tables of it above.

    Raises
    ------
    InputError
        Listing every impossible variant, before anything runs.
    """
    made = load_study(study, _mapping("values", values), sweep=_mapping("series", series))
    if not isinstance(made, Swept):
        raise InputError(f"series = {series!r}: must name at least one key that is varied")
    from contactstudy.study.tree import KIND, Measured

    results = _run(made, out, workers, scheduler, False, overwrite)
    data = next(iter(results.designs.values()))
    return Measured(data.data_vars, data.coords, data.attrs | {KIND: results.kind})


def _mapping(name: str, given: Mapping[str, Any] | None) -> Mapping[str, Any]:
    if given is not None and not isinstance(given, Mapping):
        form = "{'journey.speed': '250 km/h'}"
        raise InputError(f"{name} = {given!r}: must be a mapping from dotted keys, e.g. {form}")
    return given or {}


def _run(
    study: Study,
    out: str | Path | None,
    workers: int,
    scheduler: str,
    quick: bool,
    overwrite: bool,
) -> StudyResults:
    if not isinstance(out, str | Path | None):
        raise InputError(f"out = {out!r}: must be a folder")
    with TerminalReporter(console(stderr=True)) as reporter:
        if out is None:
            return compute_study(study, cache_directory(), workers, reporter, quick, scheduler)
        return run_study(study, out, workers, reporter, quick, scheduler, overwrite)


def _study(
    study: str | Path | Study, values: Mapping[str, Any] | None, quick: bool = False
) -> Study:
    if isinstance(study, str | Path):
        made: Study = load(study, values, quick=quick)
        return made
    if values:
        raise InputError("values go with a study file; use dataclasses.replace on a study")
    if not hasattr(study, "config"):
        raise InputError(
            f"study = {study!r}: must be a file, the name of a shipped study or a Study"
        )
    return study

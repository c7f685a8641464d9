"""Commands: run, check, reproduce, status, verify, export, studies, keys, cache.

Exit status 0, 1 (broke down, or a check fails), 2 (input), 130 (interrupted).
"""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import cyclopts
from cyclopts import App, Parameter
from rich.console import Console

from contactstudy.exceptions import ContactStudyError, InputError
from contactstudy.process import ONE_THREAD

if TYPE_CHECKING:
    from contactstudy.study.study import Study

app = App(
    name="contactstudy",
    help="How wrong the simple wheel-rail contact model is: point against surface contact.",
    version=lambda: _version(),  # looking it up takes time
    help_format="plaintext",  # Markdown takes as long to load as all the rest
)

Overrides = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        negative="",
        help="Override a key of the study, e.g. --set journey.speed='250 km/h'; repeatable.",
    ),
]
Sweep = Annotated[
    tuple[str, ...],
    Parameter(
        name="--sweep",
        negative="",
        help="Vary a key of the study, e.g. --sweep irregularity.seed='1 to 50'; repeatable.",
    ),
]
Quick = Annotated[
    bool, Parameter(name="--quick", negative="", help="With the values of the table [quick].")
]
Workers = Annotated[
    int, Parameter(name=["--workers", "-j"], help="Processes that compute at the same time.")
]
Scheduler = Annotated[
    str,
    Parameter(
        name="--scheduler",
        help="Address of a Dask scheduler whose workers compute instead, e.g. tcp://host:8786.",
    ),
]


@app.command
def run(
    study: str,
    *,
    out: Annotated[Path, Parameter(name=["--out", "-o"])],
    overrides: Overrides = (),
    sweep: Sweep = (),
    quick: Quick = False,
    workers: Workers = 2,
    scheduler: Scheduler = "",
) -> None:
    """Run a study; write result.nc, metrics.json, figures/ and report.pdf.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study.
    out
        Folder for the results; finished runs found there are not computed again.
    """
    from contactstudy.study.loading import load_study

    _run(load_study(study, overrides, sweep=sweep, quick=quick), out, workers, scheduler, quick)


@app.command
def check(
    study: str, *, overrides: Overrides = (), sweep: Sweep = (), quick: Quick = False
) -> None:
    """Validate a study; print resolved values, sizes and the expected time. Runs nothing.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study.
    """
    from contactstudy.study.loading import load_study
    from contactstudy.study.terminal import TerminalReporter, print_check

    loaded = load_study(study, overrides, sweep=sweep, quick=quick)
    with TerminalReporter(_errors()) as reporter:
        print_check(loaded, Console(), reporter, quick)


@app.command
def reproduce(
    *names: str,
    every: Annotated[
        bool, Parameter(name="--all", negative="", help="The whole error study, in one report.")
    ] = False,
    out: Annotated[Path, Parameter(name=["--out", "-o"])] = Path("reports/out"),
    overrides: Overrides = (),
    quick: Quick = False,
    workers: Workers = 2,
    scheduler: Scheduler = "",
) -> None:
    """Run the studies that make the paper's figures, by default the main comparison.

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
    loaded = [load_study(name, overrides, quick=quick) for name in chosen]
    folders = [out if study.name == main_study else out / study.name for study in loaded]
    _each_its_own(loaded, folders)
    for study, folder in zip(loaded, folders, strict=True):
        _run(study, folder, workers, scheduler, quick)


@app.command
def advise(
    study: str,
    *,
    out: Annotated[Path, Parameter(name=["--out", "-o"])] = Path("advice"),
    bound: Annotated[str, Parameter(help='Error that is borne, e.g. "5 %" or 0.05.')] = "5 %",
    measure: Annotated[str, Parameter(help="Of what: dynamic or total force.")] = "dynamic",
    overrides: Overrides = (),
    workers: Workers = 2,
) -> None:
    """Find the cheapest point scheme that keeps an error bound; shown on one sample.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study; its own runs are left out.
    out
        Folder in which finished runs are kept.
    """
    from contactstudy.advice.advise import advise as find
    from contactstudy.advice.advise import read_bound
    from contactstudy.advice.terminal import print_advice
    from contactstudy.study.loading import load_study
    from contactstudy.study.terminal import TerminalReporter

    loaded = load_study(study, overrides)
    with TerminalReporter(_errors()) as reporter:
        found = find(loaded, read_bound(bound), out, measure, workers, reporter)
    print_advice(found, Console())


@app.command
def verify(
    *names: str,
    out: Annotated[Path, Parameter(name=["--out", "-o"])] = Path("reports/verification"),
    quick: Annotated[bool, Parameter(negative="", help="Leave out what takes long.")] = False,
    workers: Annotated[
        int, Parameter(name=["--workers", "-j"], help="Cases at the same time.")
    ] = 2,
    listing: Annotated[bool, Parameter(name="--list", negative="")] = False,
) -> None:
    """Run the named verification cases; write verification.pdf and verification.json.

    Parameters
    ----------
    names
        Cases; all without names.
    out
        Folder for the results; finished cases found there are not computed again.
    listing
        List the cases and run nothing.
    """
    from contactstudy.verification.case import select
    from contactstudy.verification.cases import CASES

    cases = select(CASES, names)
    if listing:
        width = max(len(case.name) for case in cases)
        for case in cases:
            print(f"{case.name:<{width}}  {case.about}".rstrip())
        return
    from contactstudy.report.verification import write_verification
    from contactstudy.study.terminal import TerminalReporter
    from contactstudy.verification.outcome import write_json
    from contactstudy.verification.runner import about, complaints, run_cases

    with TerminalReporter(_errors()) as reporter:
        outcomes = run_cases(cases, out, quick, reporter, workers)
        with reporter.stage("typesetting"):
            write_json(outcomes, about(), out)
            pdf = write_verification(outcomes, about(), out)
    print(pdf)
    if problems := complaints(outcomes):
        raise ContactStudyError(
            "\n".join([f"verification: {len(problems)} of the checks fail", *problems])
        )


@app.command
def export(
    study: str,
    *,
    out: Annotated[Path, Parameter(name=["--out", "-o"])],
    run: str | None = None,
    load: str | None = None,
    rail_length: str | None = None,
    overrides: Overrides = (),
) -> None:
    """Write the static press of wheel on rail as an input file for CalculiX.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study.
    out
        File to write; solve it with ccx NAME, without the ending .inp.
    run
        Run of surface contact; the reference, or the first, when not given.
    load
        Wheel load, e.g. "80 kN"; the static load when not given.
    rail_length
        Length of the clamped rail, e.g. "0.6 m"; four rail cells when not given.
    """
    from contactstudy.study.kind import find_kind
    from contactstudy.study.loading import load_study

    loaded = load_study(study, overrides)
    options = {"run": run, "load": load, "rail_length": rail_length}
    print(find_kind(loaded.kind).export(loaded, out, **options))


@app.command
def status(folder: Path) -> None:
    """Say what of a study is done, failed and left, and how long that will take.

    Parameters
    ----------
    folder
        Where its results go, as given with --out.
    """
    from contactstudy.study.status import status as lines

    for line in lines(folder):
        print(line)


@app.command
def studies() -> None:
    """List the shipped studies."""
    import tomllib

    from contactstudy.study.loading import shipped_studies

    shipped = shipped_studies()
    width = max(map(len, shipped), default=0)
    for name, path in shipped.items():
        title = tomllib.loads(path.read_text("utf-8")).get("title", "")
        print(f"{name:<{width}}  {title}")


@app.command
def keys() -> None:
    """Print every key of study files with unit, default, limits and meaning, in Markdown."""
    from contactstudy.study.keys import AXES, key_reference
    from contactstudy.study.kind import KINDS, find_kind

    for name in KINDS:
        kind = find_kind(name)
        inner = {f"{group}.NAME": table for group, table in kind.inner_tables.items()}
        print(f"# {name.capitalize()}\n\n{kind.about}\n")
        print(key_reference({**kind.tables, **inner}, kind.study))
    print(AXES, end="")


@app.command
def cache(
    *, clear: Annotated[bool, Parameter(negative="", help="Remove all of them.")] = False
) -> None:
    """Say where condensed bodies, and runs from Python, are kept, how many, and how large."""
    from contactstudy.solids.cache import cache_directory, cache_store
    from contactstudy.store import Store
    from contactstudy.study.results import RUNS

    runs = Store(cache_directory() / RUNS)
    for store in (cache_store(), runs) if runs.folder.is_dir() else (cache_store(),):
        if clear:
            store.clear()
        print(store.summary())


def _run(study: Study, out: Path, workers: int, scheduler: str, quick: bool) -> None:
    from contactstudy.driver import run_study
    from contactstudy.plot.text import counted
    from contactstudy.study.terminal import TerminalReporter, print_results

    with TerminalReporter(_errors()) as reporter:
        results = run_study(study, out, workers, reporter, quick, scheduler)
    print_results(results, out, Console())
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


def _version() -> str:
    from contactstudy.version import __version__

    return __version__


def _errors() -> Console:
    return Console(stderr=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (of `arguments`, else ``sys.argv``); returns the exit status."""
    # before anything loads a BLAS: bytes, and small problems' speed, depend on its threads
    os.environ.update(ONE_THREAD)
    os.environ["MPLBACKEND"] = "agg"  # no notebook's, whatever the environment says
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a console without our characters shows "?"
            stream.reconfigure(errors="replace")
    tokens = list(sys.argv[1:] if arguments is None else arguments)
    if (
        signal.getsignal(signal.SIGINT) is signal.SIG_IGN
        and threading.current_thread() is threading.main_thread()
    ):
        # a shell starts background jobs of a script this way; an interrupt that is sent to a
        # long computation by name shall end it all the same
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        # Parsed and called apart, so that Ctrl-C in a command is ours to answer.
        command, bound, _ = app.parse_args(tokens, exit_on_error=False, print_error=False)
        command(*bound.args, **bound.kwargs)
    except cyclopts.CycloptsError as error:
        _complain(f"{error}\nTry 'contactstudy --help'.")
        return 2
    except ContactStudyError as error:
        _complain(str(error))
        return error.exit_status
    except KeyboardInterrupt:
        _complain("interrupted; finished runs are kept, the same command goes on from there")
        return 130
    except BrokenPipeError:  # output piped into a program that has stopped reading
        sys.stderr.close()
        return 141
    return 0


def _complain(text: str) -> None:
    lines = text.splitlines() or [""]
    print(
        f"contactstudy: {lines[0]}", *(f"  {line}" for line in lines[1:]), sep="\n", file=sys.stderr
    )


if __name__ == "__main__":
    sys.exit(main())

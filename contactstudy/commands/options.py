"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter, Token

from contactstudy.exceptions import InputError
from contactstudy.reporter import Quiet, Reporter

if TYPE_CHECKING:
    from rich.console import Console

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


def whole(kind: Any, tokens: Sequence[Token]) -> int:
    """A whole number; cyclopts takes 1.5 for 2."""
    text = tokens[0].value
    if not text.isascii() or not text.removeprefix("-").isdigit() or len(text) > 9:
        raise InputError(f'{tokens[0].keyword} "{text}": must be a whole number at least 1')
    return int(text)


Workers = Annotated[
    int,
    Parameter(
        name=["--workers", "-j"],
        converter=whole,
        help="Processes that compute at the same time.",
    ),
]

Scheduler = Annotated[
    str,
    Parameter(
        name="--scheduler",
        help="Address of a Dask scheduler whose workers compute instead, e.g. tcp://host:8786.",
    ),
]
Overwrite = Annotated[
    bool, Parameter(negative="", help="Replace the results of another study in the folder.")
]


def _path(kind: Any, tokens: Sequence[Token]) -> Path:
    if not tokens[0].value:  # an empty variable of a shell is not the folder at hand
        raise InputError("--out: is empty; give a name, or . for this folder")
    return Path(tokens[0].value)


Out = Annotated[Path, Parameter(name=["--out", "-o"], converter=_path)]


Json = Annotated[
    bool, Parameter(name="--json", negative="", help="Print JSON instead of text and tables.")
]


@Parameter(name="*")
@dataclass(frozen=True)
class Telling:
    """How much is said on the way; errors always are."""

    quiet: Annotated[bool, Parameter(name=["--quiet", "-q"], negative="")] = False
    "Print nothing but errors."
    verbose: Annotated[bool, Parameter(name=["--verbose", "-v"], negative="")] = False
    "Print a line, with its time, as each run and stage begins and ends; no progress bars."

    def reporter(self) -> AbstractContextManager[Reporter]:
        """Who says it, on the error stream."""
        from contactstudy.study.terminal import TerminalReporter, console

        if self.quiet and self.verbose:
            raise InputError("--quiet, --verbose: only one of them")
        if self.quiet:
            return nullcontext(Quiet())
        return TerminalReporter(console(stderr=True), self.verbose)

    def console(self) -> Console:
        """Where results are shown."""
        from contactstudy.study.terminal import console

        return console(quiet=self.quiet)


TALKING = Telling()

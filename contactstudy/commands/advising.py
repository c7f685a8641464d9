"""The command that finds a point scheme for an error bound."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from contactstudy.commands.options import TALKING, Out, Overrides, Telling, Workers
from contactstudy.exceptions import ContactStudyError, InputError


def advise(
    study: Path,
    *,
    out: Out = Path("advice"),
    bound: Annotated[str, Parameter(help='Error that is borne, e.g. "5 %" or 0.05.')] = "5 %",
    measure: Annotated[str, Parameter(help="Of what: dynamic or total force.")] = "dynamic",
    overrides: Overrides = (),
    workers: Workers = 2,
    telling: Telling = TALKING,
) -> None:
    """Find the cheapest point scheme that keeps an error bound; proven on another sample.

    Exit status 1 if no point scheme keeps it.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study; its own runs and axes are left out.
    out
        Folder in which finished runs are kept.
    """
    from contactstudy.advice.advise import advise as find
    from contactstudy.advice.advise import read_bound
    from contactstudy.advice.terminal import headline, print_advice
    from contactstudy.study.loading import load_study

    loaded = load_study(study, overrides)
    with telling.reporter() as reporter:
        found = find(loaded, read_bound(bound), out, measure, workers, reporter)
    print_advice(found, telling.console())
    if found.answer is None:
        raise ContactStudyError(headline(found))


def verify_advice(
    *,
    out: Out = Path("advice"),
    draws: Annotated[int, Parameter(help="How many studies are drawn.")] = 100,
    first: Annotated[int, Parameter(help="Number of the first; each decides its draw.")] = 1,
    workers: Workers = 1,
) -> None:
    """Ask for advice on random studies, and try each promise on one more sample.

    Prints what is drawn from, a line a study, and how many promises held. Exit status 1 if fewer
    than 95 % did.

    Parameters
    ----------
    out
        Folder in which finished runs are kept; the same command goes on from there.
    """
    from contactstudy.advice.draws import SHARE
    from contactstudy.advice.draws import draws as drawn
    from contactstudy.advice.terminal import ranges, told
    from contactstudy.reporter import Quiet

    if draws < 1 or first < 0:
        raise InputError("verify-advice: draws must be at least 1, and first at least 0")
    for line in ranges():
        print(line)
    promised = held = 0
    for draw in drawn(draws, first, out, workers, Quiet()):
        print(told(draw), flush=True)
        promised, held = promised + draw.promised, held + draw.held
    print(f"{held} of {promised} promises held; {draws - promised} studies without one")
    if held < SHARE * promised:
        raise ContactStudyError(f"advice: fewer than {100 * SHARE:g} % of the promises held")

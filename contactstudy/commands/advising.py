"""The command that finds a point scheme for an error bound."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from contactstudy.commands.options import TALKING, Out, Overrides, Telling, Workers


def advise(
    study: str,
    *,
    out: Out = Path("advice"),
    bound: Annotated[str, Parameter(help='Error that is borne, e.g. "5 %" or 0.05.')] = "5 %",
    measure: Annotated[str, Parameter(help="Of what: dynamic or total force.")] = "dynamic",
    overrides: Overrides = (),
    workers: Workers = 2,
    telling: Telling = TALKING,
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

    loaded = load_study(study, overrides)
    with telling.reporter() as reporter:
        found = find(loaded, read_bound(bound), out, measure, workers, reporter)
    print_advice(found, telling.console())

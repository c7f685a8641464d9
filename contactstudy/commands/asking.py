"""Commands that say something of a study and run nothing."""

from __future__ import annotations

from pathlib import Path

from contactstudy.commands.options import TALKING, Json, Overrides, Quick, Sweep, Telling


def check(
    study: Path,
    *,
    overrides: Overrides = (),
    sweep: Sweep = (),
    quick: Quick = False,
    json: Json = False,
    telling: Telling = TALKING,
) -> None:
    """Validate a study; print resolved values, sizes and the expected time. Runs nothing.

    Parameters
    ----------
    study
        A TOML file, or the name of a shipped study.
    """
    from contactstudy.study.loading import load_study
    from contactstudy.study.terminal import check_study

    loaded = load_study(study, overrides, sweep=sweep, quick=quick)
    with telling.reporter() as reporter:
        checked = check_study(loaded, reporter, quick)
    if json:
        print(checked.json)
    else:
        checked.print(telling.console())


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

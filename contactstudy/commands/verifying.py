"""The command that runs verification cases."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from contactstudy.commands.options import TALKING, Out, Telling, whole
from contactstudy.exceptions import ContactStudyError


def verify(
    *names: str,
    out: Out = Path("reports/verification"),
    quick: Annotated[bool, Parameter(negative="", help="Leave out what takes long.")] = False,
    workers: Annotated[
        int, Parameter(name=["--workers", "-j"], converter=whole, help="Cases at the same time.")
    ] = 2,
    listing: Annotated[bool, Parameter(name="--list", negative="")] = False,
    telling: Telling = TALKING,
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
    from contactstudy.verification.outcome import write_json
    from contactstudy.verification.runner import about, complaints, run_cases

    with telling.reporter() as reporter:
        outcomes = run_cases(cases, out, quick, reporter, workers)
        with reporter.stage("typesetting"):
            write_json(outcomes, about(), out)
            pdf = write_verification(outcomes, about(), out)
    if not telling.quiet:
        print(pdf)
    if problems := complaints(outcomes):
        raise ContactStudyError(
            "\n".join([f"verification: {len(problems)} of the checks fail", *problems])
        )

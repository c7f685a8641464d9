"""The command that writes a study file to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def new(
    file: Path,
    *,
    like: Annotated[Path, Parameter(help="Shipped study, or a file, that it starts from.")] = Path(
        "point_vs_surface"
    ),
) -> None:
    """Write a commented study file to start from.

    Parameters
    ----------
    file
        To write, e.g. mine.toml; it must not be there yet.
    """
    import shlex

    from contactstudy.study.new import write_new

    write_new(file, like)
    print(f"{file}: change it, then: contactstudy check {shlex.quote(str(file))}")

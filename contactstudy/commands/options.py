"""Options that several commands have."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

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
Overwrite = Annotated[
    bool, Parameter(negative="", help="Replace the results of another study in the folder.")
]
Out = Annotated[Path, Parameter(name=["--out", "-o"])]

"""What commands print of a study with axes."""

from __future__ import annotations

import tempfile
from pathlib import Path

from rich.table import Table

from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.swept import Swept
from contactstudy.study.plan import plan_study
from contactstudy.study.results import StudyResults

_ROWS = 24  # of a table of variants


def check_swept(study: Swept) -> list[str]:
    """Number of variants and of runs that are computed for them."""
    with tempfile.TemporaryDirectory() as folder:
        plan = plan_study(study, Path(folder))
    needed = sum(len(v.pieces) for v in plan.variants.values())
    found = [
        f"{design.name}: {' x '.join(map(str, design.sizes.values()))} variants "
        f"({', '.join(design.series)})"
        for design in study.designs
    ]
    runs = len(plan.pieces)
    seconds = sum(plan.kind.seconds(p.study, p.work.name) for p in plan.pieces)
    return [
        *found,
        f"{len(plan.variants)} variants with {needed} runs, of which {runs} differ; "
        f"about {duration(seconds / 2)} with two at a time",
    ]


def summary(results: StudyResults) -> list[Table | str]:
    """Of each design the first thing measured, for each run or what else it depends on."""
    made: list[Table | str] = []
    for name, data in results.designs.items():
        failed = int((data[FAILURE] != "").sum())
        good = data["variant"].size - failed
        made.append(f"{name}: {good} variants" + (f", {failed} failed" if failed else ""))
    return made


def duration(seconds: float) -> str:
    """Seconds as people say them."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"

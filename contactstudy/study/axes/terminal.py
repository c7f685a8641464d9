"""What commands print of a study with axes."""

from __future__ import annotations

from rich.box import SIMPLE
from rich.table import Table
from rich.text import Text

from contactstudy.plot.text import counted
from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.swept import Swept
from contactstudy.study.axes.tables import tables
from contactstudy.study.plan import Plan
from contactstudy.study.results import StudyResults


def check_swept(study: Swept, plan: Plan) -> list[str]:
    """Number of variants and of runs that are computed for them, and the expected time."""
    needed = sum(len(v.pieces) for v in plan.variants.values())
    found = [
        f"{design.name}: {' x '.join(map(str, design.sizes.values()))} variants "
        f"({', '.join(design.series)})"
        for design in study.designs
    ]
    seconds = expected_seconds(plan)
    told = f"; about {duration(seconds / 2)} with two at a time" if seconds else ""
    runs = f"{counted(needed, 'run')}, of which {len(plan.pieces)} differ"
    return ["with its axes:", *found, f"{counted(len(plan.variants), 'variant')} with {runs}{told}"]


def expected_seconds(plan: Plan) -> float:
    """Seconds that all pieces of a plan take together, about."""
    return sum(plan.kind.seconds(p.study, p.work.name) for p in plan.pieces)


def summary(results: StudyResults) -> list[Table | str]:
    """Numbers of variants, and the tables of each design."""
    made: list[Table | str] = []
    for name, data in results.designs.items():
        failed = int((data[FAILURE] != "").sum())
        good = data["variant"].size - failed
        made.append(
            f"{name}: {counted(good, 'variant')}" + (f", {failed} failed" if failed else "")
        )
    for found in tables(results):
        table = Table(title=Text(found.title), box=SIMPLE, collapse_padding=True)
        for k, heading in enumerate(found.columns):
            table.add_column(Text(heading), justify="left" if k < found.left else "right")
        for row in found.rows:
            table.add_row(*(Text(cell) for cell in row))
        made.append(table)
    return made


def duration(seconds: float) -> str:
    """Seconds as people say them."""
    if seconds < 90:
        return f"{max(seconds, 1):.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"

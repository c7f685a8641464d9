"""What a study of positions prints."""

from __future__ import annotations

from rich.box import SIMPLE
from rich.table import Table
from rich.text import Text

from contactstudy.study.results import StudyResults

#: Variable -> heading, scale and decimals of what is shown.
COLUMNS = {
    "lateral": ("shift mm", 1e3, 2),
    "yaw": ("yaw mrad", 1e3, 2),
    "patch": ("patch", 1, 0),
    "y": ("y mm", 1e3, 3),
    "angle": ("angle mrad", 1e3, 2),
    "normal_force": ("N kN", 1e-3, 3),
    "approach": ("approach µm", 1e6, 2),
    "peak_pressure": ("peak MPa", 1e-6, 1),
    "area": ("area mm²", 1e6, 2),
}


def summary(results: StudyResults) -> list[Table]:
    """Contact position, approach, peak pressure and area of every patch, a table a wheel."""
    tables = []
    for side, run in results.runs.items():
        table = Table(
            title=Text(f"{results.title}: {side} wheel"),
            box=SIMPLE,
            collapse_padding=True,
            caption="y: contact position on the rail, to the field side",
        )
        for heading, _, _ in COLUMNS.values():
            table.add_column("\n".join(heading.rsplit(" ", 1)), justify="right", no_wrap=True)
        for k in range(run.sizes["row"]):
            table.add_row(
                *(
                    f"{scale * float(run[name].values[k]):.{decimals}f}"
                    for name, (_, scale, decimals) in COLUMNS.items()
                )
            )
        tables.append(table)
    return tables

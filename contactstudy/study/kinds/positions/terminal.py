"""What a study of positions prints."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from contactstudy.study.kinds.positions.table import PositionsStudy

if TYPE_CHECKING:
    import xarray as xr

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


def print_positions(data: xr.Dataset, out_dir: Path, console: Console) -> None:
    """Print contact position, approach, peak pressure and area of every patch."""
    for side in dict.fromkeys(data.wheel.values.tolist()):
        own = data.isel(row=data.wheel.values == side)
        table = Table(
            title=f"{data.attrs['title']}: {side} wheel",
            box=SIMPLE,
            collapse_padding=True,
            caption="y: contact position on the rail, to the field side",
        )
        for heading, _, _ in COLUMNS.values():
            table.add_column("\n".join(heading.rsplit(" ", 1)), justify="right", no_wrap=True)
        for k in range(own.sizes["row"]):
            table.add_row(
                *(
                    f"{scale * float(own[name].values[k]):.{decimals}f}"
                    for name, (_, scale, decimals) in COLUMNS.items()
                )
            )
        console.print(table)
    console.print(f"all numbers, figures and report: {out_dir}", markup=False, soft_wrap=True)


def print_positions_check(study: PositionsStudy, console: Console) -> None:
    """Print resolved values and the number of presses."""
    table = Table(title=study.title, box=SIMPLE, collapse_padding=True)
    for heading in ("key", "value", "unit"):
        table.add_column(heading)
    units = study.table.units()
    for key, value in study.config().items():
        shown = (
            value
            if isinstance(value, str)
            else f"{value:.10g}"
            if not isinstance(value, list)
            else ", ".join(v if isinstance(v, str) else f"{v:.6g}" for v in value)
        )
        table.add_row(f"positions.{key}", shown, units.get(key, ""))
    console.print(table)
    presses = len(study.positions) * len(study.table.wheels)
    # a roll at rest is searched for once for both wheels
    seconds = 0.5 * presses + (1.2 * len(study.positions) if study.table.roll == "rest" else 0.0)
    console.print(f"{presses} presses, expected time about {max(seconds, 1):.0f} s")

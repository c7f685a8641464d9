"""Positions: a wheelset pressed on its rails, both as half-spaces."""

from __future__ import annotations

from typing import ClassVar

from contactstudy.study.kind import Inputs, Kind, Quantity, later
from contactstudy.study.kinds.positions.table import Positions, PositionsStudy

_HERE = "contactstudy.study.kinds.positions"
CSV_FILE = "patches.csv"


class PositionsKind(Kind):
    """A wheelset pressed on its rails at given positions."""

    name = "positions"
    computing = f"{_HERE}.press:press_one"
    measuring = f"{_HERE}.results:measure"
    shown: ClassVar = (
        Quantity("peak_pressure_largest", "Highest peak pressure (MPa)", factor=1e-6),
        Quantity("approach_largest", "Largest approach (µm)", factor=1e6),
        Quantity("area_largest", "Largest contact area of a patch (mm²)", factor=1e6),
    )
    files = (CSV_FILE,)
    about = "A wheelset pressed on its rails at given positions, both as half-spaces."
    form = None
    study = PositionsStudy
    tables: ClassVar = {"positions": Positions}
    titles: ClassVar = {"positions": "Wheelset and positions"}

    load = later(f"{_HERE}.table:load_positions")
    check = later(f"{_HERE}.check:check")
    work = later(f"{_HERE}.press:work")
    admit = later(f"{_HERE}.check:admit")
    histories = later(f"{_HERE}.results:histories")
    collect = later(f"{_HERE}.results:collect")
    metrics = later(f"{_HERE}.results:metrics")
    drawings = later(f"{_HERE}.report:drawings")
    write_files = later(f"{_HERE}.results:write_csv")
    report = later(f"{_HERE}.report:report")
    summary = later(f"{_HERE}.terminal:summary")

    def read_inputs(self, study: PositionsStudy) -> Inputs:
        """The table, and what the files of its profiles hold."""
        wheelset = study.wheelset
        return Inputs(study.config(), study.files(), wheelset.rail.notes + wheelset.wheel.notes)


POSITIONS = PositionsKind()

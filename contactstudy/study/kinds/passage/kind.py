"""A passage: wheels run over a track, by several models that are compared."""

from __future__ import annotations

from typing import ClassVar

from contactstudy.study.kind import Kind, Quantity, later
from contactstudy.study.kinds.passage.runs import SOLVERS
from contactstudy.study.kinds.passage.schema import SECTIONS, Study
from contactstudy.vehicle import Car

_HERE = "contactstudy.study.kinds.passage"
_FORCE, _NAME = "contact_force", "contact force"
_PART = {"signal": (_FORCE,), "part": ("irregularity", "dynamic")}
_TOTAL = {"signal": (_FORCE,), "part": ("total",)}
_DECK = ({"signal": ("deck_displacement",)}, {"signal": ("deck_acceleration",)})
FIELDS = "fields"
"""Folder of the fields for ParaView."""


class PassageKind(Kind):
    """Wheels run over a track."""

    name = "passage"
    computing = f"{_HERE}.execution:execute_run"
    batching = f"{_HERE}.execution:execute_batch"
    measuring = f"{_HERE}.measures:measure"
    refining = f"{_HERE}.measures:against_finest"
    shown: ClassVar = (
        # of bridges first, for an abstract tells the first
        Quantity("amplification", "Dynamic factor of the deck"),
        Quantity("relative_l2", f"Error of the {_NAME}, {{part}} part (%)", _PART, 100.0),
        Quantity("relative_l2", f"Error of the {_NAME}, total (%)", _TOTAL, 100.0),
        Quantity("largest", f"Largest {_NAME} (kN)", {"signal": (_FORCE,)}, 1e-3),
        Quantity("largest_of_deck", "Largest displacement of the deck (mm)", _DECK[0], 1e3),
        Quantity("largest_of_deck", "Largest acceleration of the deck, EN 1990 (m/s²)", _DECK[1]),
        Quantity("lost_time", "Time without contact (ms)", {}, 1e3),
        Quantity("impulse", "Impulse beyond the static load (N s)"),
        Quantity("from_finest", f"Difference of the {_NAME} from the finest (%)", _PART, 100.0),
        Quantity(
            "from_finest",
            "Difference of the wheel displacement from the finest (%)",
            {"signal": ("wheel_displacement",), "part": _PART["part"]},
            100.0,
        ),
    )
    files = (FIELDS,)
    about = "Wheels run over a track, by several models that are compared."
    study = Study
    tables = SECTIONS
    inner_tables: ClassVar = {"runs": SOLVERS}
    file_tables: ClassVar = {"Vehicle files": {"car": Car}}
    telling = ("rail", "law", "k_r")
    titles: ClassVar = {
        "irregularity": "Irregularity",
        "track": "Track (per rail)",
        "vehicle": "Vehicle",
        "journey": "Journey",
        "solid": "Solid rail and wheel",
        "wheelset": "Wheelset",
        "scan": "Scanned surfaces",
        "measured": "Measured record",
        "roughness": "Measured roughness",
    }

    load = later(f"{_HERE}.reading:load_passage")
    read_inputs = later(f"{_HERE}.inputs:read_inputs")
    check = later(f"{_HERE}.forecast:needs")
    left_out = later(f"{_HERE}.roughness:too_sharp")
    work = later(f"{_HERE}.inputs:work")
    seconds = later(f"{_HERE}.forecast:seconds")
    admit = later(f"{_HERE}.forecast:admit")
    histories = later(f"{_HERE}.twins:histories")
    before = later(f"{_HERE}.execution:condensing")
    collect = later(f"{_HERE}.twins:collect")
    metrics = later(f"{_HERE}.metrics:metrics")
    drawings = later(f"{_HERE}.drawings:drawings")
    draws_grid = later(f"{_HERE}.drawings:draws_grid")
    marks = later(f"{_HERE}.bridge_speeds:marks")
    write_files = later(f"{_HERE}.fields:write_files")
    report = later(f"{_HERE}.report:report")
    summary = later(f"{_HERE}.terminal:summary")
    doubts = later(f"{_HERE}.doubts:doubts")
    export = later(f"{_HERE}.export:export_press")


PASSAGE = PassageKind()

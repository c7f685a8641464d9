"""What is wrong with the files that a passage names, all of them at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from contactstudy.exceptions import gathered
from contactstudy.irregularity import Irregularity
from contactstudy.study.kinds.passage.record import MeasuredRecord
from contactstudy.study.kinds.passage.roughness_table import RoughnessTable
from contactstudy.study.kinds.passage.run import Run
from contactstudy.study.kinds.passage.scan import ScanFiles
from contactstudy.validation import UnreadError, raise_if


def wrong_files(tables: Mapping[str, Any], runs: Mapping[str, Run]) -> list[str]:
    """Complaints about the files of tables, which may have been read in part, of a failed study.

    One that passes reads its files where it needs them, and stops at the first that is wrong.
    """
    readers: dict[str, Callable[[Any], Any]] = {
        "irregularity": _level,
        "roughness": RoughnessTable.levels,
    }
    readers |= {"scan": _scans, "measured": _record} if runs else {}
    found = list[str]()
    for name, read in readers.items():
        with suppress(UnreadError), gathered(found):
            if name in tables:
                read(tables[name])
    return found


def _level(table: Irregularity) -> None:
    if table.measured_file and table.level_column not in ("", table.x_column):
        low, high = table.wavelengths
        table.measured((low, high) if low < high else None)


def _scans(table: ScanFiles) -> None:
    if not table.broken(str):
        table.surfaces()


def _record(table: MeasuredRecord) -> None:
    if table.used and not table.broken(str):
        problems = list[str]()
        with gathered(problems, "measured.file: "):
            table.read()
        raise_if(problems)

"""Positions: a wheelset pressed on its rails, both as half-spaces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from contactstudy.reporter import Reporter
from contactstudy.study.kind import Cost, Inputs, Kind, Report, Work
from contactstudy.study.kinds.positions.table import (
    Positions,
    PositionsStudy,
    load_positions,
)
from contactstudy.study.overrides import Overrides
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import xarray as xr


class PositionsKind(Kind):
    """A wheelset pressed on its rails at given positions."""

    name = "positions"
    computing = "contactstudy.study.kinds.positions.press:press_one"
    about = "A wheelset pressed on its rails at given positions, both as half-spaces."
    form = None
    tables: ClassVar = {"positions": Positions}
    titles: ClassVar = {"positions": "Wheelset and positions"}

    def load(
        self, path: Path, data: dict[str, Any], overrides: Overrides, main: Any = None
    ) -> PositionsStudy:
        """Check the content of a study file."""
        return load_positions(path, data, overrides)

    def read_inputs(self, study: PositionsStudy) -> Inputs:
        """The table, and what the files of its profiles hold."""
        return Inputs(study.config(), study.files())

    def check(
        self, study: PositionsStudy, companions: Sequence[Any], reporter: Reporter
    ) -> Sequence[Any]:
        """Refuse impossible positions; the number of presses."""
        from contactstudy.study.kinds.positions.check import check_positions
        from contactstudy.study.kinds.positions.terminal import needs

        check_positions(study, reporter=reporter)
        return needs(study)

    def work(self, study: PositionsStudy, inputs: Inputs) -> Sequence[Work]:
        """A piece a press."""
        from contactstudy.study.kinds.positions.press import names, place

        table = inputs.config["positions"]
        shared = {k: v for k, v in table.items() if k not in ("wheels", "lateral", "yaw", "roll")}
        return [
            Work(name, [side, study.positions[k], shared], place(study, side, k), "positions")
            for name, (side, k) in names(study).items()
        ]

    def admit(self, study: PositionsStudy, names: Sequence[str], reporter: Reporter) -> None:
        """Find all impossible positions before any is pressed."""
        from contactstudy.study.kinds.positions import press
        from contactstudy.study.kinds.positions.check import check_positions

        at = press.names(study)
        check_positions(study, [at[name] for name in names], reporter)

    def collect(self, study: PositionsStudy, found: Mapping[str, Any]) -> Mapping[str, xr.Dataset]:
        """A run a wheel: the patches of all positions."""
        from contactstudy.study.kinds.positions.results import collect

        return collect(study, found)

    def metrics(
        self, study: PositionsStudy, runs: Mapping[str, xr.Dataset], costs: Mapping[str, Cost]
    ) -> dict[str, Any]:
        """Sizes, extremes and costs of each wheel."""
        from contactstudy.study.kinds.positions.results import metrics

        return metrics(runs, costs)

    def drawings(self, results: StudyResults) -> Sequence[Any]:
        """What the patches are over the lateral shift."""
        from contactstudy.study.kinds.positions.report import drawings

        return drawings(results)

    def write_files(self, results: StudyResults, out_dir: Path) -> Sequence[Path]:
        """All patches as CSV."""
        from contactstudy.study.kinds.positions.results import write_csv

        return [write_csv(results, out_dir)]

    def report(self, results: StudyResults, timings: bool = False) -> Report:
        """Every patch, and their course over the lateral shift."""
        from contactstudy.study.kinds.positions.report import report

        return report(results)

    def summary(self, results: StudyResults) -> Sequence[Any]:
        """Every patch."""
        from contactstudy.study.kinds.positions.terminal import summary

        return summary(results)


POSITIONS = PositionsKind()

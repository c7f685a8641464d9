"""A passage: wheels run over a track, by several models that are compared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from contactstudy.executor import Task
from contactstudy.reporter import Reporter
from contactstudy.study.kind import Cost, Inputs, Kind, Report, Work
from contactstudy.study.kinds.passage.runs import SOLVERS
from contactstudy.study.kinds.passage.schema import SECTIONS, Study
from contactstudy.study.overrides import Overrides
from contactstudy.study.results import StudyResults

if TYPE_CHECKING:
    import xarray as xr


#: Steps of a beam that take about as long as a process takes to start.
LIGHT = 20_000


class PassageKind(Kind):
    """Wheels run over a track."""

    name = "passage"
    computing = "contactstudy.study.kinds.passage.execution:execute_run"
    about = "Wheels run over a track, by several models that are compared."
    tables = SECTIONS
    inner_tables: ClassVar = {"runs": SOLVERS}
    titles: ClassVar = {
        "irregularity": "Irregularity",
        "track": "Track (per rail)",
        "vehicle": "Vehicle (per wheel)",
        "journey": "Journey",
        "solid": "Solid rail and wheel",
    }

    def load(
        self, path: Path, data: dict[str, Any], overrides: Overrides, main: Study | None = None
    ) -> Study:
        """Check the content of a study file."""
        from contactstudy.study.kinds.passage.reading import load_passage

        return load_passage(path, data, overrides, main)

    def read_inputs(self, study: Study) -> Inputs:
        """Read the irregularity, the section, the profiles and scans."""
        from contactstudy.study.kinds.passage.inputs import read_inputs

        return read_inputs(study)

    def check(self, study: Study, companions: Sequence[Any], reporter: Reporter) -> Sequence[Any]:
        """Static contact, sizes of the runs, and the expected time."""
        from contactstudy.study.kinds.passage.forecast import needs

        return needs([study, *(c for c in companions if isinstance(c, Study))])

    def work(self, study: Study, inputs: Inputs) -> Sequence[Work]:
        """A piece a run."""
        from contactstudy.study.kinds.passage.build import journey
        from contactstudy.study.kinds.passage.inputs import run_inputs

        def light(run: str) -> bool:
            return not study.meshes_rail(run) and journey(study, run).n_steps <= LIGHT

        return [
            Work(name, run_inputs(study, inputs, name), long=run.needs_solid, light=light(name))
            for name, run in study.runs.items()
        ]

    def before(self, study: Study, name: str) -> Sequence[Task]:
        """Condensing the bodies that the cache does not have."""
        from contactstudy.solids.cache import is_cached
        from contactstudy.study.kinds.passage.build import bodies
        from contactstudy.study.kinds.passage.execution import condense_body

        return [
            Task(f"condensing the {body.name}", condense_body, (body,))
            for body in bodies(study, name)
            if not is_cached(body)
        ]

    def metrics(
        self, study: Study, runs: Mapping[str, xr.Dataset], costs: Mapping[str, Cost]
    ) -> dict[str, Any]:
        """Norms against the reference, behind the fade-in."""
        from contactstudy.study.kinds.passage.metrics import study_metrics

        compare_from = study.journey.start + study.journey.fade_in
        return study_metrics(runs, costs, study.reference, compare_from)

    def drawings(self, results: StudyResults) -> Sequence[Any]:
        """All figures of the paper that these results can fill, and the contact patch."""
        from contactstudy.study.kinds.passage.drawings import drawings

        return drawings(results)

    def write_files(self, results: StudyResults, out_dir: Path) -> Sequence[Path]:
        """Fields for ParaView and the animation of the patch, where instants are kept."""
        from contactstudy.study.kinds.passage.files import write_files

        return write_files(results, out_dir)

    def report(self, results: StudyResults, timings: bool = False) -> Report:
        """The paper's comparison."""
        from contactstudy.study.kinds.passage.report import report

        return report(results, timings)

    def summary(self, results: StudyResults) -> Sequence[Any]:
        """What each run cost and how far it is from the reference."""
        from contactstudy.study.kinds.passage.terminal import summary

        return summary(results)

    def export(self, study: Study, out: Path, **options: str | None) -> str:
        """The static press of the wheel on the rail."""
        from contactstudy.study.kinds.passage.export import export_press

        made = export_press(study, out, **options)
        return (
            f"{out}: {len(made.mesh.nodes)} nodes, {len(made.mesh.elements)} elements, "
            f"{made.load:.6g} N on {made.length:g} m of rail"
        )


PASSAGE = PassageKind()

"""The report of a study as a PDF."""

from pathlib import Path

from contactstudy.figures import all_drawings, write_figures
from contactstudy.files import write_file
from contactstudy.report.content import content
from contactstudy.report.typesetting import typeset
from contactstudy.study.results import FIGURES, REPORT_FILE, StudyResults

__all__ = ["write_report"]


def write_report(results: StudyResults, out_dir: Path, timings: bool = False) -> Path:
    """Set the report of a study and of its companions.

    Figures are taken from out_dir/figures (of a companion from out_dir/<companion>/figures) and
    drawn where one is missing. With `timings` the run table shows seconds and memory, which depend
    on the machine; without them equal studies give equal bytes.
    """
    out_dir = Path(out_dir)
    target = out_dir / REPORT_FILE
    data = content(results, timings)
    chapters = [data[key] for key in ("model", "limits") if data[key]]
    _draw_missing(results, out_dir)
    write_file(target, typeset(("template.typ", *chapters, "references.yml"), data, out_dir))
    return target


def _draw_missing(results: StudyResults, out_dir: Path) -> None:
    """Draw the figures of a study and of its companions where one is missing."""
    names = [f"{made.name}.pdf" for made in all_drawings(results)]
    if not all((out_dir / FIGURES / name).is_file() for name in names):
        write_figures(results, out_dir)
    for companion in results.companions:
        _draw_missing(companion, out_dir / companion.name)

"""The report of a study as a PDF."""

import shutil
import tempfile
from pathlib import Path

from contactstudy.figures import all_drawings, write_figures
from contactstudy.files import writing
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
    with tempfile.TemporaryDirectory() as folder, writing(target) as path:
        root = Path(folder)
        _gather(results, out_dir, root / FIGURES)
        chapters = [data[key] for key in ("model", "limits") if data[key]]
        path.write_bytes(typeset(root, ("template.typ", *chapters, "references.yml"), data))
    return target


def _gather(results: StudyResults, out_dir: Path, folder: Path) -> None:
    """Copy the PDF figures of a study and its companions, having drawn them if one is missing."""
    names = [made.name for made in all_drawings(results)]
    if not all((out_dir / FIGURES / f"{name}.pdf").is_file() for name in names):
        write_figures(results, out_dir)
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        shutil.copyfile(out_dir / FIGURES / f"{name}.pdf", folder / f"{name}.pdf")
    for companion in results.companions:
        _gather(companion, out_dir / companion.name, folder / companion.name)

"""The report of a study as a PDF and as a page for the screen."""

from collections.abc import Mapping
from pathlib import Path

from contactstudy.figures import all_drawings, write_figures
from contactstudy.files import write_file
from contactstudy.plot.panels import Panels
from contactstudy.report.content import content
from contactstudy.report.screen import screen_page
from contactstudy.report.typesetting import typeset
from contactstudy.study.results import FIGURES, PAGE_FILE, REPORT_FILE, StudyResults

__all__ = ["write_report"]


def write_report(
    results: StudyResults,
    out_dir: Path,
    timings: bool = False,
    shown: Mapping[Path, Panels] | None = None,
) -> list[Path]:
    """Set the report of a study and of its companions, for paper and for the screen.

    Figures are taken from out_dir/figures (of a companion from out_dir/<companion>/figures) and
    drawn where one is missing; the page has them as `write_figures` showed them by their files, and
    as pictures where it did not. With `timings` the run table shows seconds and memory, which
    depend on the machine; without them equal studies give equal bytes.
    """
    out_dir = Path(out_dir)
    data = content(results, timings)
    chapters = [data[key] for key in ("model", "limits") if data[key]]
    template = ("template.typ", *chapters, "references.yml")
    _draw_missing(results, out_dir)
    pdf, page = out_dir / REPORT_FILE, out_dir / PAGE_FILE
    write_file(pdf, typeset(template, data, out_dir))
    text = typeset(template, data, out_dir, screen=True).decode()
    figures = {file.relative_to(out_dir).as_posix(): one for file, one in (shown or {}).items()}
    write_file(page, screen_page(text, figures, out_dir))
    return [pdf, page]


def _draw_missing(results: StudyResults, out_dir: Path) -> None:
    """Draw the figures of a study and of its companions where one is missing."""
    names = [f"{made.name}.{kind}" for made in all_drawings(results) for kind in ("pdf", "png")]
    if not all((out_dir / FIGURES / name).is_file() for name in names):
        write_figures(results, out_dir)
    for companion in results.companions:
        _draw_missing(companion, out_dir / companion.name)

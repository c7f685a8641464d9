"""Figures of a study: one module a family, one style."""

from pathlib import Path

from contactstudy.plot.style import figure_style, save
from contactstudy.study.kind import find_kind
from contactstudy.study.results import StudyResults


def write_figures(results: StudyResults, out_dir: Path) -> list[Path]:
    """Draw all figures into out_dir/figures, each as PDF and as PNG.

    What the study does not carry is left out. Figures of a companion study go into
    out_dir/<companion>/figures. Returned are the files written.
    """
    folder = Path(out_dir) / "figures"
    written: list[Path] = []
    with figure_style():
        for made in find_kind(results.kind).drawings(results):
            written += save(made.draw(), folder, made.name)
    for companion in results.companions:
        written += write_figures(companion, Path(out_dir) / companion.name)
    return written

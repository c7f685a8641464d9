"""Figures of a study: one module a family, one style."""

from pathlib import Path

from contactstudy.figures import axes
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import figure_style, save
from contactstudy.study.kind import find_kind
from contactstudy.study.results import FIGURES, StudyResults
from contactstudy.texts import json_text


def all_drawings(results: StudyResults) -> list[Drawing]:
    """Figures of a study's axes, then those of its kind."""
    return [*axes.drawings(results), *find_kind(results.kind).drawings(results)]


def write_figures(results: StudyResults, out_dir: Path) -> list[Path]:
    """Draw all figures into out_dir/figures, each as PDF and as PNG.

    What the study does not carry is left out. Figures of a companion study go into
    out_dir/<companion>/figures. Returned are the files written.
    """
    folder = Path(out_dir) / FIGURES
    written: list[Path] = []
    with figure_style(json_text(results.config)):
        for made in all_drawings(results):
            written += save(made.draw(), folder, made.name)
    for companion in results.companions:
        written += write_figures(companion, Path(out_dir) / companion.name)
    return written

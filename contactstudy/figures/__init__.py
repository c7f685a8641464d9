"""Figures of a study: one module a family, one style."""

from pathlib import Path

from contactstudy.figures import axes
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.panels import Panels, panels_of
from contactstudy.plot.style import figure_style, save
from contactstudy.study.kind import find_kind
from contactstudy.study.results import FIGURES, StudyResults
from contactstudy.texts import json_text


def all_drawings(results: StudyResults) -> list[Drawing]:
    """Figures of a study's axes, then those of its kind."""
    return [*axes.drawings(results), *find_kind(results.kind).drawings(results)]


def write_figures(
    results: StudyResults, out_dir: Path, shown: dict[Path, Panels] | None = None
) -> list[Path]:
    """Draw all figures into out_dir/figures, each as PDF and as PNG.

    What the study does not carry is left out. Figures of a companion study go into
    out_dir/<companion>/figures. Returned are the files written; `shown` gets what each PDF file
    shows as data, where that can be told.
    """
    folder = Path(out_dir) / FIGURES
    written: list[Path] = []
    with figure_style(json_text(results.config)):
        for made in all_drawings(results):
            figure = made.draw()
            written += save(figure, folder, made.name)
            if shown is not None and (panels := panels_of(figure)) is not None:
                shown[folder / f"{made.name}.pdf"] = panels
    for companion in results.companions:
        written += write_figures(companion, Path(out_dir) / companion.name, shown)
    return written

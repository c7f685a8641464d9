"""The one style of all figures: size, fonts, colours, line styles, and how a figure is saved."""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure

from contactstudy.files import writing
from contactstudy.plot.fonts import families
from contactstudy.plot.ticks import plain_powers, without_overlaps

# Width of the text block of the A4 report: figures are placed unscaled, so their fonts are
# the size given here.
TEXT_WIDTH = 6.3  # inch
PNG_DPI = 160

# Okabe and Ito's palette, told apart by the colour-blind (Okabe and Ito 2008, "Color universal
# design"); the yellow is left out because thin yellow lines vanish on paper.
BLACK = "#000000"
VERMILION = "#D55E00"
BLUE = "#0072B2"
GREEN = "#009E73"
PURPLE = "#CC79A7"
ORANGE = "#E69F00"
SKY = "#56B4E9"
GREY = "#7F7F7F"
SHADE = "#E6E6E6"

_LINES: tuple[tuple[str, Any], ...] = (
    (VERMILION, "-"),
    (BLUE, (0, (5, 1.5))),
    (GREEN, (0, (4, 1.5, 1, 1.5))),
    (PURPLE, (0, (1.2, 1.2))),
    (ORANGE, (0, (8, 2))),
    (SKY, (0, (5, 1.5, 1, 1.5, 1, 1.5))),
)
_MARKERS = ("s", "^", "D", "v", "P", "X")
_HATCHES = ("////", "\\\\\\\\", "....", "xxxx", "----", "++++")

_RC: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#D9D9D9",
    "grid.linewidth": 0.4,
    "lines.linewidth": 1.0,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.frameon": False,
    "legend.handlelength": 2.8,
    "figure.dpi": 100,
    "pdf.fonttype": 42,
    "svg.hashsalt": "contactstudy",  # equal figures give equal bytes
    "axes.unicode_minus": True,
    "text.parse_math": False,  # what users write is no markup; our own formulas ask for it
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
}


_RAISED = "DejaVu Serif"
"""Has the raised digits and minus that the other lacks."""


@dataclass(frozen=True)
class LineStyle:
    """How one run is drawn, the same in every figure: line, points and bars, width in points.

    Dash pattern, marker and hatch, as matplotlib takes them, tell runs apart without colour.
    """

    color: str
    linestyle: Any
    marker: str
    hatch: str
    width: float = 0.9

    @property
    def line(self) -> dict[str, Any]:
        """Keyword arguments for a line."""
        return {"color": self.color, "linestyle": self.linestyle, "linewidth": self.width}


REFERENCE_STYLE = LineStyle(BLACK, "-", "o", "", 1.4)


def run_styles(names: list[str], reference: str | None) -> dict[str, LineStyle]:
    """Line styles of the runs by name: the reference black and solid, the others in turn."""
    styles: dict[str, LineStyle] = {}
    others = 0
    for name in names:
        if name == reference:
            styles[name] = REFERENCE_STYLE
            continue
        color, dashes = _LINES[others % len(_LINES)]
        # Beyond six runs the colours come round again, with the dashes shifted by one.
        dashes = _LINES[(others + others // len(_LINES)) % len(_LINES)][1]
        k = others % len(_MARKERS)
        styles[name] = LineStyle(color, dashes, _MARKERS[k], _HATCHES[k])
        others += 1
    return styles


@contextmanager
def figure_style(text: str = "") -> Iterator[None]:
    """Context in which figures are made and saved: the style, and no user's matplotlibrc.

    `text` is all that figures may draw of what users wrote.
    """
    with matplotlib.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")  # `fonts.remark` has said so
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_RC)
        matplotlib.rcParams["font.family"] = [_RC["font.family"], _RAISED, *families(text)]
        yield


def new_figure(height: float, width: float = TEXT_WIDTH, equal_axes: bool = False) -> Figure:
    """Return an empty figure of `width` x `height` inches on the Agg canvas, without pyplot.

    With `equal_axes` the layout is one for axes whose scales are equal, which cannot fill it.
    """
    figure = Figure(figsize=(width, height), layout="compressed" if equal_axes else "constrained")
    FigureCanvasAgg(figure)
    return figure


def save(figure: Figure, folder: Path, name: str) -> list[Path]:
    """Write `figure` as folder/name.pdf and folder/name.png without dates, and return the paths.

    Equal figures give equal bytes: no creation date, no program version in the files.
    """
    plain_powers(figure)
    # The layout is found once, not again for each format; it does not depend on the format. The
    # canvases write the same bytes as `Figure.savefig`, which draws everything once more each time.
    layout = figure.get_layout_engine()
    if layout is not None:
        layout.execute(figure)
    without_overlaps(figure)
    figure.set_layout_engine("none")
    pdf, png = folder / f"{name}.pdf", folder / f"{name}.png"
    with writing(pdf) as stream:
        dates = {"CreationDate": None, "Creator": None, "Producer": None}
        FigureCanvasPdf(figure).print_pdf(stream, metadata=dates)
    with writing(png) as stream:
        figure.set_dpi(PNG_DPI)
        FigureCanvasAgg(figure).print_png(stream, metadata={"Software": None})
    return [pdf, png]


def map_axes(axes: Axes, x_label: str, y_label: str = "") -> None:
    """Axes of a map or section: equal scales, no grid."""
    axes.set(aspect="equal", xlabel=x_label, ylabel=y_label)
    axes.grid(False)


def figure_legend(figure: Figure, axes: Axes) -> None:
    """Put the legend of `axes` above all axes of the figure, where it hides no curve."""
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside upper center", ncols=legend_columns(labels))


def legend_columns(labels: Sequence[str]) -> int:
    """As many columns as the width holds at about 90 characters a line.

    Entries fill the columns one after another, and each column is as wide as its longest.
    """
    for columns in range(len(labels), 1, -1):
        rows, longer = divmod(len(labels), columns)
        sizes = [rows + (k < longer) for k in range(columns)]
        ends = [sum(sizes[: k + 1]) for k in range(columns)]
        own = [labels[end - size : end] for end, size in zip(ends, sizes, strict=True)]
        if sum(max(map(len, column)) + 9 for column in own) <= 90:
            return columns
    return 1

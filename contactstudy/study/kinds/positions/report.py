"""Figures and report of a study of positions: every patch, and its course over the shift."""

from functools import partial

from contactstudy.plot.curves import Curve, Plot, curve
from contactstudy.plot.draw import draw_pairs
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.text import between, number
from contactstudy.report.blocks import Block, figure, table, text
from contactstudy.report.quantity import fixed
from contactstudy.study.kind import Part, Report
from contactstudy.study.kinds.positions.terminal import COLUMNS
from contactstudy.study.results import StudyResults

_DRAWN = ("y", "approach", "peak_pressure", "area")
_LABELS = {
    "y": ("contact position", "Contact position on the rail (mm)"),
    "approach": ("approach", "Approach (µm)"),
    "peak_pressure": ("peak pressure", "Peak pressure (MPa)"),
    "area": ("contact area", "Contact area (mm²)"),
}
_METHOD = (
    "A rigid-body position of the wheelset places both wheels; each wheel is then pressed straight "
    "down on its rail until the vertical force is reached. Both bodies are elastic half-spaces, "
    "the gap is the signed distance of the smooth surfaces along the rail's normal, contact is "
    "frictionless, and every patch is found and solved by itself. The contact position is the "
    "centroid of the overlap of the undeformed bodies, weighted with the square of its depth; the "
    "approach is the largest overlap; the area counts the cells under pressure, so it moves in "
    "steps of a cell. Where tread, gauge corner or flange touch at once, a position has several "
    "patches, each with a row and its own approach; curves jump where the contact moves from one "
    "to another."
)


def drawings(results: StudyResults) -> list[Drawing]:
    """A panel a variable, with the curves of all wheels; none of a study with axes."""
    if not results.runs:
        return []
    plots = [_plot(results, name) for name in _DRAWN]
    told = ", ".join(plot.caption for plot in plots)
    caption = f"Over the lateral shift of the wheelset: {told}."
    return [Drawing("positions", caption, partial(draw_pairs, plots))]


def report(results: StudyResults, timings: bool = False) -> Report:
    """How positions are computed, the figure, and a table a wheel."""
    parts: list[Part] = [
        {"title": "Over the lateral shift", "blocks": [figure(made.name, made.caption)]}
        for made in drawings(results)
    ]
    for side in results.runs:
        parts.append({"title": f"{side.capitalize()} wheel", "blocks": [_patches(results, side)]})
    abstract = [_abstract(results)] if results.runs else []
    return Report(abstract, parts, subject=[text(_METHOD)])


def _abstract(results: StudyResults) -> str:
    sides = " and ".join(results.runs)
    count = len(results.config["positions"]["lateral"])
    load = number(1e-3 * results.config["positions"]["load"], 4)
    patches = sum(run.sizes["row"] for run in results.runs.values())
    return (
        f"A wheelset is pressed on its rails at {count} position{'s' if count > 1 else ''} of "
        f"lateral shift and yaw ({sides} wheel{'s' if len(results.runs) > 1 else ''}), with "
        f"{load} kN on each wheel. In the {patches} contact patches the approach "
        f"{between(*_range(results, 'approach', 1e6), 4)} µm, the peak pressure "
        f"{between(*_range(results, 'peak_pressure', 1e-6), 4)} MPa and the area "
        f"{between(*_range(results, 'area', 1e6), 4)} mm²."
    )


def _range(results: StudyResults, name: str, scale: float) -> tuple[float, float]:
    """Smallest and largest value among all patches."""
    low = min(float(run[name].min()) for run in results.runs.values())
    high = max(float(run[name].max()) for run in results.runs.values())
    return scale * low, scale * high


def _patches(results: StudyResults, side: str) -> Block:
    own = results.runs[side]
    headings = [h.rpartition(" ") for h, _, _ in COLUMNS.values()]
    columns = [f"{words} ({unit})" if words else unit for words, _, unit in headings]
    rows = [
        [fixed(scale * float(own[name].values[k]), decimals)
         for name, (_, scale, decimals) in COLUMNS.items()]
        for k in range(own.sizes["row"])
    ]  # fmt: skip
    caption = (
        f"Contact patches of the {side} wheel; y is the contact position on the rail, positive to "
        "the field side."
    )
    return table(columns, rows, caption, 0) | {"size": 8}


def _plot(results: StudyResults, name: str) -> Plot:
    words, axis = _LABELS[name]
    heading, scale, _ = COLUMNS[name]
    curves: list[Curve] = []
    for side, run in results.runs.items():
        x, y = 1e3 * run.lateral.values, scale * run[name].values
        first = run.patch.values == 1
        curves.append(curve(f"{side} wheel", x[first], y[first], "both"))
        if not first.all():
            curves.append(curve(f"{side} wheel, further patches", x[~first], y[~first], "points"))
    low, high = _range(results, name, scale)
    return Plot(
        f"{words} from {number(low, 4)} to {number(high, 4)} {heading.rpartition(' ')[2]}",
        "Lateral shift (mm)",
        axis,
        tuple(curves),
    )

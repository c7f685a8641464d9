"""Contact area and highest pressure over the run."""

from matplotlib.figure import Figure

from contactstudy.compare.signals import position, values
from contactstudy.figures.signals import fade_end, has_signal, styles
from contactstudy.plot.drawing import Drawing
from contactstudy.plot.style import SHADE, figure_legend, new_figure
from contactstudy.plot.text import label, number
from contactstudy.study.results import StudyResults


def drawings(results: StudyResults) -> list[Drawing]:
    """One figure with all runs that record their contact area, else none."""
    if any(has_signal(run, "contact_area") for run in results.runs.values()):
        return [Drawing("patch_history", _caption(results), lambda: _draw(results))]
    return []


def _draw(results: StudyResults) -> Figure:
    figure = new_figure(3.4)
    axes = figure.subplots(2, 1, sharex=True)
    rows = (
        ("contact_area", 1e6, "Contact area (mm²)"),
        ("peak_pressure", 1e-6, "Peak pressure (MPa)"),
    )
    start = fade_end(results)
    for ax, (name, scale, text) in zip(axes, rows, strict=True):
        for run_name, style in styles(results).items():
            run = results.runs[run_name]
            if has_signal(run, name):
                x, line = position(run), style.line | {"linewidth": 0.5}
                order = 3.0 if run_name == results.reference else 2.5
                y = values(run, name) * scale
                ax.plot(x, y, label=label(run_name), zorder=order, **line)
                if start > x[0]:
                    ax.axvspan(x[0], start, color=SHADE, lw=0, zorder=0)
        ax.set_ylabel(text)
        ax.margins(x=0)
    axes[1].set_xlabel("Position X of the wheel (m)")
    if len(axes[0].lines) > 1:
        figure_legend(figure, axes[0])
    figure.align_ylabels()
    return figure


def _caption(results: StudyResults) -> str:
    text = "Contact area and highest nodal pressure along the run."
    start, left = fade_end(results), 0.0
    for name, run in results.runs.items():
        if not (has_signal(run, "contact_area") and has_signal(run, "peak_pressure")):
            continue
        keep = position(run) >= start
        area = values(run, "contact_area")[keep] * 1e6
        peak = values(run, "peak_pressure")[keep] * 1e-6
        when = "The" if "After" in text else "After the fade-in the"  # once for all runs
        text += (
            f" {when} area of {label(name)} lies between {number(area.min())} and "
            f"{number(area.max())} mm² (mean {number(area.mean())} mm²) and its peak pressure "
            f"between {number(peak.min())} and {number(peak.max())} MPa."
        )
        if has_signal(run, "patch_count"):
            count = values(run, "patch_count")[keep]
            if count.max() > 1:
                text += (
                    f" Up to {int(count.max())} patches carry at once, several on "
                    f"{number(100 * float((count > 1).mean()), 2)} % of the way: the area is that "
                    "of all of them, the pressure that of the highest, and both jump where a patch "
                    "comes or goes."
                )
        if has_signal(run, "penetration"):
            left = max(left, float(values(run, "penetration")[keep].max()))
    return text + (f" The bodies overlap by at most {number(left * 1e9)} nm." if left else "")

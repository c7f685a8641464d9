"""Labels of ticks: none over another, however narrow the panels are."""

import pytest
from matplotlib.figure import Figure

from contactstudy.plot.style import figure_style, new_figure, save
from contactstudy.plot.ticks import without_overlaps


def labels(figure: Figure):
    """Boxes of the drawn labels of each axis, in the order of their places."""
    for axes in figure.axes:
        for axis, side in ((axes.xaxis, "x0"), (axes.yaxis, "y0")):
            low, high = sorted(axis.get_view_interval())
            texts = [*axis.get_majorticklabels(), *axis.get_minorticklabels()]
            at = 0 if side == "x0" else 1
            drawn = [
                t
                for t in texts
                if t.get_visible() and t.get_text() and low <= t.get_position()[at] <= high
            ]
            yield sorted((t.get_window_extent() for t in drawn), key=lambda box: getattr(box, side))


def overlapping(figure: Figure) -> int:
    return sum(
        a.overlaps(b) for row in labels(figure) for i, a in enumerate(row) for b in row[i + 1 :]
    )


def narrow(columns: int) -> Figure:
    """Panels over lengths with a named tick at each half decade, all on one scale."""
    figure = new_figure(2.0)
    for axes in figure.subplots(1, columns, sharex=True, sharey=True, squeeze=False).flat:
        axes.plot([0.02, 3.0], [2e-3, 2.2e-3])
        axes.set(xscale="log", yscale="log")
        axes.set_xticks([0.03, 0.1, 0.3, 1.0, 3.0], ["30 mm", "100 mm", "300 mm", "1 m", "3 m"])
    return figure


@pytest.mark.parametrize("columns", [1, 2, 4, 6])
def test_no_label_lies_over_another(tmp_path, columns):
    with figure_style():
        figure = narrow(columns)
        save(figure, tmp_path, "narrow")
        assert overlapping(figure) == 0
        shown = [t.get_text() for t in figure.axes[0].get_xticklabels() if t.get_text()]
    assert len(shown) >= (5 if columns == 1 else 2 if columns < 6 else 1)
    assert shown[0] == "30 mm"


def test_without_it_they_do():
    with figure_style():
        figure = narrow(4)
        figure.draw_without_rendering()
        assert overlapping(figure) > 0
        without_overlaps(figure)
        assert overlapping(figure) == 0

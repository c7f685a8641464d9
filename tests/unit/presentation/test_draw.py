"""Curves as data, drawn: what tells them apart, and where the ticks are."""

from contactstudy.plot.curves import Plot, curve
from contactstudy.plot.draw import draw
from contactstudy.plot.style import figure_style


def axes_of(*curves, scale="linear"):
    with figure_style():
        return draw(Plot("", "x (mm)", "y", curves, scale)).axes[0]


def test_several_references_are_black_and_dashed_differently():
    drawn = axes_of(
        curve("one", [1, 2], [1, 2], "reference"),
        curve("computed", [1, 2], [2, 3]),
        curve("two", [1, 2], [3, 4], "reference"),
    ).lines
    one, computed, two = drawn
    assert one.get_color() == two.get_color() == "#000000" != computed.get_color()
    assert one.get_linestyle() == "-" != two.get_linestyle()


def test_few_values_of_a_logarithmic_abscissa_are_its_ticks():
    axes = axes_of(curve("levels", [8, 10, 14, 18], [1, 2, 3, 4], "both"), scale="log")
    assert [text.get_text() for text in axes.get_xticklabels()] == ["8", "10", "14", "18"]
    axes = axes_of(curve("many", range(1, 40), range(1, 40)), scale="log")
    assert len(axes.get_xticks()) < 10

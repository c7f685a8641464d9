"""What lies on matplotlib's axes as data: nothing lost, nothing moved, and no larger than asked."""

import base64
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import BoundaryNorm, LogNorm

from contactstudy.plot.packed import packed, thin
from contactstudy.plot.panels import panels_of
from contactstudy.plot.style import figure_style, new_figure

X = np.linspace(0.0, 5.0, 101)


def shown(draw, rows=1, columns=1, **sharing):
    with figure_style():
        figure = new_figure(3.0)
        grid = figure.subplots(rows, columns, squeeze=False, **sharing)
        draw(figure, *grid.flat)
        figure.draw_without_rendering()
        return panels_of(figure)


def kinds(panel):
    return [shape["kind"] for shape in panel.shapes]


def test_lines_keep_their_values_looks_and_names():
    def draw(figure, axes):
        axes.plot(X, np.sin(X), color="#ff0000", ls="--", label="first")
        axes.plot(X, np.cos(X), "s", mfc="none", mec="#00ff00", label="second")
        axes.step([0, 1, 2], [3.0, 4.0, 5.0], where="post", color="#0000ff")
        axes.plot(X, X, color="#ff0000", ls="--", alpha=0.3)
        axes.axvline(2.0, color="#123456")
        axes.axvspan(1.0, 3.0, color="#eeeeee")
        axes.set(xlabel="Position $X_{rr}$", ylabel="Force\n(kN)", yscale="log", xlim=(0.5, 4.0))
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center")

    found = shown(draw)
    (panel,) = found.panels
    assert [entry["label"] for entry in found.legend] == ["first", "second"]
    stretch, line, points, steps, faint, across = panel.shapes
    assert (stretch["kind"], stretch["low"], stretch["high"]) == ("stretch", 1.0, 3.0)
    assert (across["kind"], across["along"], across["at"]) == ("across", "x", 2.0)
    assert np.array_equal(line["y"], np.sin(X)) and np.array_equal(line["x"], X)
    assert line["label"] == faint["label"] == "first" and faint["alpha"] == 0.3
    assert line["color"] == "#ff0000" and len(line["dash"]) == 2
    assert (points["kind"], points["marker"], points["fill"]) == ("points", "square", None)
    assert points["label"] == "second" and np.array_equal(points["y"], np.cos(X))
    assert steps["x"].tolist() == [0, 1, 1, 2, 2] and steps["y"].tolist() == [3, 3, 4, 4, 5]
    assert "label" not in steps
    assert (panel.x.label, panel.y.label) == ("Position Xᵣᵣ", "Force (kN)")
    assert panel.y.logarithmic and (panel.x.low, panel.x.high) == (0.5, 4.0)


def test_bars_are_one_shape_a_series():
    def draw(figure, axes):
        axes.bar([1, 2, 3], [4.0, 5.0, 6.0], 0.5, color="#ff0000", label="first")
        axes.bar([1.5, 2.5], [7.0, 8.0], 0.5, color="white", ec="#00ff00", hatch="//", label="b")
        axes.set_xticks([1, 2, 3], ["a", "b", "c"])
        axes.legend()

    found = shown(draw)
    first, second = found.panels[0].shapes
    assert (first["kind"], first["label"], first["top"].tolist()) == ("bars", "first", [4, 5, 6])
    assert (second["label"], second["left"].tolist()) == ("b", [1.25, 2.25]) and second["hatch"]
    assert found.panels[0].x.ticks == ((1.0, "a"), (2.0, "b"), (3.0, "c"))


def test_panels_know_whose_range_they_share():
    def draw(figure, a, b, c, d):
        for axes in (a, b, c, d):
            axes.plot(X, X)
        c.set_xlabel("along")
        a.label_outer()
        second = b.secondary_xaxis("top", functions=(lambda x: 2 * x, lambda x: x / 2))
        second.set_xticks([2.0, 4.0], ["two", "four"])
        second.set_xlabel("twice")

    found = shown(draw, 2, 2, sharex="col").panels
    assert [p.shares for p in found] == [(0, 0), (1, 1), (0, 2), (1, 3)]
    assert [p.place for p in found] == [(0, 0, 1, 1), (0, 1, 1, 1), (1, 0, 1, 1), (1, 1, 1, 1)]
    assert found[0].x.label == "along"
    assert [t for _, t in found[1].above] == ["two", "four"] and found[1].above_label == "twice"
    assert [at for at, _ in found[1].above] == pytest.approx([1.0, 2.0])


def test_legends_of_panels_are_their_own():
    """The same look means different things in two panels."""

    def draw(figure, a, b):
        for axes, name in ((a, "left"), (b, "right")):
            axes.plot(X, X, color="#ff0000", label=name)
            axes.legend()

    found = shown(draw, 1, 2)
    assert [panel.shapes[0]["label"] for panel in found.panels] == ["left", "right"]
    assert [entry["label"] for entry in found.legend] == ["left", "right"]


def test_maps_keep_their_values():
    values = np.arange(12.0).reshape(3, 4) + 1.0
    values[1, 1] = np.nan

    def draw(figure, a, b):
        mesh = a.pcolormesh(np.arange(5.0), np.arange(4.0), values, norm=LogNorm(1, 12))
        a.contour(np.arange(4) + 0.5, np.arange(3) + 0.5, np.nan_to_num(values), levels=[4.0])
        figure.colorbar(mesh, ax=a, label="error (%)")
        b.pcolormesh(
            [1, 2, 4, 8, 16], np.arange(4.0), values, norm=BoundaryNorm([2, 5], 256, extend="both")
        )
        b.set(xscale="log")

    first, second = shown(draw, 1, 2).panels
    assert kinds(first) == ["image", "line"] and kinds(second) == ["cells"]
    assert np.array_equal(first.shapes[0]["values"], values, equal_nan=True)
    assert first.shapes[0]["name"] == "error (%)" and first.shapes[0]["colours"]["log"]
    assert first.shapes[0]["bar"] and not second.shapes[0]["bar"]
    colours = second.shapes[0]["colours"]
    assert colours["bounds"] == [2.0, 5.0] and len(set(colours["palette"])) == 3


@pytest.mark.parametrize(
    "draw",
    [
        lambda figure, axes: axes.tricontourf([0, 1, 0, 1], [0, 0, 1, 1], [0, 1, 2, 3]),
        lambda figure, axes: axes.scatter(X, X, c=X),
        lambda figure, axes: axes.imshow(np.eye(3)),
        lambda figure, axes: (axes.plot(X, X), axes.axis("off")),
        lambda figure, axes: axes.plot([0, 1], [0, 1], transform=figure.transFigure),
    ],
    ids=["filled contours", "coloured points", "image", "no axes", "other coordinates"],
)
def test_what_is_no_curve_stays_a_picture(draw):
    assert shown(draw) is None


samples = st.lists(st.floats(-1e6, 1e6) | st.just(float("nan")), min_size=1, max_size=400)


@given(samples, st.integers(3, 60))
def test_thinning_keeps_extremes_and_real_values(values, most):
    y = np.array(values)
    kept = thin(y, most)
    assert len(kept) <= max(most, 3) and (np.diff(kept) > 0).all()
    if len(y) <= most:
        assert len(kept) == len(y)
    there = y[np.isfinite(y)]
    if len(there):
        assert np.nanmin(y[kept]) == there.min() and np.nanmax(y[kept]) == there.max()
    assert np.isnan(y).any() == np.isnan(y[kept]).any()


def test_thinning_loses_no_peak_of_any_stretch():
    """A spike a thousandth of the way long is there, wherever it is."""
    for at in range(7, 30_000, 2_777):
        y = np.sin(np.linspace(0, 40, 30_000))
        y[at] = 9.0
        assert at in thin(y, 300)


def unpacked(text):
    data = json.loads(text)
    arrays = [np.frombuffer(base64.b64decode(a), "<f4") for a in data["arrays"]]
    return arrays, data["figures"]


def test_what_is_packed_is_what_was_drawn():
    def draw(figure, a, b):
        a.plot(X, np.sin(X), color="#ff0000")
        b.plot(X, np.sin(X), color="#00ff00")

    text, most = packed({"f.pdf": shown(draw, 2, 1)}, 1e6)
    arrays, figures = unpacked(text)
    lines = [panel["shapes"][0] for panel in figures["f.pdf"]["panels"]]
    assert most == 0 and len(arrays) == 2  # the same arrays stand there once
    assert lines[0]["y"] == lines[1]["y"] and lines[0]["color"] == "#ff0000"
    assert arrays[lines[0]["y"]] == pytest.approx(np.sin(X), abs=1e-7)


def test_a_large_figure_is_thinned_to_the_room_it_has():
    x = np.linspace(0, 1, 50_000)

    def drawn(number):
        def draw(figure, axes):
            for k in range(8):
                axes.plot(x, np.sin(300 * x + k + 10 * number))
            axes.plot(X, X)

        return draw

    panels = {f"{k}": shown(drawn(k)) for k in range(2)}
    text, most = packed(panels, 4e5)
    assert 3e5 < len(text) < 4e5 and 300 < most < 50_000
    arrays, figures = unpacked(text)
    sizes = [len(arrays[s["x"]]) for s in figures["0"]["panels"][0]["shapes"]]
    assert sizes[-1] == len(X) and max(sizes) <= most

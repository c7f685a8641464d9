"""Orders, distributions, tables and figures of studies with axes whose law is known."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from contactstudy.driver import compute_study
from contactstudy.figures.axes import drawings
from contactstudy.figures.axes.maps import edges
from contactstudy.figures.axes.parts import styles
from contactstudy.plot.style import figure_style
from contactstudy.report.axes import _shared, abstract, parts, subject
from contactstudy.study.axes.axis import AxisOf, axis_of
from contactstudy.study.axes.shown import shown
from contactstudy.study.axes.tables import tables
from contactstudy.study.loading import load_study


@pytest.fixture
def swept(law, tmp_path):
    def run(text, own=""):
        return compute_study(load_study(law(text, own)), tmp_path / "out", 1)

    return run


def cells(results):
    (table,) = tables(results)
    return [dict(zip(table.columns, row, strict=True)) for row in table.rows]


@pytest.mark.parametrize("order", [1.0, 2.0, 3.5])
def test_the_order_and_the_limit_of_the_law_are_recovered(swept, order):
    """y = 5 + 3 x^p: order p, limit 5; the shared run does not change and is left out."""
    text = '[refine]\n"law.x" = "0.8 m to 0.1 m x 0.5"\n'
    text += f'expected = {{ "law.x" = {order} }}\n'
    results = swept(text, f"order = {order}\nscale = 3.0")
    data = results.designs["refine.law.x"].sel(run="power")
    assert float(data["largest_order"]) == pytest.approx(order, rel=1e-6)
    assert float(data["largest_limit"]) == pytest.approx(5.0, rel=1e-6)
    assert str(data["largest_verdict"].item()) == "asymptotic"
    (row,) = cells(results)
    assert row["run"] == "power" and row["limit"] == "5.00" and row["verdict"] == "asymptotic"
    assert row["order"].startswith(f"{order:.2f}")
    assert "asymptotic" in " ".join(abstract(results))


def test_values_that_rise_are_inverse_sizes(swept):
    """y = 5 + 1/n^2, refined by n: order 2 in the size 1/n."""
    results = swept('[refine]\n"law.x" = [2, 4, 8, 16]\n', "order = 1.0\nscale = 0.0")
    assert not cells(results)  # y = 5 throughout
    data = results.designs["refine.law.x"]
    assert (data["largest_verdict"] == "").all()


def test_a_refinement_at_each_point_of_a_sweep(swept):
    text = '[refine]\n"law.x" = [0.8, 0.4, 0.2, 0.1]\n[sweep]\n"law.order" = [1, 2]\n'
    found = swept(text).designs["refine.law.x"]["largest_order"].sel(run="power")
    np.testing.assert_allclose(found, [1, 2], rtol=1e-6)


def test_a_refinement_at_many_points_is_told_by_its_widest_band(swept):
    """y = 5 + s x: the band grows with s, and 26 points are more than a table shows."""
    text = '[refine]\n"law.x" = [0.8, 0.4, 0.2, 0.1]\n[sweep]\n"law.scale" = "1 to 26 by 1"\n'
    (row,) = (row for row in cells(swept(text)) if row["run"] == "power")
    assert row["at"] == "26" and row["verdicts"].startswith("26 ")


def test_two_values_have_a_difference_and_no_order(swept):
    """y = 5 + s x at two x: tables of the values, no figure, no word about order or verdict."""
    text = '[refine]\n"law.x" = [0.2, 0.1]\nexpected = { "law.x" = 1 }\n'
    results = swept(text, "order = 1.0\nscale = 3.0")
    (first, *_) = tables(results)
    column = first.columns.index("power")
    assert [row[column] for row in first.rows] == ["5.60", "5.30"]
    assert drawings(results) == []
    told = str(parts(results)) + " ".join(abstract(results))
    assert "verdict" not in told.lower() and "observed" not in told and "200 mm, 100 mm" in told
    at_many = swept(f'{text}[sweep]\n"law.scale" = "1 to 26 by 1"\n', "order = 1.0")
    (row,) = (row for row in cells(at_many) if row["run"] == "power")
    assert row["largest"] == "10.2" and row["at"] in ("26, 200 mm", "200 mm, 26")


def test_what_all_runs_share_is_told_once():
    assert _shared([{"a": 1, "b": 2}, {"a": 1, "b": 3}]) == {"a": 1}
    assert _shared([{"a": 1}, {"a": 1, "b": 3}]) == {} == _shared([{"a": 1}])


def test_a_run_looks_alike_in_all_figures_of_a_design(swept):
    (quantity,) = shown(swept('[sweep]\n"law.x" = [1, 2]\n'))
    some = replace(quantity, values=quantity.values.isel(run=[1]))
    assert styles(some) == {some.runs[0]: styles(quantity)[some.runs[0]]}


def test_keys_that_all_refinements_share_are_listed_once(swept):
    text = '[refine]\n"law.x" = [0.8, 0.4, 0.2]\n"law.scale" = [3, 2, 1]\n'
    *_, listed = subject(swept(text + '[sweep]\n"law.order" = [1, 2]\n'))
    assert [(row[1], row[2]) for row in listed["rows"]] == [
        ("1, 2", "grid"), ("0.8 m, 0.4 m, 0.2 m", "refined"), ("3, 2, 1", "refined"),
    ]  # fmt: skip


def test_the_distribution_of_seeds_is_recovered(swept):
    """Normal deviates of unit variance about 6."""
    results = swept('[sweep]\n"law.seed" = "1 to 40"\n')
    values = results.designs["sweep"]["largest"].sel(run="power").values
    assert stats.kstest(values, stats.norm(6, 1).cdf).pvalue > 0.05
    low, high = stats.t.interval(0.95, 39, loc=values.mean(), scale=stats.sem(values))
    assert low < 6.0 < high
    row = next(row for row in cells(results) if row["run"] == "power")
    assert float(row["mean"]) == pytest.approx(values.mean(), rel=5e-3)
    assert float(row["± 95 %"]) == pytest.approx((high - low) / 2, rel=5e-3)


def test_samples_are_counted_in_whole_numbers(swept):
    results = swept('[sweep]\n"law.seed" = "1 to 3"\n')
    made = next(d for d in drawings(results) if "in a sample of 3" in d.caption)
    with figure_style():
        right = made.draw().axes[1]
    assert right.get_xlabel() == "Number of samples"
    assert all(float(at).is_integer() for at in right.get_xticks())


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('"law.x" = [1, 2, 3]', "power 6.00 (at 1 m) to 14.0 (at 3 m)"),
        ('"law.word" = ["a", "b"]', "power 6.00 at a"),
        ('"law.x" = [1, 2, 3]\n"law.scale" = [1, 2]', "2, power 7.00 (at 1 m) to 23.0 (at 3 m)"),
        (
            '"law.x" = [1, 2, 3]\n"law.scale" = [1, 2, 3]',
            "over the x (m): shared 1.00 to 3.00; power 6.00 to 32.0.",
        ),
        ('"law.x" = [1, 2, 3]\n"law.seed" = [1, 2]', "Means of 2 samples"),
        (
            '"law.x" = "1 m to 5 m by 1 m"\n"law.scale" = "1 to 6 by 1"',
            "power 6.00 (at 1 m, 1) to 155 (at 5 m, 6)",
        ),
        (
            '"law.x" = "1 m to 5 m by 1 m"\n"law.scale" = "1 to 6 by 1"\n"law.order" = [1, 2]',
            "run power: 1 6.00 (at 1 m, 1) to 35.0 (at 5 m, 6); 2 6.00 (at 1 m, 1) to 155",
        ),
        ('"law.seed" = "1 to 5"', "in a sample of 5"),
        ('"law.x" = "uniform 1 m to 2 m"\ncombine = "sobol"\nsamples = 4', "in a sample of 4"),
        ('"law.x" = [1, 2]\n"law.scale" = [1, 3]\ncombine = "zip"', "over the case"),
    ],
)
def test_figures_and_their_captions(swept, text, said):
    results = swept(f"[sweep]\n{text}\n")
    made = drawings(results)
    assert made and said in " ".join(f"{d.found} {d.caption}" for d in made)
    (part,) = parts(results)
    files = [b["file"] for b in part["blocks"] if b["kind"] == "figure"]
    assert files == [f"figures/{d.name}.pdf" for d in made]


FOUR = """[sweep]
"law.x" = [1, 2, 3]
"law.scale" = [1, 2, 4, 8]
"law.order" = [1, 2, 3]
"law.word" = ["a", "b"]
"""


def test_four_keys_have_their_effects(swept):
    """y = 5 + s x^p: at x = 1 the median of 5 + s over s is 8; the word changes nothing."""
    results = swept(FOUR)
    data = results.designs["sweep"]["largest"].sel(run="power")
    (made,) = (d for d in drawings(results))
    assert "over 4 keys, one a panel" in made.caption and made.found.endswith("word 0.")
    with figure_style():
        figure = made.draw()
    panels = [axes for axes in figure.axes if axes.get_visible()]
    assert [a.get_xlabel() for a in panels] == ["x (m)", "scale", "order", "word"]
    medians = np.median(data.transpose("law.x", ...).values.reshape(3, -1), axis=1)
    assert medians[0] == 8.0
    drawn = next(line for line in panels[0].lines if line.get_label() == "power")
    np.testing.assert_allclose(drawn.get_ydata(), medians)
    _ends, table = tables(results)
    rows = [r for r in table.rows if r[1] == "power"]
    assert [row[2] for row in rows][-1] == "word" and rows[-1][3] == rows[-1][5]
    x = next(row for row in rows if row[2] == "x")
    assert (x[3], x[4], x[6]) == ("8.00", "1 m", "3 m")
    assert float(x[5]) == pytest.approx(medians[2], rel=5e-3)


def test_effects_leave_out_what_failed(swept):
    results = swept(FOUR, "breaks_at = 2.0")
    (made,) = drawings(results)
    assert "left out" in made.caption
    _, table = tables(results)
    x = next(row for row in table.rows if row[1] == "power" and row[2] == "x")
    assert (x[4], x[6]) == ("1 m", "3 m")


def test_failed_variants_are_holes_in_the_figures(swept):
    text = '[sweep]\n"law.x" = "1 m to 5 m by 1 m"\n"law.scale" = "1 to 5 by 1"\n'
    results = swept(text, "breaks_at = 2.0")
    (made,) = drawings(results)
    assert "Hatched: variants that could not be computed" in made.caption
    with figure_style():
        axes = made.draw().axes[0]
    hatched = [c for c in axes.collections if c.get_hatch()]
    assert len(hatched) == 1 and len(hatched[0].get_paths()) == 5
    text = " ".join(str(b) for b in parts(results)[0]["blocks"])
    assert "x = 2 m breaks down" in text and "5 variants could not" in " ".join(abstract(results))


def test_positions_of_an_axis(swept):
    data = swept('[sweep]\n"law.x" = [0.1, 0.2]\n').designs["sweep"]
    found = axis_of(data, "law.x")
    assert found.title == "x (mm)" and found.names == ("100 mm", "200 mm")
    geometric = AxisOf("f", np.array([1.0, 4.0, 16.0]), ("",) * 3)
    assert geometric.logarithmic
    np.testing.assert_allclose(edges(geometric), [0.5, 2, 8, 32])
    even = AxisOf("f", np.array([1.0, 11.0, 21.0]), ("",) * 3)
    assert not even.logarithmic
    np.testing.assert_allclose(edges(even), [-4, 6, 16, 26])

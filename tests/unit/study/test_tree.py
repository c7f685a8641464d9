"""Results that open by themselves: norms and units are in the file and on a notebook's page."""

import numpy as np
import pytest
import xarray as xr

import contactstudy as cs
from contactstudy.driver import compute_study
from contactstudy.exceptions import InputError
from contactstudy.study.results import write_results

STUDY = """title = "Two <beams>"
[journey]
from = "2 m"
to = "4 m"
fade_in = "0.2 m"
time_step = "200 us"
[track]
length = "6 m"
[runs.euler]
solver = "point"
rail = "euler"
k_r = "1e9 N/m"
[runs.timoshenko]
solver = "point"
rail = "timoshenko"
k_r = "1e9 N/m"
[compare]
reference = "timoshenko"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Results of a study, without its report."""
    out = tmp_path_factory.mktemp("opened")
    (out / "two.toml").write_text(STUDY, "utf-8")
    study = cs.load(out / "two.toml")
    write_results(compute_study(study, out, workers=1, here=True), out / "results")
    return out / "results"


def test_norms_are_in_the_file_and_right(folder):
    """Against the integrals of its own histories, at the positions behind the fade-in."""
    tree = xr.open_datatree(folder / "result.nc")
    error = tree["norms"].relative_l2.sel(run="euler", signal="contact_force")
    ours, theirs = tree["euler"], tree["timoshenko"]
    x = theirs.position.values
    behind = x >= 2.2 - 1e-9
    a, b = ours.contact_force.values[behind], theirs.contact_force.values[behind]
    expected = np.sqrt(np.trapezoid((a - b) ** 2, x[behind]) / np.trapezoid(b**2, x[behind]))
    assert float(error) == pytest.approx(expected, rel=1e-6)
    largest = tree["norms"].linf.sel(run="euler", signal="contact_force")
    assert float(largest) == pytest.approx(np.abs(a - b).max(), rel=1e-9)
    assert largest.unit == "N" and error.attrs["units"] == "1"


def test_it_opens_alike_with_and_without_the_program(folder):
    assert cs.open(folder).identical(xr.open_datatree(folder / "result.nc"))
    assert isinstance(cs.open(folder), xr.DataTree)
    assert cs.open(str(folder / "result.nc"))["euler"].contact_force.units == "N"


def test_a_page_begins_with_runs_norms_and_units(folder):
    tree = cs.open(folder)
    page = tree._repr_html_()
    value = 100 * float(tree["norms"].relative_l2.sel(run="euler", signal="contact_force"))
    assert f"<td>{value:.3g}</td>" in page and "contact force, total (%)" in page
    assert "<td>timoshenko</td><td>point</td>" in page and "<td>reference</td>" in page
    assert "contact_force (N)" in page and "wheel_acceleration (m/s^2)" in page
    assert "<h4>Two &lt;beams&gt;</h4>" in page  # a title is no markup
    assert "<table>" not in tree["euler"]._repr_html_()[:200]  # only above the whole


def test_no_run_may_have_the_name_of_a_group(tmp_path):
    (tmp_path / "two.toml").write_text(STUDY.replace("runs.euler", "runs.norms"), "utf-8")
    with pytest.raises(InputError, match=r"runs.norms: a run cannot be called 'norms'"):
        cs.load(tmp_path / "two.toml")


def test_a_page_of_a_study_with_axes_tells_its_variants(law, tmp_path):
    """5 + x^order, from the law of these tests; one variant of it fails."""
    study, axes = law(own="breaks_at = 3.0"), {"law.x": "1 m to 3 m by 1 m", "law.order": [1, 2]}
    cs.sweep(study, axes, out=tmp_path / "out", workers=1)
    page = cs.open(tmp_path / "out")._repr_html_()
    assert "<p>sweep: 6 variants over x (1 m, 2 m, 3 m); order (1, 2); 2 failed</p>" in page
    assert "<td>9.00</td>" in row(page, "2 m", "2") and "Largest y (m)" in page  # 5 + 2^2
    data = cs.sweep(law(), axes, workers=1)
    page = data._repr_html_()
    assert "<td>14.0</td>" in row(page, "3 m", "2") and "failed" not in page
    # what is left after a selection is shown as xarray shows it
    for part in (data.isel({"law.x": 0}), data[["largest"]], data.mean("law.x")):
        assert "<p>sweep" not in part._repr_html_()


def row(page, *values):
    """Cells of a table behind the values of the axes."""
    head = "".join(f"<td>{value}</td>" for value in values)
    return page.partition(f"<tr>{head}")[2].partition("</tr>")[0]

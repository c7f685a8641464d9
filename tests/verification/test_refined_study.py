"""Orders of the schemes as a study with [refine] finds them, against theory."""

import numpy as np
import pytest

from contactstudy.driver import compute_study
from contactstudy.report.axes import abstract
from contactstudy.study.loading import load_study

STUDY = """
[track]
length = "7.2 m"
rail = "given"

[journey]
from = "1.8 m"
to = "4.2 m"
fade_in = "0.6 m"
time_step = "20 us"

[runs.euler]
solver = "point"
rail = "euler"
k_r = "hertz_tangent"

[runs.shear]
solver = "point"
rail = "timoshenko"
k_r = "hertz_tangent"

[compare]
reference = "euler"

[refine]
"runs.euler.time_step" = ["200 us", "100 us", "50 us", "25 us", "12.5 us"]
"runs.euler.elements_per_bay" = [2, 4, 8, 16]
"runs.shear.elements_per_bay" = [4, 8, 16, 32]

[refine.expected]
"runs.euler.time_step" = 2
"runs.euler.elements_per_bay" = 3
"runs.shear.elements_per_bay" = 1

[refine.why]
"runs.shear.elements_per_bay" = "of the loaded element L/4GA of shear are left out"
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = tmp_path_factory.mktemp("refined")
    (folder / "orders.toml").write_text(STUDY)
    return compute_study(load_study(folder / "orders.toml"), folder / "out", 1)


@pytest.mark.parametrize(
    ("run", "key", "order"),
    [
        # average acceleration
        ("euler", "time_step", 2),
        # what cubic shape functions leave out under the wheel is L^3/192EI at most
        ("euler", "elements_per_bay", 3),
        # and L/4GA of shear
        ("shear", "elements_per_bay", 1),
    ],
)
def test_the_wheel_converges_with_the_order_of_the_scheme(results, run, key, order):
    data = results.designs[f"refine.runs.{run}.{key}"]
    where = {"run": run, "signal": "wheel_displacement", "part": "dynamic"}
    observed = float(data["from_finest_order"].sel(where))
    error = float(data["from_finest_order_error"].sel(where))
    print(f"{run}, {key}: expected {order}, observed {observed:.3f} +- {error:.3f}")
    assert observed == pytest.approx(order, abs=0.15)
    assert str(data["from_finest_verdict"].sel(where).item()) == "asymptotic"
    assert data.attrs["expected_order"] == order
    # the other run does not change
    other = "shear" if run == "euler" else "euler"
    assert np.all(data["from_finest"].sel(where | {"run": other}) == 0.0)


def test_the_abstract_says_which_orders_are_observed(results):
    (told,) = abstract(results)
    head = "Difference of the wheel displacement from the finest: the expected order is observed in"
    assert told.startswith(f"{head} 3 of 3 cases: time step of euler 2 (euler 2.00 ± 0.00); ")

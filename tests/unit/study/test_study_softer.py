"""Twins with a softer spring, and displacements of springs that lack the static approach."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.metrics import compare_runs, study_metrics
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.study.kinds.passage.twins import all_pieces, with_twins

COST = {"seconds": {"setup": 0.1, "stepping": 0.2}, "peak_memory_mb": 99.0}


def study(softer=0.0, amplitude="0.2 mm", **runs):
    return parse_study(
        "short",
        {
            "irregularity": {
                "spectrum": "sinusoid", "wavelength": "1 m", "amplitude": amplitude,
            },
            "track": {"length": "9 m"},
            "journey": {"from": "3 m", "to": "6 m", "time_step": "100 us",
                        "fade_in": "0.5 m"},
            "runs": {name: {"solver": "point"} | run for name, run in runs.items()},
            "compare": {"softer": softer},
        },
    )  # fmt: skip


def test_the_twin_has_so_much_less_stiffness():
    made = study(
        0.03,
        soft={"k_r": "1e9 N/m"},
        less={"k_r": "0.97e9 N/m"},
        other={"k_r": "2 x hertz_tangent"},
        hertz={"law": "hertz"},
    )
    pieces = all_pieces(made)
    assert pieces == [*made.runs, "soft.softer", "less.softer", "other.softer"]
    found = {name: execute_run(made, name) for name in pieces}
    np.testing.assert_array_equal(
        found["soft.softer"]["contact_force"], found["less"]["contact_force"]
    )
    ratio = found["other.softer"].attrs["k_r"] / found["other"].attrs["k_r"]
    assert ratio == pytest.approx(0.97, rel=1e-12)
    runs = with_twins(made, found)
    assert "contact_force_softer" not in runs["hertz"]
    told = study_metrics(runs, dict.fromkeys(runs, COST), "hertz", 4.0)["comparisons"]
    softer = told["soft"]["contact_force"]["softer"]
    assert softer["k_r"] == pytest.approx(0.97)
    assert softer["relative_l2_dynamic"] == told["less"]["contact_force"]["relative_l2_dynamic"]


@pytest.mark.parametrize("value", [-0.1, 0.6, "3 %", True, None])
def test_what_is_no_part_is_refused(value):
    with pytest.raises(InputError, match=r"compare.softer"):
        study(value, a={}, b={})


def test_a_linear_spring_moves_as_hertz_does_but_lacks_the_approach():
    """For a small irregularity Hertz is its tangent: the wheels differ by the approach alone."""
    made = study(0.0, "2 um", hertz={"law": "hertz"}, linear={"k_r": "hertz_tangent"})
    runs = {name: execute_run(made, name) for name in made.runs}
    hertz, linear = runs["hertz"], runs["linear"]
    load, k_h = made.vehicle.static_load, float(hertz.attrs["k_H"])
    apart = linear["wheel_displacement"][..., 0] - hertz["wheel_displacement"][..., 0]
    assert float(apart) == pytest.approx((load / k_h) ** (2 / 3), rel=1e-6)
    found = compare_runs(linear, hertz, 4.0)["wheel_displacement"]
    assert float(apart) > 6e-5 and found["linf"] < 2e-8
    assert found["relative_l2"] < 1e-4 and found["relative_l2_dynamic"] < 0.01

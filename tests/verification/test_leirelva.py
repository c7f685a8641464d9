"""The measured strain of Leirelva bridge: the study's shape against the record, and statics."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.held_against import held_against
from contactstudy.study.loading import load_study

RECORD = Path(__file__).parents[3] / "shared" / "data" / "leirelva_train3.csv"
SPAN, PANELS, GAUGES = 25.0 / 6, 6, (25 / 12 - 1.0, 25 / 12, 25 / 12 + 1.0)
EI, SPRING = 210e9 * 1.14e-3, 2 * 115e6


@pytest.fixture(scope="module")
def run():
    return execute_run(load_study("leirelva"), "moving_force")


def influence_lines():
    """Curvature at the gauges under a unit load at each place of a beam on springs, plainly."""
    per = 40
    h, n = SPAN / per, PANELS * per + 1
    K = np.zeros((2 * n, 2 * n))
    element = EI / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                    [-12, -6 * h, 12, -6 * h],
                                    [6 * h, 2 * h * h, -6 * h, 4 * h * h]])  # fmt: skip
    for e in range(n - 1):
        K[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += element
    for support in range(PANELS + 1):
        K[2 * support * per, 2 * support * per] += SPRING
    w = np.linalg.solve(K, -np.eye(2 * n)[:, ::2])
    at = [2 * round(x / h) for x in GAUGES]
    bend = np.array([(w[k - 2] - 2 * w[k] + w[k + 2]) / h**2 for k in at])
    return np.arange(n) * h, bend


def test_the_computed_strain_is_that_of_influence_lines(run):
    """A train this slow is nearly static; rails and sleepers spread its axles over two seats."""
    x, bend = influence_lines()
    loads = np.repeat([9.5e3 * 9.81, 14.575e3 * 9.81], 4)
    behind = np.cumsum([0.0, 2.5, 14.0, 2.5, 5.125, 2.55, 13.975, 2.5])
    lead = 21.0 * run.time.values - 12.0  # of the first axle, from the abutment
    for k in range(3):
        static = sum(
            P * np.interp(lead - back, x, bend[k], left=0.0, right=0.0)
            for P, back in zip(loads, behind, strict=True)
        )
        strain = run.deck_strain.isel(station=k).values
        found = np.corrcoef(static, strain)[0, 1]
        print(f"gauge {k}: correlation with the beam on springs alone {found:.4f}")
        assert found > 0.97
        # the areas below the curves do not feel how loads are spread
        assert 0.25 * static.sum() == pytest.approx(strain.sum(), rel=0.12)


@pytest.mark.skipif(not RECORD.is_file(), reason=f"the record is not at {RECORD}")
def test_the_computed_strain_has_the_shape_of_the_measured_one(run):
    study = load_study("leirelva", {"measured.file": str(RECORD)})
    found = held_against(study.measured, {"one": run})["runs"]["one"]
    for name, one in found["channels"].items():
        print(
            f"{name}: correlation {one['correlation']:.4f}, peaks {one['peak_ratio']:.3f}, "
            f"error {one['normalised_error']:.3f}, {1e3 * one['timing']:.1f} ms late"
        )
        # a shape that is right, with nothing fitted but clock and scale
        assert one["correlation"] > 0.9
        assert 0.75 < one["peak_ratio"] < 1.25
        assert abs(one["timing"]) < 0.02
    assert 0.3 < found["scale"] < 3.0

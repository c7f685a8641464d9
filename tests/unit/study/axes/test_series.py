"""Series of values of a key, in all forms, and distributions against scipy's."""

from datetime import date

import numpy as np
import pytest
from scipy import stats

from contactstudy.study.axes.distributions import distribution, points
from contactstudy.study.axes.keys import find_parameter
from contactstudy.study.axes.series import series
from contactstudy.study.kinds.passage.kind import PASSAGE
from contactstudy.units import UnitError

RUNS = {"runs": {"point": {"solver": "point"}}}


def parameter(key):
    return find_parameter(key, PASSAGE, RUNS)


def values(given, key):
    return series(given, parameter(key)).coordinates


def test_forms():
    assert values("1 to 5", "irregularity.seed") == (1, 2, 3, 4, 5)
    assert values("1 to 7 by 3", "irregularity.seed") == (1, 4, 7)
    assert values("7 to 1 by -3", "irregularity.seed") == (7, 4, 1)
    assert values("0 mm to 7 mm by 3.5 mm", "wheelset.lateral_shift") == (0, 0.0035, 0.007)
    assert values("100 km/h to 300 km/h by 3, linear", "journey.speed") == pytest.approx(
        np.array([100, 200, 300]) / 3.6
    )
    assert values("1 m to 16 m x 2", "journey.fade_in") == (1, 2, 4, 8, 16)
    assert values("2 to 16 x 2", "runs.point.elements_per_bay") == (2, 4, 8, 16)
    assert values("20 m to 3 m by 3", "journey.to") == (20, 11.5, 3)
    assert values(["smooth", "paper"], "irregularity.spectrum") == ("smooth", "paper")
    assert values(["1:40", "60E1"], "wheelset.wheel_profile") == ("1:40", "60E1")
    assert values([True, False], "runs.point.local_compliance") == ("true", "false")
    assert values(["tangent", 1e9], "runs.point.k_r") == ("tangent", "1000000000.0")


def test_logarithmic_values_have_one_ratio_and_exact_ends():
    found = series("20 mm to 3 m by 14, logarithmic", parameter("journey.fade_in"))
    assert len(found) == 14 and found.coordinates[0] == 0.02 and found.coordinates[-1] == 3.0
    assert np.ptp(np.diff(np.log(found.coordinates))) < 1e-10 and found.unit == "m"


def test_factors_stand_on_an_axis_of_numbers():
    found = series("0.25 x tangent to 4 x tangent x 4", parameter("runs.point.k_r"))
    assert found.values == ("0.25 x tangent", "1 x tangent", "4 x tangent")
    assert found.coordinates == (0.25, 1.0, 4.0)
    assert (found.unit, found.factor_of) == ("", "tangent")


def test_factors_in_a_range_of_a_number_of_values():
    text = "0.25 x tangent to 1000 x tangent by 3, logarithmic"
    found = series(text, parameter("runs.point.k_r"))
    assert found.coordinates == pytest.approx((0.25, 250**0.5, 1000)) and found.factor_of


def test_arrays_ranges_and_numbers_of_numpy_are_values_of_a_file():
    for given in (np.arange(1, 4), range(1, 4), [np.int64(1), np.int64(2), np.array(3)]):
        found = series(given, parameter("irregularity.seed")).values
        assert found == (1, 2, 3) and {type(value) for value in found} == {int}
    found = series([np.array([0.1, 0.2])], parameter("solid.pressure_at"))
    assert found.values == ([0.1, 0.2],)


@pytest.mark.parametrize(
    ("given", "key", "message"),
    [
        ("1 to 1e12", "irregularity.seed", "20000 at most"),
        ("1 m to 2 m by 1e9, linear", "journey.fade_in", "2 to 20000 values"),
        ("1 m to 2 m", "journey.fade_in", "needs a step or a number of values"),
        ("1 m to 2 m by 0.3 m", "journey.fade_in", "whole steps"),
        ("100 to 300 km/h by 50", "journey.speed", "has a unit at one end only; allowed: at both"),
        ("20 km/h to 300 by 3, linear", "journey.speed", r"at neither \(then in m/s\)"),
        ("1 m to 2 m by 0 m", "journey.fade_in", "whole steps"),
        ("0 m to 2 m by 3, logarithmic", "journey.fade_in", "must not reach zero"),
        ("1 m to 9 m x 2", "journey.fade_in", "whole factors"),
        ("1 m to 8 m x 1", "journey.fade_in", "whole factors"),
        ("1 kg to 8 m x 2", "journey.fade_in", "wrong unit 'kg'"),
        (
            "1 m to 8 m + 2 m",
            "journey.fade_in",
            '“8 m \\+ 2 m” must be a number .*text like "1 to 50',
        ),
        ([1, 2, 1.0], "journey.fade_in", "must not hold a value twice"),
        ([], "journey.fade_in", "at least one value"),
        (date(2026, 1, 1), "journey.fade_in", "holds a date"),
        ([None], "journey.fade_in", "holds a NoneType"),
        ("1e x tangent to 4 x tangent x 2", "runs.point.k_r", "unknown unit 'e x tangent'"),
    ],
)
def test_what_is_refused(given, key, message):
    with pytest.raises(UnitError, match=message):
        series(given, parameter(key))


@pytest.mark.parametrize("method", ["sobol", "latin_hypercube"])
@pytest.mark.parametrize(
    ("text", "key", "law"),
    [
        ("uniform 0.5 m to 0.7 m", "track.spacing", stats.uniform(0.5, 0.2)),
        ("log-uniform 1 MN/m to 1 GN/m", "track.pad_stiffness", stats.loguniform(1e6, 1e9)),
        ("normal 65 MN/m, 5 MN/m", "track.pad_stiffness", stats.norm(65e6, 5e6)),
    ],
)
def test_samples_have_the_distribution_that_was_stated(method, text, key, law):
    p = points(method, 1, 256, seed=3)[:, 0]
    drawn = distribution(text, parameter(key))(p)
    # both are stratified: the empirical distribution is within one step of the law
    gap = stats.kstest(drawn, law.cdf).statistic
    assert gap <= 1.5 / 256
    np.testing.assert_array_equal(p, points(method, 1, 256, seed=3)[:, 0])
    assert not np.array_equal(p, points(method, 1, 256, seed=4)[:, 0])


def test_whole_numbers_are_equally_likely():
    drawn = distribution("uniform 1 to 4", parameter("irregularity.seed"))
    assert np.bincount(drawn(points("latin_hypercube", 1, 400, 1)[:, 0]).astype(int)).tolist() == [
        0, 100, 100, 100, 100,
    ]  # fmt: skip


def test_whole_numbers_are_rounded_not_cut_off():
    p, key = (np.arange(200_000) + 0.5) / 200_000, parameter("runs.point.elements_per_bay")
    drawn = distribution("log-uniform 2 to 32", key)(p)
    share = np.log((np.arange(2, 33) + 0.5) / (np.arange(2, 33) - 0.5)) / np.log(32.5 / 1.5)
    assert np.bincount(drawn.astype(int))[2:] / len(p) == pytest.approx(share, abs=1e-5)
    drawn = distribution("normal 8, 1.5", key)(p)
    assert np.all(drawn % 1 == 0) and drawn.mean() == pytest.approx(8.0, abs=1e-3)
    with pytest.raises(UnitError, match="one whole number to another"):
        distribution("uniform 1.5 to 4", key)


@pytest.mark.parametrize("text", ["uniform 2 m to 1 m", "log-uniform 0 m to 1 m", "normal 1 m"])
def test_impossible_distributions(text):
    with pytest.raises(UnitError):
        distribution(text, parameter("journey.fade_in"))

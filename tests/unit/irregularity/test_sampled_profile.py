import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contactstudy.exceptions import InputError
from contactstudy.irregularity import (
    HarmonicProfile,
    RepeatWarning,
    SmoothRail,
    check_repeat,
    faded,
    sample_profile,
    spectrum,
)

PAPER = spectrum("paper")


def _brute_force(profile: HarmonicProfile, x: np.ndarray, derivative: int) -> np.ndarray:
    """Eq. (1) term by term."""
    total = np.zeros_like(x)
    terms = zip(profile.amplitudes, profile.wavenumbers, profile.phases, strict=True)
    for a, w, phi in terms:
        total += a * w**derivative * np.cos(w * x + phi + derivative * np.pi / 2)
    return total


@pytest.mark.parametrize("jitter", [False, True])
@pytest.mark.parametrize("derivative", [0, 1, 2])
def test_kernels_against_the_sum_term_by_term(jitter, derivative):
    profile = sample_profile(PAPER, 3, jitter=jitter)
    x = np.linspace(-50.0, 3000.0, 401)
    expected = _brute_force(profile, x, derivative)
    error = np.abs(profile(x, derivative) - expected).max() / np.abs(expected).max()
    assert error < 2e-11  # phases of up to 6e4 rad carry a rounding error of 1e-11


@settings(max_examples=40)
@given(
    seed=st.integers(0, 2**32),
    jitter=st.booleans(),
    x=st.lists(st.floats(-1e4, 1e4), min_size=1, max_size=600),
)
def test_a_profile_does_not_depend_on_the_positions_asked_for(seed, jitter, x):
    profile = sample_profile(PAPER, seed, n_terms=50, jitter=jitter)
    together = profile(x)
    alone = np.array([profile(value) for value in x])
    np.testing.assert_array_equal(together, alone)
    np.testing.assert_array_equal(together, sample_profile(PAPER, seed, 50, jitter=jitter)(x))
    grid = np.array([*x, *x]).reshape(2, -1)
    np.testing.assert_array_equal(profile(grid), np.array([together, together]))


@pytest.mark.parametrize("jitter", [False, True])
def test_derivatives_against_finite_differences(jitter):
    profile = sample_profile(PAPER, 5, jitter=jitter)
    _check_derivatives(profile, np.linspace(1.0, 29.0, 57))


def test_derivatives_of_a_faded_profile_against_finite_differences():
    profile = faded(sample_profile(PAPER, 5), start=6.0, length=3.0)
    # at the two ends themselves only the second derivative is continuous
    _check_derivatives(profile, np.linspace(5.01, 10.01, 101))


def _check_derivatives(profile, x):
    h = 1e-3
    for n in (0, 1):
        y = [profile(x + k * h, n) for k in (-2, -1, 1, 2)]
        difference = (y[0] - 8 * y[1] + 8 * y[2] - y[3]) / (12 * h)
        exact = profile(x, n + 1)
        # fourth order: h^4/30 times the fifth derivative, (20 rad/m h)^4/30 = 5e-9
        np.testing.assert_allclose(difference, exact, atol=3e-8 * np.abs(exact).max())


def test_fade_in_is_smooth_and_leaves_the_rest_alone():
    plain = sample_profile(PAPER, 1)
    profile = faded(plain, start=6.0, length=3.0)
    for n in (0, 1, 2):
        np.testing.assert_array_equal(profile([0.0, 5.0, 6.0], n), 0.0)
        np.testing.assert_allclose(profile([9.0, 12.0], n), plain([9.0, 12.0], n), rtol=1e-14)
        assert abs(profile(6.0 + 1e-7, n)) < 1e-6 * np.abs(plain(np.arange(9.0), n)).max()
    assert profile(7.5) == pytest.approx(0.5 * plain(7.5))
    assert faded(plain, 6.0, 0.0) is plain
    with pytest.raises(InputError, match="0 m or more"):
        faded(plain, 0.0, -1.0)


def test_directions_of_one_seed_are_independent_and_jitter_keeps_the_phases():
    vertical = sample_profile(PAPER, 7)
    transverse = sample_profile(PAPER, 7, direction="transverse")
    np.testing.assert_array_equal(vertical.amplitudes, transverse.amplitudes)
    assert abs(np.corrcoef(vertical.phases, transverse.phases)[0, 1]) < 0.1
    jittered = sample_profile(PAPER, 7, jitter=True)
    np.testing.assert_array_equal(jittered.phases, vertical.phases)
    # one wavenumber in each interval
    step = (20.0 - 0.08) / 1000
    offset = (jittered.wavenumbers - 0.08) / step - np.arange(1000)
    assert 0.0 <= offset.min() < 0.01 and 0.99 < offset.max() <= 1.0


def test_long_studies_are_warned_of_the_near_repeat():
    profile = faded(sample_profile(PAPER, 1), 0.0, 3.0)
    with pytest.warns(RepeatWarning, match=r"315\.4 m.*jittered"):
        assert check_repeat(profile, 316.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not check_repeat(profile, 315.0)
        assert not check_repeat(sample_profile(PAPER, 1, jitter=True), 1e5)
        assert not check_repeat(SmoothRail(), 1e5)


@pytest.mark.parametrize("n_terms", [2, 1000, 100_000])
def test_equal_spacing_is_recognised(n_terms):
    step = (20.0 - 0.08) / n_terms
    assert sample_profile(PAPER, 1, n_terms).spacing == pytest.approx(step, rel=1e-9)
    assert sample_profile(PAPER, 1, n_terms, jitter=True).spacing is None or n_terms == 2


def test_smooth_rail_and_a_single_cosine():
    assert SmoothRail()(np.ones((2, 3)), 1).shape == (2, 3)
    assert not SmoothRail()(np.ones(4)).any()
    single = HarmonicProfile(np.array([2e-3]), np.array([3.0]), np.array([0.4]))
    assert single(1.5, 2) == pytest.approx(-2e-3 * 9.0 * np.cos(4.9))
    assert single.rms == pytest.approx(2e-3 / np.sqrt(2))


def test_wrong_arguments_are_reported_at_once():
    with pytest.raises(InputError) as caught:
        sample_profile(PAPER, -1, n_terms=0, band=(20.0, 0.08), direction="up")  # type: ignore[arg-type]
    text = str(caught.value)
    for word in ("seed is -1", "terms is 0", "0 < lower < upper", "vertical, transverse"):
        assert word in text
    with pytest.raises(InputError, match="equally long"):
        HarmonicProfile(np.ones(2), np.ones(3), np.ones(3))
    with pytest.raises(InputError, match="allowed: 0, 1, 2"):
        SmoothRail()(0.0, 3)

"""What is known of an error on a few samples, and what it says of another one."""

from dataclasses import replace

import numpy as np
import pytest

from contactstudy.advice.reasons import waves
from contactstudy.advice.samples import SAMPLES, Varied, samples
from contactstudy.study.loading import load_study

BASE = {"track.length": "7.2 m", "journey.from": "1.2 m", "journey.to": "4.8 m"}
BASE |= {"journey.fade_in": "0.6 m"}


def study(values):
    return load_study("smooth_rail", BASE | values)


def test_the_limit_holds_with_its_confidence():
    # ln E = ln A + d with normal ln A: the limit from one E must cover 95 % of further ones
    rng, covered = np.random.default_rng(5), []
    for _ in range(4000):
        logs = rng.normal(0.3, 0.4, SAMPLES + 1)
        varied = Varied(tuple(np.exp(logs[:-1])))
        covered.append(0.1 * np.exp(logs[-1]) <= varied.limit([0.1 * np.exp(logs[0])]))
    assert np.mean(covered) == pytest.approx(0.95, abs=0.012)


def test_the_limit_by_hand():
    # logs 0, 1, 2: mean 1, s 1, t_95 of 2 dof 2.91999, d = ln 0.1
    found = Varied((1.0, np.e, np.e**2)).limit([0.1])
    assert found == pytest.approx(0.1 * np.exp(1 + 2.919986 * np.sqrt(4 / 3)), rel=1e-6)
    assert Varied((1.0, np.e, np.e**2)).expected([0.1]) == pytest.approx(0.1 * np.e, rel=1e-12)


def test_errors_that_do_not_vary_need_no_margin():
    varied = Varied((0.2,) * 5)
    assert varied.limit([0.03]) == pytest.approx(0.03, rel=1e-12)
    assert varied.limit([0.03, 0.05]) == 0.05  # never below what was seen


def test_too_little_known_gives_no_limit():
    assert Varied(()).limit([0.01]) == np.inf
    assert Varied((0.1, np.nan, 0.2)).limit([0.01]) == np.inf
    assert Varied((np.nan, 0.1, 0.2, 0.3)).limit([0.01]) == np.inf  # not on the sample with E


def test_samples_of_a_spectrum_are_seeds():
    made = study({"irregularity.spectrum": "german_low", "irregularity.seed": 7})
    found = samples(made)
    assert found.values == tuple(range(7, 7 + SAMPLES))
    assert found.of(made, 2).irregularity == replace(made.irregularity, seed=9)
    assert found.label(1) == "seed 8"


@pytest.mark.parametrize("spectrum", ["smooth", "sinusoid"])
def test_what_is_not_random_has_one_sample(spectrum):
    assert samples(study({"irregularity.spectrum": spectrum})) is None


@pytest.mark.parametrize(("ends", "count"), [((0.0, 25.0), 6), ((1.0, 5.0), 0), ((-3.0, 8.5), 3)])
def test_samples_of_a_record_are_its_stretches(tmp_path, ends, count):
    x = np.arange(ends[0], ends[1] + 1e-9, 0.01)
    rows = "\n".join(f"{a:.3f},{1e-3 * np.sin(9 * a):.9f}" for a in x)
    (tmp_path / "level.csv").write_text(f"x,z\n{rows}\n")
    values = {"spectrum": "measured", "file": str(tmp_path / "level.csv"), "level_column": "z"}
    values |= {"wavelengths": [0.1, 2.0]}
    made = study({f"irregularity.{key}": value for key, value in values.items()})
    found = samples(made)
    assert (0 if found is None else len(found.values)) == count
    for k in range(count):
        low, high = found.of(made, k).irregularity.profile().domain
        assert low <= made.journey.start and made.journey.end <= high
    if count:
        assert found.of(made, 0) == made


def test_most_of_an_error_is_found_where_it_is():
    import xarray as xr

    x = np.linspace(0.0, 12.0, 4801)
    wave = np.sin(2 * np.pi * x / 0.5)

    def run(force):
        return xr.Dataset({"contact_force": ("time", 1e5 + force), "position": ("time", x)})

    small = 10.0 * np.sin(2 * np.pi * x / 0.1)
    found = waves(run(100.0 * wave + small), run(0.0 * wave), start=2.0)
    assert found.shortest < 0.5 < found.longest < 1.3 * 0.5
    assert found.share > 0.9
    assert waves(run(wave), run(wave), start=2.0) is None

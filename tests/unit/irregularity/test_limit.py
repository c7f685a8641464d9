"""Profile at the roughness limit of ISO 3095."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.irregularity.estimate import third_octave_levels
from contactstudy.irregularity.limit import ISO_3095_LIMIT, iso_3095_profile


def test_third_octaves_are_the_limit():
    profile = iso_3095_profile(3)
    x = np.arange(0.0, 80.0, 1e-3)
    found = third_octave_levels(profile(x), 1e-3, band=(2.5, 50.0))
    # nominal wavelengths are not the reciprocals of nominal wavenumbers: 0.315 m and 3.15 1/m
    limit = [ISO_3095_LIMIT[w] for w in sorted(ISO_3095_LIMIT, reverse=True) if w >= 0.02]
    print("limit", limit, "computed", np.round(found.level, 2))
    np.testing.assert_allclose(found.level, limit, atol=0.15)
    # and nothing beyond the bands: the variance is that of the limit
    total = sum(10 ** (ISO_3095_LIMIT[w] / 10) for w in ISO_3095_LIMIT if w >= 0.02)
    assert profile.rms == pytest.approx(1e-6 * np.sqrt(total))


def test_seed_and_band():
    assert np.array_equal(iso_3095_profile(1).phases, iso_3095_profile(1).phases)
    assert not np.array_equal(iso_3095_profile(1).phases, iso_3095_profile(2).phases)
    short = iso_3095_profile(1, (0.016, 0.016), lines=3)
    assert len(short.amplitudes) == 3
    np.testing.assert_allclose(2 * np.pi / short.wavenumbers, 0.016, rtol=0.12)


def test_every_problem_is_named():
    with pytest.raises(InputError) as error:
        iso_3095_profile(-1, (1.0, 2.0), lines=0)
    assert len(error.value.problems) == 3

"""The low-pass filter against its closed form."""

import numpy as np
import pytest

from contactstudy.compare.low_pass import low_pass
from contactstudy.exceptions import InputError

STEP, CUT_OFF = 5e-4, 20.0


@pytest.mark.parametrize(("ratio", "gain"), [(0.25, 1.0), (1.0, 2**-0.5), (2.0, 1 / 257**0.5)])
def test_the_filter_is_butterworths_of_order_four(ratio, gain):
    """|H| = 1/sqrt(1 + (f/f_c)^8): 24 dB an octave."""
    t = STEP * np.arange(8000)
    f = ratio * CUT_OFF
    found = low_pass(np.stack([np.sin(2 * np.pi * f * t)] * 2), STEP, CUT_OFF)[1, 4000:]
    assert np.abs(found).max() == pytest.approx(gain, rel=0.02)


def test_a_constant_force_passes_without_a_transient():
    force = np.full((2, 50), [[60e3], [70e3]])
    np.testing.assert_allclose(low_pass(force, STEP, CUT_OFF), force)


def test_samples_too_far_apart_are_refused():
    with pytest.raises(InputError, match=r"must be below 0\.025 s"):
        low_pass(np.zeros(10), 0.03, CUT_OFF)

import numpy as np
import pytest

from contactstudy.compare.passing import passing_amplitude
from contactstudy.exceptions import InputError


def test_components_of_a_known_signal():
    x = np.linspace(3.017, 11.3, 4001)
    s = 5e4 + 30.0 * x
    s = s + 200 * np.cos(2 * np.pi * x / 0.6 + 0.3) + 7 * np.sin(2 * np.pi * x / 0.15 + 1.0)
    np.testing.assert_allclose(
        passing_amplitude(x, s, 0.6, 5), [200, 0, 0, 7, 0], atol=0.05, rtol=1e-3
    )
    np.testing.assert_allclose(passing_amplitude(x, s, 0.15, 1, fundamental=0.6), [7], atol=0.05)


def test_impossible_requests():
    x = np.linspace(0, 1, 11)
    for bad in (
        lambda: passing_amplitude(x, x[:5], 0.6),
        lambda: passing_amplitude(x[::-1], x, 0.6),
        lambda: passing_amplitude(x, x, 2.0),
        lambda: passing_amplitude(x, x, 0.6, 0),
    ):
        with pytest.raises(InputError):
            bad()

import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.exceptions import NumericalError


def banded(n, bandwidth, seed=0):
    rng = np.random.default_rng(seed)
    lower = np.tril(rng.standard_normal((n, n)))
    lower[np.subtract.outer(np.arange(n), np.arange(n)) > bandwidth] = 0.0
    lower[np.diag_indices(n)] = 2.0 + rng.random(n) + bandwidth
    return lower @ lower.T


@pytest.mark.parametrize(
    ("n", "bandwidth"), [(1, 0), (5, 0), (8, 3), (17, 16), (100, 7), (203, 41)]
)
def test_solution_equals_dense(n, bandwidth):
    matrix = banded(n, bandwidth)
    factor = Factor(sp.csr_array(matrix))
    rng = np.random.default_rng(1)
    b = rng.standard_normal((n, 3))
    kept = b.copy()
    exact = np.linalg.solve(matrix, b)
    np.testing.assert_allclose(factor.solve(b), exact, rtol=1e-11, atol=1e-14)
    np.testing.assert_allclose(factor.solve(b[:, 0]), exact[:, 0], rtol=1e-11, atol=1e-14)
    np.testing.assert_array_equal(b, kept)
    assert factor.half_bandwidth == min(bandwidth, n - 1)


def test_loads_on_few_dofs_of_a_band_that_varies():
    """Sweeps that end where nothing is felt, and leading zeros that are passed over."""
    n = 400
    matrix = banded(n, 6)
    matrix[200:212, 180:190] = matrix[180:190, 200:212] = 0.0
    matrix[210, 180] = matrix[180, 210] = 0.3
    matrix += 30.0 * np.eye(n)
    factor = Factor(sp.csr_array(matrix))
    loads = np.zeros((n, 4))
    loads[0, 0] = loads[n - 1, 1] = loads[205, 2] = 1.0
    exact = np.linalg.solve(matrix, loads)
    got = factor.solve(loads)
    np.testing.assert_allclose(got, exact, rtol=1e-10, atol=1e-16 * np.abs(exact).max())
    np.testing.assert_array_equal(got[:, 3], 0.0)


@pytest.mark.parametrize("bad", [np.diag([1.0, -1.0]), np.zeros((2, 2)), np.diag([1.0, np.nan])])
def test_not_positive_definite_is_reported(bad):
    with pytest.raises(NumericalError, match="2 dofs"):
        Factor(sp.csr_array(bad))


def test_stacked_systems_and_combination():
    one = LinearSystem(*(sp.csr_array(k * np.eye(2)) for k in (1.0, 2.0, 3.0)))
    two = LinearSystem(*(sp.csr_array(k * np.eye(1)) for k in (10.0, 20.0, 30.0)))
    stacked = LinearSystem.stacked(one, two)
    assert stacked.n_dofs == 3
    combined = stacked.combine(1.0, 10.0, 100.0).toarray()
    np.testing.assert_allclose(combined, np.diag([321.0, 321.0, 3210.0]))

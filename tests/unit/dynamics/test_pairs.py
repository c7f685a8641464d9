import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.dynamics.pairs import Pair, pair, subtract_products


def scattered(rng, n):
    """Entries that only one has, rows without any, values that cancel in the sum of both."""
    A, B = (sp.random_array((n, n), density=0.1, rng=rng).toarray() for _ in range(2))
    A[7], B[7] = 0.0, 0.0
    A[3, 5], B[3, 5] = 1.5, -1.5
    return A, B


def banded(rng, n):
    """Equal rows over and over, and a second matrix that has fewer of them and some gaps."""
    row = rng.standard_normal(9)
    A = np.array([np.pad(row, (i, n - 9 - i)) for i in np.minimum(range(n), n - 9)])
    B = np.where(np.arange(n)[:, None] % 4 == 0, A * rng.integers(0, 2, (n, n)), 0.0)
    return A, B


@pytest.mark.parametrize(("made", "by_entries"), [(scattered, True), (banded, False)])
def test_products_are_those_of_both_matrices(made, by_entries):
    rng, n = np.random.default_rng(1), 40
    A, B = made(rng, n)
    x, y, total = rng.standard_normal(n), rng.standard_normal(n), rng.standard_normal(n)
    expected = total - A @ x - B @ y
    matrices = pair(sp.csr_array(A), sp.csr_array(B))
    assert isinstance(matrices, Pair) == by_entries
    subtract_products(matrices, x, y, total)
    np.testing.assert_allclose(total, expected, rtol=1e-13, atol=1e-14)

import numpy as np
import scipy.sparse as sp

from contactstudy.dynamics.pairs import pair, subtract_products


def test_products_are_those_of_both_matrices():
    """Entries that only one has, rows without any, values that cancel in the sum of both."""
    rng, n = np.random.default_rng(1), 40
    A, B = (sp.random_array((n, n), density=0.1, rng=rng).toarray() for _ in range(2))
    A[7], B[7] = 0.0, 0.0
    A[3, 5], B[3, 5] = 1.5, -1.5
    x, y, total = rng.standard_normal(n), rng.standard_normal(n), rng.standard_normal(n)
    expected = total - A @ x - B @ y
    subtract_products(pair(sp.csr_array(A), sp.csr_array(B)), x, y, total)
    np.testing.assert_allclose(total, expected, rtol=1e-13, atol=1e-14)

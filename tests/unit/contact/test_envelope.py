import numpy as np
import pytest

from contactstudy.contact.envelope import solve_in_envelope


@pytest.mark.parametrize("reach", [0, 2, 30])
def test_solution_is_that_of_the_whole_matrix(reach):
    """Rows that begin at different columns, one of them at the very first."""
    rng, n = np.random.default_rng(1), 30
    A = rng.standard_normal((n, n))
    A = 0.5 * (A + A.T)
    A[np.abs(np.subtract.outer(np.arange(n), np.arange(n))) > reach] = 0.0
    A[20, 0] = A[0, 20] = 0.7
    A += 12.0 * np.eye(n)
    b, before = rng.standard_normal(n), A.copy()
    np.testing.assert_allclose(solve_in_envelope(A, b), np.linalg.solve(A, b), rtol=1e-12)
    np.testing.assert_array_equal(A, before)


def test_matrix_that_is_not_positive_definite_has_no_solution():
    assert np.isnan(solve_in_envelope(np.array([[1.0, 2.0], [2.0, 1.0]]), np.ones(2))).all()

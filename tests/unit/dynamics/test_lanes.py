import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.lanes import LANES, lane_system, subtract_in_lanes
from contactstudy.dynamics.windows import windows


def banded(n, bandwidth, rng):
    lower = np.tril(rng.standard_normal((n, n)))
    lower[np.subtract.outer(np.arange(n), np.arange(n)) > bandwidth] = 0.0
    lower[np.diag_indices(n)] = 2.0 + bandwidth
    return lower @ lower.T


@pytest.mark.parametrize(("n", "bandwidth"), [(1, 0), (2, 1), (8, 3), (60, 7)])
def test_products_and_solution_equal_dense_ones_in_every_lane(n, bandwidth):
    rng = np.random.default_rng(0)
    M, C, K, S = (banded(n, bandwidth, rng) for _ in range(4))
    C[n // 2 :] = 0.0  # rows without any value
    system = LinearSystem(*map(sp.csr_array, (M, C, K)))
    made = lane_system(system, Factor(sp.csr_array(S)))
    for lanes in (1, LANES):
        x, b = rng.standard_normal((2, n, lanes))
        for A, rows in ((M, made.mass), (C, made.damping), (K, made.stiffness)):
            y = made.inverse[:, None] * b
            subtract_in_lanes(rows, x, y, False)
            np.testing.assert_allclose(y / made.inverse[:, None], b - A @ x, atol=1e-11)
        y = made.inverse[:, None] * b
        subtract_in_lanes(made.lower, y, y, False)
        subtract_in_lanes(made.upper, y, y, True)
        np.testing.assert_allclose(y, np.linalg.solve(S, b), rtol=1e-10, atol=1e-13)


def test_a_lane_has_the_same_bits_alone_and_beside_others():
    rng = np.random.default_rng(1)
    rows = windows(sp.csr_array(banded(50, 5, rng)))
    x, y = rng.standard_normal((2, 50, LANES))
    alone = [y[:, k : k + 1].copy() for k in range(LANES)]
    for k, one in enumerate(alone):
        subtract_in_lanes(rows, x[:, k : k + 1].copy(), one, False)
    subtract_in_lanes(rows, x, y, False)
    np.testing.assert_array_equal(y, np.hstack(alone))


def test_windows_hold_the_matrix_and_share_equal_rows():
    matrix = sp.csr_array(sp.diags_array([[1.0] * 99, [4.0] * 100, [1.0] * 99], offsets=[-1, 0, 1]))
    first, width, begin, values = windows(matrix)
    dense = np.zeros(matrix.shape)
    for row in range(100):
        at = slice(first[row], first[row] + width[row])
        dense[row, at] = values[begin[row] : begin[row] + width[row]]
    np.testing.assert_array_equal(dense, matrix.toarray())
    assert len(values) <= 9  # the first row, the last, and all between
    assert windows(sp.csr_array((3, 3))).width.sum() == 0

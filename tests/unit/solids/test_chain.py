"""Block elimination against dense linear algebra."""

import numpy as np
import pytest

from contactstudy.exceptions import NumericalError
from contactstudy.solids.chain import BlockTridiagonal, Slice, chain_blocks, merge, repeat


def random_slice(n, seed):
    A = np.random.default_rng(seed).normal(size=(2 * n, 2 * n))
    K = A @ A.T + 0.1 * np.eye(2 * n)
    return Slice(K[:n, :n], K[:n, n:], K[n:, n:])


def dense(slices):
    diagonal, upper = chain_blocks(slices)
    n, count = len(diagonal[0]), len(diagonal)
    K = np.zeros((n * count, n * count))
    for i, D in enumerate(diagonal):
        K[i * n : (i + 1) * n, i * n : (i + 1) * n] = D
    for i, E in enumerate(upper):
        K[i * n : (i + 1) * n, (i + 1) * n : (i + 2) * n] = E
        K[(i + 1) * n : (i + 2) * n, i * n : (i + 1) * n] = E.T
    return K


def test_factor_solves_the_dense_system():
    slices = [random_slice(4, i) for i in range(5)]
    K = dense(slices)
    b = np.random.default_rng(9).normal(size=(24, 3))
    x = BlockTridiagonal(*chain_blocks(slices)).solve(np.split(b, 6))
    np.testing.assert_allclose(np.vstack(x), np.linalg.solve(K, b), rtol=1e-10)


def test_blocks_of_different_sizes():
    K = np.random.default_rng(2).normal(size=(9, 9))
    K = K @ K.T + np.eye(9)
    K[:2, 5:] = 0
    K[5:, :2] = 0
    cut = [slice(0, 2), slice(2, 5), slice(5, 9)]
    b = np.arange(9.0)[:, None]
    factor = BlockTridiagonal([K[c, c] for c in cut], [K[cut[0], cut[1]], K[cut[1], cut[2]]])
    np.testing.assert_allclose(np.vstack(factor.solve([b[c] for c in cut])), np.linalg.solve(K, b))


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_repeat_is_the_schur_complement(count):
    n = 3
    piece = random_slice(n, 1)
    K = dense([piece] * count)
    ends = np.r_[0:n, n * count : n * (count + 1)]
    inner = np.arange(n, n * count)
    S = K[np.ix_(ends, ends)]
    if count > 1:
        S = S - K[np.ix_(ends, inner)] @ np.linalg.solve(
            K[np.ix_(inner, inner)], K[np.ix_(inner, ends)]
        )
    joined = repeat(piece, count)
    np.testing.assert_allclose(joined.aa, S[:n, :n], rtol=1e-9)
    np.testing.assert_allclose(joined.ab, S[:n, n:], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(joined.bb, S[n:, n:], rtol=1e-9)


def test_indefinite_pivot_is_named():
    bad = Slice(-np.eye(2), np.zeros((2, 2)), np.eye(2))
    with pytest.raises(NumericalError, match="block 0 of 2"):
        BlockTridiagonal(*chain_blocks([bad]))
    with pytest.raises(NumericalError, match="between two merged"):
        merge(Slice(np.eye(2), np.eye(2), -np.eye(2)), bad)

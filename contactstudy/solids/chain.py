"""Chains of slices: block-tridiagonal elimination and merging with dense blocks.

A prismatic or ring-shaped body is cut into slices between planes that carry the same
section mesh. A slice couples only its two planes, so the stiffness of the chain is
block-tridiagonal with dense blocks of the size of one plane.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl

from contactstudy.arrays import Array
from contactstudy.exceptions import NumericalError


@dataclass(frozen=True)
class Slice:
    """Stiffness (or mass) of a piece of the chain, condensed to its two end planes.

    Attributes
    ----------
    aa, ab, bb : ndarray (n, n)
        Blocks of the symmetric matrix on (first plane a, second plane b); ``ba = ab.T``.
    """

    aa: Array
    ab: Array
    bb: Array


def _cholesky(A: Array, where: str) -> Array:
    try:
        return np.asarray(sl.cholesky(A, lower=True, check_finite=False))
    except sl.LinAlgError as error:
        raise NumericalError(f"chain elimination: {where} is not positive definite") from error


def merge(first: Slice, second: Slice) -> Slice:
    """Join two stiffness pieces and eliminate the plane between them statically.

    With the shared plane c: ``K' = K - K_c (first.bb + second.aa)^-1 K_c^T``.
    """
    L = _cholesky(first.bb + second.aa, "the plane between two merged pieces")
    # columns of Y: L^-1 [K_ca, K_cb]
    Ya = sl.solve_triangular(L, first.ab.T, lower=True, check_finite=False)
    Yb = sl.solve_triangular(L, second.ab, lower=True, check_finite=False)
    return Slice(first.aa - Ya.T @ Ya, -Ya.T @ Yb, second.bb - Yb.T @ Yb)


def repeat(piece: Slice, count: int) -> Slice:
    """Stiffness of `count` equal pieces in a row, by binary doubling."""
    result: Slice | None = None
    power = piece
    while True:
        if count & 1:
            result = power if result is None else merge(result, power)
        count >>= 1
        if count == 0:
            assert result is not None
            return result
        power = merge(power, power)


class BlockTridiagonal:
    """Cholesky factor of a symmetric positive definite block-tridiagonal matrix.

    Of its diagonal blocks (n_i, n_i) and the blocks (i, i+1) above them, (n_i, n_{i+1}).

    Raises
    ------
    NumericalError
        If a pivot block is not positive definite.
    """

    def __init__(self, diagonal: Sequence[Array], upper: Sequence[Array]) -> None:
        # D'_0 = D_0,  D'_{i+1} = D_{i+1} - E_i^T D'_i^-1 E_i,  D'_i = L_i L_i^T,  Y_i = L_i^-1 E_i
        self._L: list[Array] = []
        self._Y: list[Array] = []
        pivot = np.asarray(diagonal[0])
        for i in range(len(diagonal)):
            L = _cholesky(pivot, f"block {i} of {len(diagonal)}")
            self._L.append(L)
            if i + 1 < len(diagonal):
                Y = sl.solve_triangular(L, upper[i], lower=True, check_finite=False)
                self._Y.append(Y)
                pivot = diagonal[i + 1] - Y.T @ Y

    def solve(self, rhs: Sequence[Array]) -> list[Array]:
        """Solve for right-hand sides given block by block, each of shape (n_i, k)."""
        forward: list[Array] = []
        for i, L in enumerate(self._L):
            b = rhs[i] if i == 0 else rhs[i] - self._Y[i - 1].T @ forward[i - 1]
            forward.append(sl.solve_triangular(L, b, lower=True, check_finite=False))
        x: list[Array] = forward
        for i in range(len(self._L) - 1, -1, -1):
            b = forward[i] if i + 1 == len(self._L) else forward[i] - self._Y[i] @ x[i + 1]
            x[i] = sl.solve_triangular(self._L[i], b, lower=True, trans="T", check_finite=False)
        return x


def chain_blocks(
    slices: Sequence[Slice], first: Array | None = None, last: Array | None = None
) -> tuple[list[Array], list[Array]]:
    """Blocks (diagonal, upper) of a chain, arguments of `BlockTridiagonal`.

    Plane i lies before piece i; `first` and `last` (n, n) are the stiffness of what lies beyond the
    end planes, added to them.
    """
    diagonal = [s.aa for s in slices] + [slices[-1].bb]
    for i in range(1, len(slices)):
        diagonal[i] = slices[i - 1].bb + slices[i].aa
    if first is not None:
        diagonal[0] = diagonal[0] + first
    if last is not None:
        diagonal[-1] = diagonal[-1] + last
    return diagonal, [s.ab for s in slices]

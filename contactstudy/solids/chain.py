"""Chains of slices: block-tridiagonal elimination and merging with dense blocks.

A prismatic or ring-shaped body is cut into slices between planes that carry the same
section mesh. A slice couples only its two planes, so the stiffness of the chain is
block-tridiagonal with dense blocks of the size of one plane.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
from scipy.linalg.lapack import dpotri

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


def inverse(A: Array, where: str) -> Array:
    """Inverse of a symmetric positive definite matrix (n, n).

    Raises
    ------
    NumericalError
        If it is not positive definite; `where` says what it is.
    """
    P, _ = dpotri(_cholesky(A, where), lower=1, overwrite_c=1)
    return np.asarray(np.tril(P) + np.tril(P, -1).T)


def taken(E: Array | sp.csr_array, P: Array) -> Array:
    """What an eliminated plane takes from the stiffness of the next one: E^T P E, P symmetric."""
    return np.asarray(E.T @ np.ascontiguousarray((E.T @ P).T))


class BlockTridiagonal:
    """Elimination of a symmetric positive definite block-tridiagonal matrix.

    Of its diagonal blocks (n_i, n_i) and the blocks (i, i+1) above them, (n_i, n_{i+1}). Both may
    be sparse but for the first: with the inverse of a pivot, n^3 operations, the next pivot costs
    of the order of n^2 only, where a Cholesky factor would fill up.

    Raises
    ------
    NumericalError
        If a pivot block is not positive definite.
    """

    def __init__(
        self,
        diagonal: Sequence[Array | sp.csr_array],
        upper: Sequence[Array | sp.csr_array],
    ) -> None:
        # P_0 = D_0^-1,  P_{i+1} = (D_{i+1} - E_i^T P_i E_i)^-1
        self._E, self._P = upper, list[Array]()
        for i, D in enumerate(diagonal):
            pivot = D - taken(upper[i - 1], self._P[-1]) if i else D
            self._P.append(inverse(pivot, f"block {i} of {len(diagonal)}"))

    def solve(self, rhs: Sequence[Array]) -> list[Array]:
        """Solve for right-hand sides given block by block, each of shape (n_i, k)."""
        x: list[Array] = []
        for i, P in enumerate(self._P):
            x.append(P @ (rhs[i] - self._E[i - 1].T @ x[-1] if i else rhs[i]))
        for i in range(len(x) - 2, -1, -1):
            x[i] = x[i] - self._P[i] @ (self._E[i] @ x[i + 1])
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

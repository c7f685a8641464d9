"""A rail cell between held end planes, its interior eliminated from both of them.

Its slices are alike, and each is its own mirror image in x but for the sign of u_x: with
``R = diag(-1 for u_x, else 1)`` ``K_bb = R K_aa R`` and ``K_ab^T = R K_ab R``. So planes that are
eliminated from the right end have the pivots of those from the left, mirrored; both meet in the
middle, and half the planes are kept.
"""

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.solids.chain import inverse, taken
from contactstudy.solids.extrusion import ExtrudedSlice


class HeldCell:
    """Elimination of the inner planes, 1 to `n_slices` - 1, of at least four equal slices.

    Attributes
    ----------
    piece : ExtrudedSlice
        One slice.
    n_slices : int
        Slices of the cell.
    mirror : ndarray (n, 1)
        The diagonal of R.
    coupling : sparse array (n, n)
        Block K_ab of a slice in N/m.

    Raises
    ------
    NumericalError
        If a pivot is not positive definite.
    """

    def __init__(self, piece: ExtrudedSlice, n_slices: int) -> None:
        self.piece, self.n_slices = piece, n_slices
        self.mirror = np.where(piece.free % 3 == 0, -1.0, 1.0)[:, None]
        self.coupling = sp.csr_array(piece.stiffness.ab)
        self._n_left = (n_slices - 1) // 2
        # P_1 = D^-1,  P_{k+1} = (D - E^T P_k E)^-1,  k counted from a held end
        D = piece.stiffness.aa + piece.stiffness.bb
        self._P: list[Array] = []
        before = last = np.zeros_like(D)
        for k in range(self._n_left):
            self._P.append(inverse(D - last, f"plane {k + 1} of {n_slices}"))
            before, last = last, taken(self.coupling, self._P[-1])
        # with an even number of inner planes the right side has one less
        right = last if n_slices % 2 == 0 else before
        middle = D - last - self.mirror * right * self.mirror.T
        self._middle = inverse(middle, f"plane {self._n_left + 1} of {n_slices}")

    def solve(self, rhs: Sequence[Array]) -> list[Array]:
        """Displacements of the inner planes under loads on them, (n, k) each."""
        R, E, m = self.mirror, self.coupling, self._n_left
        left = self._inwards(rhs[:m])
        right = self._inwards([R * b for b in rhs[:m:-1]])
        u = self._middle @ (rhs[m] - E.T @ left[-1] - R * (E.T @ right[-1]))
        self._outwards(left, u)
        self._outwards(right, R * u)
        return [*left, u, *(R * x for x in right[::-1])]

    def _inwards(self, loads: Sequence[Array]) -> list[Array]:
        """P g of each plane: g is its load and what comes from the planes before it."""
        h: list[Array] = []
        for P, load in zip(self._P, loads, strict=False):
            g = load - self.coupling.T @ h[-1] if h else load
            h.append(P @ g if g.any() else g)
        return h

    def _outwards(self, h: list[Array], u: Array) -> None:
        """Put the displacements in the place of P g; `u` is that of the middle."""
        for k in range(len(h) - 1, -1, -1):
            u = h[k] = h[k] - self._P[k] @ (self.coupling @ u)

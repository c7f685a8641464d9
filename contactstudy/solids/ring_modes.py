"""Modes of a ring of equal slices: a whole number of waves round it, one small problem each."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, BoolArray
from contactstudy.exceptions import NumericalError
from contactstudy.solids.ring import slice_mass, slice_stiffness
from contactstudy.solids.wheel_section import WheelSection

MOST_WAVES = 60
"""Waves round the ring beyond which no mode is looked for."""


@dataclass(frozen=True)
class RingFamily:
    """Modes with n waves round the ring.

    Symmetric in x they are (radial, y: v cos n theta; tangential: v sin n theta), antisymmetric
    the same turned by a quarter of a wave (v sin n theta; -v cos n theta).

    Attributes
    ----------
    waves : int
        n.
    squares : ndarray (m,)
        Squared angular natural frequencies in 1/s^2.
    vectors : ndarray (dofs of a plane, m)
        v, of any size.
    """

    waves: int
    squares: Array
    vectors: Array

    def part(self, symmetric: bool) -> "RingFamily":
        """The modes of one symmetry: without waves they are either in-plane or turning."""
        if self.waves:
            return self
        chosen = np.where(_tangential(len(self.vectors)) != symmetric, 1.0, 0.0)
        v = self.vectors * chosen[:, None]
        size = np.linalg.norm(self.vectors, axis=0)
        kept = np.linalg.norm(v, axis=0) > 0.5 * size
        return RingFamily(self.waves, self.squares[kept], v[:, kept])

    def at(self, theta: float, symmetric: bool) -> Array:
        """Displacements in the plane at an angle."""
        c, s = np.cos(self.waves * theta), np.sin(self.waves * theta)
        turning = _tangential(len(self.vectors))
        tangential, others = (s, c) if symmetric else (-c, s)
        factor = np.asarray(np.where(turning, tangential, others), dtype=float)
        return np.asarray(factor[:, None] * self.vectors)


def ring_families(
    section: WheelSection,
    free: BoolArray,
    step: float,
    material: tuple[float, float, float],
    highest: float,
) -> list[RingFamily]:
    """Modes of a ring of equal slices up to a frequency [Hz].

    Those with 0, 1, 2, ... waves, until one (beyond 1) has no mode. The `free` dofs (3n,) of a
    plane are not held; what is held must leave no rigid motion. `step` is the angle between two
    planes [rad], `material` Young's modulus in Pa, Poisson's ratio, density in kg/m^3.

    Raises
    ------
    NumericalError
        If an eigenvalue problem is not solved, or `MOST_WAVES` waves are not enough.
    """
    stiffness = slice_stiffness(section, step, material[0], material[1])
    mass = slice_mass(section, step, material[2])
    families: list[RingFamily] = []
    limit = (2 * np.pi * highest) ** 2
    for n in range(MOST_WAVES + 1):
        K, M = (_harmonic(A, n * step)[free][:, free].tocsc() for A in (stiffness, mass))
        squares, vectors = _lowest(K, M, limit)
        if n > 1 and not len(squares):
            return families
        whole = np.zeros((len(free), len(squares)))
        whole[free] = vectors
        families.append(RingFamily(n, squares, whole))
    raise NumericalError(
        f"ring modes: still below {highest:g} Hz with {MOST_WAVES} waves round the ring"
    )


def _lowest(K: sp.csc_array, M: sp.csc_array, limit: float) -> tuple[Array, Array]:
    """Eigenpairs of K v = w^2 M v with w^2 <= limit."""
    from scipy.sparse.linalg import ArpackError, eigsh

    n, count = K.shape[0], 8
    while True:
        count = min(count, n - 2)
        # a fixed start makes the same inputs give the same bytes
        try:
            squares, vectors = eigsh(K, count, M, sigma=0.0, v0=np.ones(n))
        except (ArpackError, RuntimeError) as error:
            raise NumericalError(f"ring modes: eigenvalue problem not solved ({error})") from error
        if squares.max() > limit or count == n - 2:
            below = squares <= limit
            return squares[below], vectors[:, below]
        count *= 2


def _harmonic(matrix: sp.csr_array, phase: float) -> sp.csr_array:
    """Matrix of a ring of equal slices for shapes as in `RingFamily`; `phase` = n * step.

    With the blocks A = aa + bb and B = ab of a slice, the mean over the ring of
    u_k^T A u_k + 2 u_k^T B u_{k+1} couples in-plane (p) and tangential (t) dofs by
    sin(phase) (B_pt - B_tp^T) and each with its kind by A + cos(phase) (B + B^T).
    """
    n = matrix.shape[0] // 2
    A, B = matrix[:n, :n] + matrix[n:, n:], matrix[:n, n:]
    turning = _tangential(n)
    P, T = (sp.diags_array(np.where(turning == kind, 1.0, 0.0)) for kind in (False, True))
    same = A + np.cos(phase) * (B + B.T)
    cross = np.sin(phase) * (P @ (B - B.T) @ T)
    return sp.csr_array(P @ same @ P + T @ same @ T + cross + cross.T)


def _tangential(n: int) -> BoolArray:
    """Which dofs of a plane are tangential."""
    return np.arange(n) % 3 == 2

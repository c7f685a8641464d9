"""Deflection of a beam element, clamped at both nodes, under a uniform force on part of it.

Nodal shape functions are exact for forces at the nodes. Within an element the rail also bends
and shears under the pad's pressure and under its own inertia. On a Timoshenko rail of 4 elements
a bay that is some micrometres, and a passing wheel feels it like an irregularity as long as the
element. So, as an option, elements get further dofs: the amplitudes of such shapes. They are
orthogonal in energy to the nodal shapes, and what the contact's local compliance has to add is
the clamped compliance less what the shapes already give, a residual flexibility.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from contactstudy.arrays import Array
from contactstudy.track.hermite import BeamElement


@dataclass(frozen=True)
class InnerShape:
    """Deflection of one clamped element under a uniform force.

    Parameters
    ----------
    start, stop : float
        The loaded part, 0 <= start < stop <= element.length [m].
    footprint : float
        Length over which 1 N is spread; the part on this element is start to stop [m].
    """

    element: BeamElement
    start: float
    stop: float
    footprint: float

    @cached_property
    def ends(self) -> Array:
        """Ends of up to three pieces of the element, with the force on one of them [m]."""
        length = self.element.length
        inner = [x for x in (self.start, self.stop) if 1e-9 * length < x < (1.0 - 1e-9) * length]
        return np.array([0.0, *inner, length])

    @cached_property
    def _pieces(self) -> tuple[list[BeamElement], Array]:
        """The pieces as elements, and the deflections and rotations at their ends."""
        pieces = [replace(self.element, length=float(part)) for part in np.diff(self.ends)]
        n = 2 * len(self.ends)
        K, f = np.zeros((n, n)), np.zeros(n)
        for i, piece in enumerate(pieces):
            dofs = slice(2 * i, 2 * i + 4)
            K[dofs, dofs] += piece.stiffness()
            if self._loaded(i):
                f[dofs] += piece.average_shapes(0.0, 1.0) / self.footprint
        nodal, free = np.zeros(n), slice(2, n - 2)
        nodal[free] = np.linalg.solve(K[free, free], f[free])
        return pieces, nodal

    def _loaded(self, piece: int) -> bool:
        middle = 0.5 * (self.ends[piece] + self.ends[piece + 1])
        return bool(self.start < middle < self.stop)

    def __call__(self, x: Array) -> tuple[Array, Array]:
        """Deflection [m/N] and rotation [1/N] at distances x from the element's left node."""
        x = np.asarray(x, dtype=float)
        pieces, nodal = self._pieces
        which = np.clip(np.searchsorted(self.ends, x, side="right") - 1, 0, len(pieces) - 1)
        w, theta = np.zeros_like(x), np.zeros_like(x)
        q = 1.0 / self.footprint
        EI, GA = self.element.bending_stiffness, self.element.shear_stiffness
        for i, piece in enumerate(pieces):
            here = which == i
            L, values = piece.length, nodal[2 * i : 2 * i + 4]
            s = x[here] - self.ends[i]
            w[here] = piece.deflection_shapes(s / L) @ values
            theta[here] = piece.rotation_shapes(s / L) @ values
            if self._loaded(i):
                # clamped piece under q: q s^2 (L-s)^2/(24 EI) + q s (L-s)/(2 kappa GA)
                w[here] += q * s**2 * (L - s) ** 2 / (24.0 * EI) + q * s * (L - s) / (2.0 * GA)
                theta[here] += q * s * (L - s) * (L - 2.0 * s) / (12.0 * EI)
        return w, theta

    def quadrature(self, *breaks: float) -> tuple[Array, Array]:
        """Gauss points and weights, exact for products of two shapes (degree 8 in pieces)."""
        ends = np.unique(np.concatenate((self.ends, breaks)))
        points, weights = np.polynomial.legendre.leggauss(5)
        half = 0.5 * np.diff(ends)[:, None]
        middle = 0.5 * (ends[1:] + ends[:-1])[:, None]
        return (middle + half * points).ravel(), (half * weights).ravel()


@lru_cache(maxsize=1024)
def average(shape: InnerShape, over: InnerShape) -> float:
    """Work of the force that belongs to `over` on `shape` [m/N]; symmetric in the two."""
    points, weights = shape.quadrature(over.start, over.stop)
    inside = (points > over.start) & (points < over.stop)
    return float(weights[inside] @ shape(points[inside])[0] / over.footprint)


@lru_cache(maxsize=1024)
def gram(shape: InnerShape, other: InnerShape, per_length: float, rotary: float) -> float:
    """Integral of per_length w w' + rotary theta theta' of two shapes on one element."""
    points, weights = shape.quadrature(other.start, other.stop)
    (w, theta), (w2, theta2) = shape(points), other(points)
    return float(per_length * (weights @ (w * w2)) + rotary * (weights @ (theta * theta2)))


@lru_cache(maxsize=1024)
def gram_with_nodes(shape: InnerShape, per_length: float, rotary: float) -> Array:
    """Return the same integral between a shape and the nodal shape functions, (4,)."""
    points, weights = shape.quadrature()
    w, theta = shape(points)
    xi = points / shape.element.length
    return per_length * ((weights * w) @ shape.element.deflection_shapes(xi)) + rotary * (
        (weights * theta) @ shape.element.rotation_shapes(xi)
    )

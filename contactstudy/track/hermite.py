"""Two-node beam elements: shape functions, matrices and the compliance of the clamped element.

One set of formulas serves both theories. With phi = 12 EI / (kappa G A L^2) the shape functions
are the exact static solutions of the Timoshenko element (J. S. Przemieniecki, Theory of Matrix
Structural Analysis, 1968; J. N. Reddy, Comput. Methods Appl. Mech. Eng. 149 (1997) 113);
phi = 0 makes them the cubic Hermite functions of Euler-Bernoulli's theory. Nodal dofs are
(w, theta) with theta = w' when phi = 0.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array


@dataclass(frozen=True)
class BeamElement:
    """A uniform beam element.

    Parameters
    ----------
    length : float
        L [m].
    bending_stiffness : float
        EI [N m^2].
    mass_per_length : float
        [kg/m].
    shear_stiffness : float
        kappa G A [N]; infinite for Euler-Bernoulli.
    rotary_inertia : float
        rho I [kg m]; zero for Euler-Bernoulli.
    """

    length: float
    bending_stiffness: float
    mass_per_length: float
    shear_stiffness: float = np.inf
    rotary_inertia: float = 0.0

    @property
    def phi(self) -> float:
        """Ratio of bending to shear stiffness, 12 EI / (kappa G A L^2)."""
        return 12.0 * self.bending_stiffness / (self.shear_stiffness * self.length**2)

    def deflection_shapes(self, xi: Array) -> Array:
        """Shape functions N(xi) of the deflection, xi = x/L in 0..1; shape xi.shape + (4,)."""
        xi = np.asarray(xi, dtype=float)
        L, phi = self.length, self.phi
        n1 = 1 - 3 * xi**2 + 2 * xi**3 + phi * (1 - xi)
        n2 = L * (xi - 2 * xi**2 + xi**3 + 0.5 * phi * (xi - xi**2))
        n3 = 3 * xi**2 - 2 * xi**3 + phi * xi
        n4 = L * (-(xi**2) + xi**3 - 0.5 * phi * (xi - xi**2))
        return np.stack((n1, n2, n3, n4), axis=-1) / (1.0 + phi)

    def rotation_shapes(self, xi: Array) -> Array:
        """Shape functions of the section's rotation; shape xi.shape + (4,) [1/m], [1]."""
        xi = np.asarray(xi, dtype=float)
        L, phi = self.length, self.phi
        n1 = 6.0 / L * (xi**2 - xi)
        n2 = 1 - 4 * xi + 3 * xi**2 + phi * (1 - xi)
        n4 = -2 * xi + 3 * xi**2 + phi * xi
        return np.stack((n1, n2, -n1, n4), axis=-1) / (1.0 + phi)

    def stiffness(self) -> Array:
        """Stiffness matrix (4, 4), bending and shear."""
        L, phi = self.length, self.phi
        a, b = (4.0 + phi) * L**2, (2.0 - phi) * L**2
        k = np.array(
            [
                [12.0, 6 * L, -12.0, 6 * L],
                [6 * L, a, -6 * L, b],
                [-12.0, -6 * L, 12.0, -6 * L],
                [6 * L, b, -6 * L, a],
            ]
        )
        return self.bending_stiffness / (L**3 * (1.0 + phi)) * k

    def mass(self) -> Array:
        """Consistent mass matrix (4, 4), with rotary inertia."""
        # M = int rho A N^T N + rho I Nth^T Nth dx
        translation = self.mass_per_length * self.gram(self.deflection_shapes)
        return translation + self.rotary_inertia * self.gram(self.rotation_shapes)

    def foundation(self) -> Array:
        """Integral of N^T N over the element, (4, 4) [m]: a uniform foundation of unit value."""
        return self.gram(self.deflection_shapes)

    def gram(self, shapes: Callable[[Array], Array]) -> Array:
        """Integral over the element of the outer product of shape functions, (4, 4)."""
        # products of two cubics: four Gauss points integrate degree 7 exactly
        points, weights = np.polynomial.legendre.leggauss(4)
        n = shapes(0.5 * (1.0 + points))
        return 0.5 * self.length * np.einsum("g,gi,gj->ij", weights, n, n)

    def average_shapes(self, xi_from: float, xi_to: float) -> Array:
        """Integral of N over part of the element, (4,) [m]."""
        points, weights = np.polynomial.legendre.leggauss(2)
        half = 0.5 * (xi_to - xi_from)
        n = self.deflection_shapes(0.5 * (xi_from + xi_to) + half * points)
        return half * self.length * weights @ n

    def clamped_compliance(self, xi: Array) -> Array:
        """Deflection under a unit force of the element clamped at both nodes [m/N].

        It is what the shape functions leave out at the load. For Euler-Bernoulli's theory it is
        a^3 b^3 / (3 EI L^3); in general the two cantilevers of lengths a and b that meet at the
        load act in parallel, with bending and shear.
        """
        xi = np.clip(np.asarray(xi, dtype=float), 0.0, 1.0)
        a, b = xi * self.length, (1.0 - xi) * self.length
        inside = (a > 0.0) & (b > 0.0)
        a, b = np.where(inside, a, 1.0), np.where(inside, b, 1.0)
        ww, wt, th = np.zeros_like(xi), np.zeros_like(xi), np.zeros_like(xi)
        for arm, sign in ((a, 1.0), (b, -1.0)):
            # tip stiffness of a cantilever, EI/(l^3 (1+phi)) [[12, -6l], [-6l, (4+phi) l^2]]
            phi = 12.0 * self.bending_stiffness / (self.shear_stiffness * arm**2)
            factor = self.bending_stiffness / (arm**3 * (1.0 + phi))
            ww = ww + 12.0 * factor
            wt = wt - sign * 6.0 * arm * factor
            th = th + (4.0 + phi) * arm**2 * factor
        # eliminate the rotation at the load: 1/c = k_ww - k_wt^2 / k_tt
        return np.where(inside, 1.0 / (ww - wt**2 / th), 0.0)

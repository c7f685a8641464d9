"""Natural frequencies of a thin annular disc clamped at its bore, in closed form.

Waves in the plane: A. W. Leissa, Vibration of Plates, NASA SP-160 (1969), and the equations of
plane stress. Bending: Kirchhoff's plate, the same source.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.special import iv, ivp, jv, jvp, kv, kvp, yv, yvp


@dataclass(frozen=True)
class Annulus:
    """Disc of radii `inner` and `outer` and a thickness in m, of E (Pa), nu, density (kg/m^3)."""

    inner: float = 0.129
    outer: float = 0.430
    thickness: float = 0.0043
    youngs_modulus: float = 210e9
    poisson_ratio: float = 0.3
    density: float = 7850.0

    def torsion(self) -> float:
        """Lowest frequency in Hz of turning about the axis; exact at any thickness.

        u = J1(kr) Y1(ka) - Y1(kr) J1(ka); free edge u' - u/r = 0 at b, so
        J2(kb) Y1(ka) - Y2(kb) J1(ka) = 0; omega = k sqrt(G/rho).
        """
        a, b = self.inner, self.outer
        k = _first_root(
            lambda k: jv(2, k * b) * yv(1, k * a) - yv(2, k * b) * jv(1, k * a), 10.0 / b
        )
        shear = self.youngs_modulus / (2 * (1 + self.poisson_ratio))
        return float(k * np.sqrt(shear / self.density) / (2 * np.pi))

    def breathing(self) -> float:
        """Lowest frequency in Hz of radial motion without waves, plane stress.

        u as in `torsion`; free edge u' + nu u/r = 0; omega = k sqrt(E/(rho (1 - nu^2))).
        """
        a, b, nu = self.inner, self.outer, self.poisson_ratio

        def edge(k: float) -> float:
            u = jv(1, k * b) * yv(1, k * a) - yv(1, k * b) * jv(1, k * a)
            slope = jvp(1, k * b) * yv(1, k * a) - yvp(1, k * b) * jv(1, k * a)
            return float(k * slope + nu * u / b)

        speed = np.sqrt(self.youngs_modulus / (self.density * (1 - nu**2)))
        return float(_first_root(edge, 10.0 / b) * speed / (2 * np.pi))

    def bending(self, waves: int) -> float:
        """Lowest frequency in Hz of bending with n waves round the disc.

        W = A Jn + B Yn + C In + D Kn of kr with W = W' = 0 at the bore and, at the free edge,
        W'' + nu (W'/r - n^2 W/r^2) = 0 and (lap W)' - (1 - nu) n^2/r^2 (W' - W/r) = 0;
        omega = k^2 sqrt(D/(rho h)), D = E h^3 / (12 (1 - nu^2)).
        """
        n, nu, a, b = waves, self.poisson_ratio, self.inner, self.outer

        def determinant(k: float) -> float:
            rows = np.zeros((4, 4))
            kinds = ((jv, jvp, -1.0), (yv, yvp, -1.0), (iv, ivp, 1.0), (kv, kvp, 1.0))
            for i, (f, df, sign) in enumerate(kinds):
                w, w1, w2 = f(n, k * b), k * df(n, k * b), k**2 * df(n, k * b, 2)
                rows[:, i] = [
                    f(n, k * a),
                    k * df(n, k * a),
                    w2 + nu * (w1 / b - n**2 * w / b**2),
                    # lap W = -k^2 W or k^2 W
                    sign * k**2 * w1 - (1 - nu) * n**2 / b**2 * (w1 - w / b),
                ]
            return float(np.linalg.det(rows / np.abs(rows).max(axis=1, keepdims=True)))

        k = _first_root(determinant, 20.0 / b)
        h = self.thickness
        rigidity = self.youngs_modulus * h**3 / (12 * (1 - nu**2))
        return float(k**2 * np.sqrt(rigidity / (self.density * h)) / (2 * np.pi))


def _first_root(f: Callable[[float], float], highest: float) -> float:
    k = np.linspace(highest / 200, highest, 400)
    values = np.array([f(float(x)) for x in k])
    first = int(np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))[0])
    return float(brentq(f, k[first], k[first + 1], xtol=1e-14))

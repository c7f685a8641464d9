"""Time integrators of the generalised-alpha family, each declaring its order.

M a(n+1-am) + C v(n+1-af) + K u(n+1-af) = f(n+1-af), with x(n+1-al) = (1-al) x(n+1) + al x(n),
on Newmark's kinematics

    u(n+1) = u + dt v + dt^2 ((1/2 - beta) a + beta a(n+1))
    v(n+1) = v + dt ((1 - gamma) a + gamma a(n+1)).

N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67; J. Chung and G. M. Hulbert, J. Appl. Mech.
60 (1993) 371.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.exceptions import InputError

STEPS_A_PERIOD = 8
"""Fewest time steps a period that are not warned of.

Average acceleration turns an oscillation of omega by 2 atan(omega dt/2) a step, so that its period
grows by (omega dt)^2/12: 5 % at 8 steps, 20 % at 4. Below two steps it is taken for a slower one.
"""


@dataclass(frozen=True)
class Integrator:
    """One member of the family, of an order in time; make it with the functions below."""

    name: str
    beta: float
    gamma: float
    alpha_m: float
    alpha_f: float
    order: int

    def kinematics(self, dt: float) -> tuple[float, float, float, float, float, float]:
        """Coefficients of Newmark's kinematics with the new displacements as unknowns.

        Returns
        -------
        c0, c2, c3 : float
            a(n+1) = c0 (u(n+1) - u) + c2 v + c3 a.
        d0, d2, d3 : float
            v(n+1) = d0 (u(n+1) - u) + d2 v + d3 a.
        """
        beta, gamma = self.beta, self.gamma
        c0, c2, c3 = 1.0 / (beta * dt**2), -1.0 / (beta * dt), 1.0 - 1.0 / (2.0 * beta)
        return c0, c2, c3, gamma * dt * c0, 1.0 + gamma * dt * c2, dt * (1.0 - gamma + gamma * c3)

    def factor(self, system: LinearSystem, dt: float) -> Factor:
        """Factor of S of a step dt [s], with the new accelerations as unknowns."""
        spread = system.dampers
        if spread is not None:
            spread = np.sqrt((1.0 - self.alpha_f) * self.gamma * dt) * spread
        return Factor(self.matrix(system, dt), spread)

    def matrix(self, system: LinearSystem, dt: float) -> sp.csr_array:
        """S (n, n) of that step, without the system's `dampers`."""
        # S = (1-am) M + (1-af) gamma dt C + (1-af) beta dt^2 K
        left = 1.0 - self.alpha_f
        of_a = left * self.gamma * dt, left * (self.beta * dt**2)
        return system.combine(1.0 - self.alpha_m, *of_a)

    @property
    def constraint_radius(self) -> float:
        """Spectral radius of the response to a displacement that is prescribed every step.

        Below 1, an error in the acceleration or in the force of a rigid constraint dies out. For
        average acceleration it is 1 with a double root: there such errors grow linearly.
        """
        # u(n) = 0 for all n leaves (v, a) -> matrix (v, a), here with dt = 1
        _, c2, c3, _, d2, d3 = self.kinematics(1.0)
        matrix = np.array([[d2, d3], [c2, c3]])
        # and the force averaged by alpha_f: (1 - af) lambda(n+1) + af lambda(n) = given
        force = self.alpha_f / (1.0 - self.alpha_f)
        return float(max(np.abs(np.linalg.eigvals(matrix)).max(), force))


def average_acceleration() -> Integrator:
    """Newmark's method with beta = 1/4, gamma = 1/2: no numerical damping, conserves energy."""
    return Integrator("average acceleration", 0.25, 0.5, 0.0, 0.0, order=2)


def newmark(beta: float, gamma: float) -> Integrator:
    """Newmark's method; first order when gamma > 1/2.

    Raises
    ------
    InputError
        If the method is not unconditionally stable, 2 beta >= gamma >= 1/2.
    """
    if not 2.0 * beta >= gamma >= 0.5:
        raise InputError(
            f"newmark(beta = {beta:g}, gamma = {gamma:g}): must satisfy 2 beta >= gamma >= 1/2,"
            " or the method is not unconditionally stable"
        )
    order = 2 if gamma == 0.5 else 1
    return Integrator(f"Newmark (beta {beta:g}, gamma {gamma:g})", beta, gamma, 0.0, 0.0, order)


def generalised_alpha(spectral_radius: float = 0.8) -> Integrator:
    """Generalised-alpha method of Chung and Hulbert.

    The spectral radius is that at infinite frequency; 1 has no numerical damping.

    Raises
    ------
    InputError
        If the spectral radius is outside 0..1.
    """
    rho = spectral_radius
    if not 0.0 <= rho <= 1.0:
        raise InputError(f"generalised_alpha spectral_radius = {rho:g}: must lie between 0 and 1")
    alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    beta = 0.25 * (1.0 - alpha_m + alpha_f) ** 2
    name = f"generalised alpha (spectral radius {rho:g})"
    return Integrator(name, beta, gamma, alpha_m, alpha_f, order=2)

"""Energies of a linear system, for balances over its states."""

from collections.abc import Iterable
from dataclasses import dataclass

import scipy.sparse as sp

from contactstudy.arrays import Array
from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.stepper import State


@dataclass(frozen=True)
class EnergyBalance:
    """Energies over a run [J].

    Parameters
    ----------
    work : float
        Of external and contact forces.
    kinetic, strain : float
        Changes from the first to the last state.
    dissipated : float
        In the dampers.
    """

    work: float
    kinetic: float
    strain: float
    dissipated: float

    @property
    def residual(self) -> float:
        """Work less what became of it; rounding only, for average acceleration."""
        return self.work - self.kinetic - self.strain - self.dissipated


def energy_balance(system: LinearSystem, states: Iterable[State]) -> EnergyBalance:
    """Energies over consecutive states, one at least.

    Work and dissipation are trapezoidal sums, du (f(n) + f(n+1))/2 and du C (v(n) + v(n+1))/2.
    With average acceleration they balance kinetic and strain energy exactly:
    M (a(n) + a(n+1))/2 = M dv/dt and du = dt (v(n) + v(n+1))/2.
    """
    following = iter(states)
    first = last = next(following)
    work = dissipated = 0.0
    for state in following:
        du = state.u - last.u
        work += 0.5 * float(du @ (last.load + state.load))
        v = last.v + state.v
        dissipated += 0.5 * float(du @ (system.damping @ v))
        if (G := system.dampers) is not None:
            dissipated += 0.5 * float((G @ du) @ (G @ v))
        last = state
    M, K = system.mass, system.stiffness
    kinetic = _quadratic(M, last.v) - _quadratic(M, first.v)
    strain = _quadratic(K, last.u) - _quadratic(K, first.u)
    return EnergyBalance(work, kinetic, strain, dissipated)


def _quadratic(matrix: sp.csr_array, x: Array) -> float:
    return 0.5 * float(x @ (matrix @ x))

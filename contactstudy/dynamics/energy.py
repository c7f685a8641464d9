"""Energies of a linear system, for balances over its states."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

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
    """Sum up the energies over consecutive states.

    Work and dissipation are trapezoidal sums, du (f(n) + f(n+1))/2 and du C (v(n) + v(n+1))/2.
    With average acceleration they balance kinetic and strain energy exactly:
    M (a(n) + a(n+1))/2 = M dv/dt and du = dt (v(n) + v(n+1))/2.
    """
    work = dissipated = 0.0
    first = before = None
    for state in states:
        if first is None or before is None:
            first = before = state
            continue
        du = state.u - before.u
        work += 0.5 * float(du @ (before.load + state.load))
        dissipated += 0.5 * float(du @ (system.damping @ (before.v + state.v)))
        before = state
    if first is None or before is None:
        return EnergyBalance(0.0, 0.0, 0.0, 0.0)
    return EnergyBalance(
        work=work,
        kinetic=_quadratic(system.mass, before.v) - _quadratic(system.mass, first.v),
        strain=_quadratic(system.stiffness, before.u) - _quadratic(system.stiffness, first.u),
        dissipated=dissipated,
    )


def _quadratic(matrix: sp.csr_array, x: np.ndarray) -> float:
    return 0.5 * float(x @ (matrix @ x))

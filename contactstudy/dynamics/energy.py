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


class EnergyMeter:
    """Sums up the energies over consecutive states.

    Work and dissipation are trapezoidal sums, du (f(n) + f(n+1))/2 and du C (v(n) + v(n+1))/2.
    With average acceleration they balance kinetic and strain energy exactly:
    M (a(n) + a(n+1))/2 = M dv/dt and du = dt (v(n) + v(n+1))/2.

    Parameters
    ----------
    system : LinearSystem
    """

    def __init__(self, system: LinearSystem) -> None:
        self._system = system
        self._first: State | None = None
        self._last: State | None = None
        self._work = self._dissipated = 0.0

    def see(self, state: State) -> None:
        """Go on to a state."""
        before, self._last = self._last, state
        if before is None:
            self._first = state
            return
        du = state.u - before.u
        self._work += 0.5 * float(du @ (before.load + state.load))
        self._dissipated += 0.5 * float(du @ (self._system.damping @ (before.v + state.v)))

    @property
    def balance(self) -> EnergyBalance:
        """From the first state seen to the last."""
        if self._first is None or self._last is None:
            return EnergyBalance(0.0, 0.0, 0.0, 0.0)
        first, last = self._first, self._last
        M, K = self._system.mass, self._system.stiffness
        return EnergyBalance(
            work=self._work,
            kinetic=_quadratic(M, last.v) - _quadratic(M, first.v),
            strain=_quadratic(K, last.u) - _quadratic(K, first.u),
            dissipated=self._dissipated,
        )


def energy_balance(system: LinearSystem, states: Iterable[State]) -> EnergyBalance:
    """Energies over consecutive states, see `EnergyMeter`."""
    meter = EnergyMeter(system)
    for state in states:
        meter.see(state)
    return meter.balance


def _quadratic(matrix: sp.csr_array, x: Array) -> float:
    return 0.5 * float(x @ (matrix @ x))

"""The static start: wheels at rest on the track, every spring and contact in equilibrium."""

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.stepper import ContactStep, Coupling, State
from contactstudy.exceptions import NumericalError

_LOWERED, _LOWEST = 20e-6, 5e-3
"""m: by which a wheel that touches nothing is lowered at a time, and in all."""
_LEAST = 1e-6
"""N: load against which springs count as carrying nothing; lateral contact starts with none."""


def static_start(
    system: LinearSystem, coupling: Coupling, external: Array, wheel_dofs: IntArray
) -> State:
    """Equilibrium with the contact at step 0: K u = external + B^T lambda(u), at rest.

    A vehicle on its own has rigid modes, so K is singular. Springs under the wheels make it
    regular; their feet z are moved until the springs carry no force (Broyden's method, exact
    after two moves for one wheel and a linear law). So any law, any number of wheels and any
    vehicle start in equilibrium, with the resultants that statics asks for.

    Raises
    ------
    NumericalError
        If K is singular for another reason than free wheels, a wheel finds nothing to stand on, or
        no equilibrium is found.
    """
    n, kappa = system.n_dofs, 1e9  # N/m of each spring under a wheel
    springs = np.zeros(n)
    springs[wheel_dofs] = kappa
    factor = Factor(system.stiffness + sp.diags_array(springs))
    attached, before_touch = coupling.attached(factor, 1.0), coupling.start()

    def spring_forces(feet: Array) -> tuple[Array, Array, ContactStep]:
        load = np.array(external, dtype=float)
        load[wheel_dofs] += kappa * feet
        u_free = factor.solve(load)
        contact = attached(0, u_free, before_touch)
        u = u_free + contact.increment
        return kappa * (u[wheel_dofs] - feet), u, contact

    feet = np.zeros(len(wheel_dofs))
    inverse = -np.eye(len(wheel_dofs)) / kappa  # of d(force)/d(feet), exact for a rigid vehicle
    force, u, contact = spring_forces(feet)
    # the bodies may touch only after they have come down: an open gap tells nothing of how far
    for _ in range(round(_LOWEST / _LOWERED)):
        idle = contact.load[wheel_dofs] <= 0.0
        if not idle.any():
            break
        feet = feet - _LOWERED * idle
        force, u, contact = spring_forces(feet)
    else:
        raise NumericalError(
            f"no static equilibrium at the start: a wheel {1e3 * _LOWEST:g} mm below its place on "
            "the undeformed rail still carries nothing"
        )
    for _ in range(100):
        scale = max(np.abs(external).max(), np.abs(contact.load).max(), _LEAST)
        if np.abs(force).max() <= coupling.accuracy * scale:
            rest = np.zeros(n)
            return State(0, 0.0, u, rest, rest, external + contact.load, contact)
        move = -inverse @ force
        feet = feet + move
        before = force
        force, u, contact = spring_forces(feet)
        if not np.all(np.isfinite(force)):
            break
        # Broyden's update keeps inverse @ (change of force) = move
        along = inverse @ (force - before)
        inverse = inverse + np.outer(move - along, move @ inverse) / (move @ along)
    raise NumericalError(
        "no static equilibrium found at the start:"
        f" {np.abs(force).max():.3g} N left under a wheel with {scale:.3g} N to carry"
    )

"""The static start: wheels at rest on the track, every spring and contact in equilibrium."""

import numpy as np
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.stepper import (
    AttachedCoupling,
    ContactStep,
    Coupling,
    SharedCompliance,
    State,
)
from contactstudy.exceptions import NumericalError

_LOWERED, _LOWEST = 20e-6, 5e-3
"""m: by which a wheel that touches nothing is lowered at a time, and in all."""
_GIVE = 1e-10
"""m/N: give of a contact in the first guess, where two wheels of one body stand on rigid ground."""
_SPRING = 1e9
"""N/m: of each spring under a wheel."""
_LEAST = 1e-6
"""N: load against which springs count as carrying nothing; lateral contact starts with none."""


def static_start(
    system: LinearSystem,
    coupling: Coupling,
    external: Array,
    wheels: tuple[IntArray, Array],
    held: Factor | None = None,
) -> State:
    """Equilibrium with the contact at step 0: K u = external + B^T lambda(u), at rest.

    A vehicle on its own has rigid modes, so K is singular. Springs under the wheels make it
    regular; their feet z are moved until the springs carry no force, by Broyden's method, which
    starts from the compliance of the track below the wheels. So any law, any number of wheels and
    any vehicle start in equilibrium, with the resultants that statics asks for.

    Parameters
    ----------
    wheels : tuple of ndarray
        Dofs and weights (nc, j) of the vehicle's displacement at each contact.
    held : Factor, optional
        `held_by_springs`, if it is at hand.

    Raises
    ------
    NumericalError
        If K is singular for another reason than free wheels, a wheel finds nothing to stand on, or
        no equilibrium is found.
    """
    n, kappa = system.n_dofs, _SPRING
    G = _written_out(*wheels, n)
    pressed = G @ external < 0.0
    factor = held_by_springs(system, wheels) if held is None else held
    attached, before_touch = coupling.attached(factor, 1.0), coupling.start()

    def spring_forces(feet: Array) -> tuple[Array, Array, ContactStep]:
        load = external + kappa * (G.T @ feet)
        u_free = factor.solve(load)
        contact = attached(0, u_free, before_touch)
        u = u_free + contact.increment
        return kappa * (G @ u - feet), u, contact

    feet = np.zeros(len(wheels[0]))
    inverse = _first_inverse(attached, factor, G, kappa)
    force, u, contact = spring_forces(feet)
    # the bodies may touch only after they have come down: an open gap tells nothing of how far
    for _ in range(round(_LOWEST / _LOWERED)):
        idle = pressed & (np.asarray(contact.record["contact_force"]) <= 0.0)
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


def held_by_springs(system: LinearSystem, wheels: tuple[IntArray, Array]) -> Factor:
    """Factor of the stiffness with a spring under each wheel, see `static_start`."""
    G = _written_out(*wheels, system.n_dofs)
    return Factor(system.stiffness + _SPRING * (G.T @ G))


def _first_inverse(
    attached: AttachedCoupling, factor: Factor, G: sp.csr_array, kappa: float
) -> Array:
    """Inverse of d(force)/d(feet), but for the contacts' own give; exact for a rigid vehicle.

    With the feet z and P = kappa G A^-1 G^T the wheels move by P dz without contact; the contact
    forces, on the compliance W, move by dl = -W^-1 P dz, and the springs' forces by
    kappa (P - 1) dz + P dl. A coupling that does not tell W has one wheel, on hard ground.
    """
    one = np.eye(G.shape[0])
    if not isinstance(attached, SharedCompliance):
        return -one / kappa
    P = kappa * (G @ factor.solve(G.T.toarray()))
    W = attached.compliance(0) + _GIVE * one
    return np.asarray(np.linalg.inv(kappa * (P - one) - P @ np.linalg.solve(W, P)))


def _written_out(dofs: IntArray, weights: Array, n: int) -> sp.csr_array:
    rows = np.repeat(np.arange(len(dofs)), dofs.shape[1])
    return sp.csr_array((weights.ravel(), (rows, dofs.ravel())), shape=(len(dofs), n))

"""The time stepper: a linear system in contact, as a generator of states.

Everything linear is factored once. With S = (1-am)/(beta dt^2) M + (1-af) gamma/(beta dt) C
+ (1-af) K a step is

    u(n+1) = u* + (1-af) S^-1 B^T lambda(n+1),

where the free response u* follows from the state before and the external load, and lambda are
the contact forces on the gap rows B (+1 on the wheel, minus the rail's row). A contact law, a
`Coupling`, never sees the track: it gets u* and returns the load B^T lambda and the increment.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contactstudy.compiled import compiled
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.integrators import (
    Integrator,
    average_acceleration,
    generalised_alpha,
    newmark,
)
from contactstudy.dynamics.windows import add_product, windows
from contactstudy.exceptions import NumericalError
from contactstudy.validation import positive, raise_if

__all__ = [
    "ContactStep",
    "Coupling",
    "Integrator",
    "State",
    "average_acceleration",
    "generalised_alpha",
    "march",
    "newmark",
]


@dataclass(frozen=True)
class ContactStep:
    """What the contact does in one step.

    Parameters
    ----------
    load : ndarray
        (n,) generalised force B^T lambda of all contacts on the system [N].
    increment : ndarray
        (n,) scale * S^-1 load, the change of the free displacements.
    record : mapping
        What is worth keeping, under the names of the dataset's variables: "contact_force"
        (nw,) always [N]; whatever else the law knows.
    """

    load: np.ndarray
    increment: np.ndarray
    record: Mapping[str, np.ndarray | float]


class Coupling(Protocol):
    """A contact law joined to the moving wheel positions, known for every step."""

    def attach(self, factor: Factor, scale: float) -> None:
        """Take the factor of the system that the next calls belong to.

        Called once before the static start (stiffness with auxiliary springs under the wheels,
        scale 1) and once before the first step (S, scale 1 - alpha_f).
        """

    def __call__(self, step: int, u_free: np.ndarray) -> ContactStep:
        """Contact at the end of a step.

        Parameters
        ----------
        step : int
            0 is the start (asked several times by the static start), then 1, 2, ...
        u_free : ndarray
            (n,) displacements at the end of the step if there were no contact. The coupling
            returns the load that is in equilibrium with `u_free + increment`.
        """


@dataclass(frozen=True)
class State:
    """All that is known at the end of a step.

    Parameters
    ----------
    step : int
    time : float
        Since the start [s].
    u, v, a : ndarray
        (n,) displacements, velocities and accelerations.
    load : ndarray
        (n,) total load, external and contact.
    contact : ContactStep or None
    """

    step: int
    time: float
    u: np.ndarray
    v: np.ndarray
    a: np.ndarray
    load: np.ndarray
    contact: ContactStep | None = None


def march(
    system: LinearSystem,
    coupling: Coupling | None,
    start: State,
    dt: float,
    n_steps: int,
    integrator: Integrator,
    external: np.ndarray | Callable[[int], np.ndarray],
    position: Callable[[int], float] | None = None,
) -> Iterator[State]:
    """Step through time; yields the states after steps 1 .. n_steps.

    Parameters
    ----------
    system : LinearSystem
    coupling : Coupling or None
        None: no contact.
    start : State
        At step 0, with accelerations and load that satisfy the equation of motion.
    dt : float
        [s].
    n_steps : int
    integrator : Integrator
    external : ndarray or callable
        (n,) constant load, or the load at the end of each step.
    position : callable, optional
        Position of the leading wheel at a step, for the message when something breaks down.

    Raises
    ------
    InputError
        For a time step that is not positive.
    NumericalError
        If S cannot be factored or a state is not finite; says at which step.
    """
    raise_if(positive("time step", dt, "s"))
    alpha_m, alpha_f = integrator.alpha_m, integrator.alpha_f
    wm, wf = 1.0 - alpha_m, 1.0 - alpha_f
    c0, c2, c3, d0, d2, d3 = integrator.kinematics(dt)
    factor = Factor(system.combine(wm * c0, wf * d0, wf))
    if coupling is not None:
        coupling.attach(factor, wf)
    mass, damping, stiffness = map(windows, (system.mass, system.damping, system.stiffness))
    # S u* = (1-af) f_ext(n+1) + af f(n) + M(...) + C(...) + K(...), each (...) = (c u + d v + e a)
    of_mass = np.array([wm * c0, -wm * c2, -wm * c3 - alpha_m])
    of_damping = np.array([wf * d0, -wf * d2 - alpha_f, -wf * d3])
    of_stiffness = np.array([-alpha_f, 0.0, 0.0])
    load_at = external if callable(external) else lambda step: external
    u, v, a, load = start.u, start.v, start.a, start.load
    for step in range(1, n_steps + 1):
        ext = load_at(step)
        rhs = wf * ext
        add_product(*mass, of_mass, u, v, a, rhs)
        add_product(*damping, of_damping, u, v, a, rhs)
        if alpha_f != 0.0:
            rhs += alpha_f * load
            add_product(*stiffness, of_stiffness, u, v, a, rhs)
        u_new = factor.solve(rhs)
        contact = None
        load = ext
        if coupling is not None:
            contact = coupling(step, u_new)
            u_new = u_new + contact.increment
            load = ext + contact.load
        v_new, a_new = np.empty_like(u), np.empty_like(u)
        finite = _advance(c0, c2, c3, d0, d2, d3, u, v, a, u_new, v_new, a_new)
        if not finite:
            where = f" (wheel at X = {position(step):.3f} m)" if position else ""
            raise NumericalError(
                f"the state is not finite after step {step} of {n_steps},"
                f" t = {step * dt:.6g} s{where}"
            )
        u, v, a = u_new, v_new, a_new
        yield State(step, step * dt, u, v, a, load, contact)


@compiled
def _advance(
    c0: float,
    c2: float,
    c3: float,
    d0: float,
    d2: float,
    d3: float,
    u: np.ndarray,
    v: np.ndarray,
    a: np.ndarray,
    u_new: np.ndarray,
    v_new: np.ndarray,
    a_new: np.ndarray,
) -> bool:
    """Newmark's kinematics; False if the new state is not finite."""
    total = 0.0
    for i in range(len(u)):
        moved = u_new[i] - u[i]
        a_new[i] = c0 * moved + c2 * v[i] + c3 * a[i]
        v_new[i] = d0 * moved + d2 * v[i] + d3 * a[i]
        total += a_new[i] * 0.0  # 0 as long as all are finite
    return total == 0.0

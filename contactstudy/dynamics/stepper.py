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
from typing import Any, Protocol, runtime_checkable

import numpy as np

from contactstudy.arrays import Array
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
    "AttachedCoupling",
    "ContactStep",
    "Coupling",
    "Integrator",
    "SharedCompliance",
    "State",
    "Steps",
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
    load : ndarray (n,)
        Generalised force B^T lambda of all contacts on the system [N].
    increment : ndarray (n,)
        scale * S^-1 load, the change of the free displacements.
    record : mapping
        What is worth keeping, under the names of the dataset's variables: "contact_force"
        (nw,) always [N]; whatever else the law knows.
    state
        Contact state at the end of the step, whatever the coupling needs of it in the next;
        None for a law without memory.
    """

    load: Array
    increment: Array
    record: Mapping[str, Array | float]
    state: Any = None


class AttachedCoupling(Protocol):
    """A coupling that knows the compliance of the system on which its forces act."""

    def __call__(self, step: int, u_free: Array, state: Any) -> ContactStep:
        """Contact at the end of a step; asked twice, it answers the same.

        Parameters
        ----------
        step : int
            0 is the start, then 1, 2, ...
        u_free : ndarray (n,)
            Displacements at the end of the step if there were no contact. The coupling
            returns the load that is in equilibrium with `u_free + increment`.
        state
            Contact state at the end of the step before.
        """


@runtime_checkable
class SharedCompliance(Protocol):
    """An attached coupling that tells how its contacts move each other."""

    def compliance(self, step: int) -> Array:
        """(nc, nc) growth of the gaps at a step for unit contact forces [m/N]."""


class Coupling(Protocol):
    """A contact law joined to the moving wheel positions, known for every step."""

    @property
    def accuracy(self) -> float:
        """How accurately the forces fulfil the law, relative to the largest."""

    def start(self) -> Any:
        """Contact state before anything has touched."""

    def attached(self, factor: Factor, scale: float) -> AttachedCoupling:
        """Join to a system with the compliance scale * S^-1, S given by its factor.

        The static start uses one (stiffness with auxiliary springs under the wheels, scale 1),
        the march another (scale 1 - alpha_f).
        """


@dataclass(frozen=True)
class State:
    """All that is known at the end of a step: time since the start [s], motion, total load (n,)."""

    step: int
    time: float
    u: Array
    v: Array
    a: Array
    load: Array
    contact: ContactStep | None = None


@dataclass(frozen=True)
class Steps:
    """Equal steps of a length [s], positive.

    A message about a breakdown names X [m] of the leading wheel if its position is given.
    """

    length: float
    count: int
    position: Callable[[int], float] | None = None

    def __post_init__(self) -> None:
        raise_if(positive("time step", self.length, "s"))


def march(
    system: LinearSystem,
    coupling: Coupling | None,
    start: State,
    steps: Steps,
    integrator: Integrator,
    external: Array | Callable[[int], Array],
) -> Iterator[State]:
    """Step through time; yields the states after steps 1, 2, ...

    Parameters
    ----------
    start : State
        At step 0, with accelerations and load that satisfy the equation of motion.
    external : ndarray or callable
        (n,) constant load, or the load at the end of each step.

    Raises
    ------
    NumericalError
        If S cannot be factored or a state is not finite; says at which step.
    """
    dt = steps.length
    alpha_m, alpha_f = integrator.alpha_m, integrator.alpha_f
    wm, wf = 1.0 - alpha_m, 1.0 - alpha_f
    kinematics = c0, c2, c3, d0, d2, d3 = integrator.kinematics(dt)
    factor = Factor(system.combine(wm * c0, wf * d0, wf))
    attached = contact_state = None
    if coupling is not None:
        attached = coupling.attached(factor, wf)
        contact_state = start.contact.state if start.contact else coupling.start()
    mass, damping, stiffness = map(windows, (system.mass, system.damping, system.stiffness))
    # S u* = (1-af) f_ext(n+1) + af f(n) + M(...) + C(...) + K(...), each (...) = (c u + d v + e a)
    of_mass = np.array([wm * c0, -wm * c2, -wm * c3 - alpha_m])
    of_damping = np.array([wf * d0, -wf * d2 - alpha_f, -wf * d3])
    of_stiffness = np.array([-alpha_f, 0.0, 0.0])
    load_at = external if callable(external) else lambda step: external
    u, v, a, load = start.u, start.v, start.a, start.load
    for step in range(1, steps.count + 1):
        ext = load_at(step)
        rhs = wf * ext
        add_product(mass, of_mass, (u, v, a), rhs)
        add_product(damping, of_damping, (u, v, a), rhs)
        if alpha_f != 0.0:
            rhs += alpha_f * load
            add_product(stiffness, of_stiffness, (u, v, a), rhs)
        u_new = factor.solve(rhs)
        contact, load = None, ext
        if attached is not None:
            contact = attached(step, u_new, contact_state)
            contact_state = contact.state
            u_new = u_new + contact.increment
            load = ext + contact.load
        v_new, a_new = np.empty_like(u), np.empty_like(u)
        if not _advance(kinematics, (u, v, a), (u_new, v_new, a_new)):
            where = f" (wheel at X = {steps.position(step):.3f} m)" if steps.position else ""
            raise NumericalError(
                f"the state is not finite after step {step} of {steps.count},"
                f" t = {step * dt:.6g} s{where}"
            )
        u, v, a = u_new, v_new, a_new
        yield State(step, step * dt, u, v, a, load, contact)


@compiled
def _advance(
    coefficients: tuple[float, float, float, float, float, float],
    old: tuple[Array, Array, Array],
    new: tuple[Array, Array, Array],
) -> bool:
    """Newmark's kinematics; False if the new state is not finite."""
    c0, c2, c3, d0, d2, d3 = coefficients
    (u, v, a), (u_new, v_new, a_new) = old, new
    total = 0.0
    for i in range(len(u)):
        moved = u_new[i] - u[i]
        a_new[i] = c0 * moved + c2 * v[i] + c3 * a[i]
        v_new[i] = d0 * moved + d2 * v[i] + d3 * a[i]
        total += a_new[i] * 0.0  # 0 as long as all are finite
    return total == 0.0

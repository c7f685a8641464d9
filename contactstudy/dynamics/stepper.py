"""The time stepper: a linear system in contact, as a generator of states.

Newmark's kinematics are u(n+1) = u~ + beta dt^2 a(n+1) and v(n+1) = v~ + gamma dt a(n+1), with what
follows from the state before in u~ and v~. Everything linear is factored once: with
S = (1-am) M + (1-af) (gamma dt C + beta dt^2 K) a step is

    a(n+1) = a* + (1-af) S^-1 B^T lambda(n+1),

where the free response a* follows from the state before and the external load, and lambda are
the contact forces on the gap rows B (+1 on the wheel, minus the rail's row). A contact law, a
`Coupling`, never sees the track: it gets u* = u~ + beta dt^2 a* and returns the load B^T lambda and
the increment of the displacements. With accelerations as the unknowns rounding is smallest: from
displacements they would be differences divided by dt^2.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from contactstudy.arrays import Array
from contactstudy.dynamics.banded import Factor, LinearSystem
from contactstudy.dynamics.integrators import (
    Integrator,
    average_acceleration,
    generalised_alpha,
    newmark,
)
from contactstudy.dynamics.kinematics import Scheme, correct, predict
from contactstudy.dynamics.pairs import pair, subtract_products
from contactstudy.dynamics.windows import add_transposed, product, windows
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


@runtime_checkable
class HalfWay(Protocol):
    """An attached coupling that needs no more of a free step than y of L y = rhs, S = L L^T."""

    @property
    def local(self) -> bool:
        """Whether it can: loads are felt nearby only."""

    def half_way(self, step: int, u_known: Array, of_a: float, half: Array) -> ContactStep:
        """Contact at the end of a step whose free displacements are u_known + of_a S^-1 rhs.

        `half` (n + some,) is y as `Factor.forward` gives it. What the contact makes of it, for the
        accelerations, is added to it; the increment is left empty.
        """


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
    dt, am, af = steps.length, integrator.alpha_m, integrator.alpha_f
    scheme, n = Scheme(dt, integrator.beta, integrator.gamma, am, af), system.n_dofs
    of_a = integrator.beta * dt**2
    factor = integrator.factor(system, dt)
    attached = contact_state = None
    if coupling is not None:
        attached = coupling.attached(factor, (1.0 - af) * of_a)
        contact_state = start.contact.state if start.contact else coupling.start()
    half_way = attached.half_way if isinstance(attached, HalfWay) and attached.local else None
    mass, matrices = windows(system.mass), pair(system.stiffness, system.damping)
    dampers = None if system.dampers is None else windows(system.dampers)
    load_at = external if callable(external) else lambda step: external
    u, v, a, load = start.u, start.v, start.a, start.load
    known = np.empty(n), np.empty(n)
    means = np.empty(n), np.empty(n), np.empty(n)
    for step in range(1, steps.count + 1):
        ext = load_at(step)
        predict(scheme, (u, v, a), known, means)
        # S a* = (1-af) f_ext(n+1) + af f(n) - am M a - C ((1-af) v~ + af v) - K ((1-af) u~ + af u)
        rhs = (1.0 - af) * ext + af * load
        if am != 0.0:
            rhs -= product(mass, means[2])
        subtract_products(matrices, means[0], means[1], rhs)
        if dampers is not None:
            add_transposed(dampers, -product(dampers, means[1]), rhs)
        contact, load = None, ext
        if half_way is not None:
            y = factor.forward(rhs)
            contact = half_way(step, known[0], of_a, y)
            new = factor.backward(y)
        else:
            new = factor.solve(rhs)
            if attached is not None:
                contact = attached(step, known[0] + of_a * new, contact_state)
                contact_state = contact.state
                new += contact.increment / of_a
        if contact is not None:
            load = ext + contact.load
        u, v, a = np.empty(n), np.empty(n), np.empty(n)
        correct(scheme, known, new, (u, v, a))
        if not np.isfinite(a).all():
            where = f" (wheel at X = {steps.position(step):.3f} m)" if steps.position else ""
            raise NumericalError(
                f"the state is not finite after step {step} of {steps.count},"
                f" t = {step * dt:.6g} s{where}"
            )
        yield State(step, step * dt, u, v, a, load, contact)

"""Newmark's kinematics, compiled: one pass over the motion before and one after the equations."""

from typing import NamedTuple

from contactstudy.arrays import Array
from contactstudy.compiled import compiled


class Scheme(NamedTuple):
    """Time step [s] and parameters of the integrator."""

    dt: float
    beta: float
    gamma: float
    alpha_m: float
    alpha_f: float


@compiled
def predict(
    scheme: Scheme,
    before: tuple[Array, Array, Array],
    known: tuple[Array, Array],
    means: tuple[Array, Array, Array],
) -> None:
    """What the step before decides of u, v and a, and what K, C and M are multiplied with.

    All (n,), and `known` may be u and v of the step before. A loop an array, which the compiler
    makes instructions for several dofs of.
    """
    dt, beta, gamma, am, af = scheme
    (u, v, a), (u_known, v_known), (mean_u, mean_v, mean_a) = before, known, means
    for i in range(len(u)):
        new = u[i] + dt * v[i] + dt**2 * (0.5 - beta) * a[i]  # u~
        mean_u[i] = (1.0 - af) * new + af * u[i]
        u_known[i] = new
    for i in range(len(u)):
        new = v[i] + dt * (1.0 - gamma) * a[i]  # v~
        mean_v[i] = (1.0 - af) * new + af * v[i]
        v_known[i] = new
    for i in range(len(u)):
        mean_a[i] = am * a[i]


@compiled
def correct(
    scheme: Scheme,
    known: tuple[Array, Array],
    new: Array,
    after: tuple[Array, Array, Array],
) -> None:
    """u, v and a (n,) for new accelerations; u and v may be the arrays in `known`."""
    dt, beta, gamma, _, _ = scheme
    (u_known, v_known), (u, v, a) = known, after
    for i in range(len(new)):
        u[i] = u_known[i] + beta * dt**2 * new[i]
    for i in range(len(new)):
        v[i] = v_known[i] + gamma * dt * new[i]
    a[:] = new

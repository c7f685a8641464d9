"""The forces of contact laws at points, compiled: a law is its kind and its numbers.

Per wheel i the gap is g_i = g*_i + sum_j W_ij lambda_j, and lambda_i follows from g_i by the law.
A law in which lambda is a function of the penetration d = -g alone needs one more case in
`of_penetration`; it grows with d. It may depend on the profile's shape under the wheel at a step,
d being counted from first touch.

The paper's wheel element, eqs (4)-(6), stands once in Z and once in Y. Beside the rail a linear
spring holds in both senses and has no static load: lambda_y = -k_y g_y, whatever the law on top.
"""

import math

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compiled import compiled
from contactstudy.contact.envelope import solve_in_envelope

MOVING, LINEAR, RIGID, HERTZ, PRESS, BEDDING = range(6)
"""Kinds: the static load; F - k g; g = 0; and functions of d alone: k d^(3/2), a table, a bedding.

With a shape the laws of Hertz and of the table follow the mean over the patch.
"""

_ITERATIONS = 100


@compiled
def wheel_forces(
    kind: int,
    numbers: Array,
    shape: Array,
    compliance: Array,
    free_gap: Array,
    static_loads: Array,
    bilateral: bool,
    beside: Array,
    force: Array,
) -> float:
    """Forces of all wheels (nw,) [N] into `force`; what is left of the equations, 0 if solved.

    Parameters
    ----------
    numbers : ndarray
        Of the law, as its kind wants them.
    shape : ndarray (nw, m)
        Of the profile under each wheel at this step, as the law wants it; m = 0 without [m].
    compliance : ndarray (nw, nw)
        W [m/N].
    free_gap, static_loads : ndarray (nw,)
        g* [m] and F [N].
    beside : ndarray (nw,)
        k_y of contacts beside the rail [N/m]; 0 of those that follow the law.
    """
    n = len(free_gap)
    if kind == MOVING:
        force[:] = static_loads
        return 0.0
    if not np.all(np.isfinite(free_gap)):
        force[:] = np.nan  # reported by the stepper, with step and position
        return 0.0
    if kind >= HERTZ:
        if n > 1:
            return _nonlinear_many(kind, numbers, shape, compliance, free_gap, beside, force)
        force[0] = _nonlinear_one(kind, numbers, shape[0], compliance[0, 0], free_gap[0])
        return 0.0
    # lambda = F - k_r (g* + W lambda)  =>  (W + 1/k_r) lambda = F/k_r - g*; rigid: 1/k_r = 0
    softness = 1.0 / numbers[0] if kind == LINEAR else 0.0
    if n > 1:
        flexibility, target = compliance.copy(), static_loads * softness - free_gap
        for i in range(n):
            flexibility[i, i] += softness
            if beside[i] > 0.0:  # g_y* + W lambda = -lambda_y/k_y
                flexibility[i, i] = compliance[i, i] + 1.0 / beside[i]
                target[i] = -free_gap[i]
        return _linear_many(flexibility, target, bilateral, beside, force)
    if kind == LINEAR:
        k_r = numbers[0]
        force[0] = (static_loads[0] - k_r * free_gap[0]) / (1.0 + k_r * compliance[0, 0])
    else:
        force[0] = -free_gap[0] / compliance[0, 0]
    if force[0] < 0.0 and not bilateral:
        force[0] = 0.0
    return 0.0


@compiled
def of_penetration(kind: int, numbers: Array, shape: Array, d: float) -> tuple[float, float]:
    """Force [N] and its slope [N/m] at a penetration d [m], both 0 when apart."""
    if d <= 0.0:
        return 0.0, 0.0
    if kind == BEDDING:
        return _bedding(numbers, shape, d)
    rate = 1.0
    if len(shape):
        d, rate = _approach(numbers[-1], shape, d)
    if kind == HERTZ:
        root = math.sqrt(d)
        return numbers[0] * d * root, 1.5 * numbers[0] * root * rate
    force, slope = _of_table(numbers, d)
    return force, slope * rate


@compiled
def _of_table(numbers: Array, d: float) -> tuple[float, float]:
    """F = q^(3/2) with q(d) a cubic between n knots, straight beyond the last.

    Numbers: n, then the n knots d_j, the values q_j and the slopes q_j'.
    """
    n = int(numbers[0])
    knots, values, slopes = numbers[1:], numbers[1 + n :], numbers[1 + 2 * n :]
    j = n - 1
    while knots[j] > d:
        j -= 1
    q, rise = values[j] + slopes[j] * (d - knots[j]), slopes[j]
    if j < n - 1:
        h = knots[j + 1] - knots[j]
        t, mean = (d - knots[j]) / h, (values[j + 1] - values[j]) / h
        # Hermite's cubic as its tangent and what it lacks to the other end
        second, third = 3.0 * mean - 2.0 * slopes[j] - slopes[j + 1], slopes[j] + slopes[j + 1]
        third -= 2.0 * mean
        q += h * t * t * (second + third * t)
        rise += t * (2.0 * second + 3.0 * third * t)
    root = math.sqrt(q)
    return q * root, 1.5 * root * rise


@compiled
def _bedding(numbers: Array, shape: Array, d: float) -> tuple[float, float]:
    """F = k integral of (d + shape)_+ along the patch, shape straight between its places.

    Numbers: k [N/m^2] and the distance of the places [m].
    """
    area, length = 0.0, 0.0  # in steps
    for j in range(len(shape) - 1):
        high, low = max(shape[j], shape[j + 1]) + d, min(shape[j], shape[j + 1]) + d
        if low >= 0.0:
            area += 0.5 * (high + low)
            length += 1.0
        elif high > 0.0:
            share = high / (high - low)
            area += 0.5 * high * share
            length += share
    k = numbers[0] * numbers[1]
    return k * area, k * length


@compiled
def _approach(step: float, lift: Array, d: float) -> tuple[float, float]:
    """Approach s with s - lift(s) = d, and ds/dd; lift (m,) at 0, step, 2 step ..., straight."""
    before = 0.0
    for j in range(1, len(lift)):
        reached = step * j - lift[j]
        if reached >= d:
            rate = step / (reached - before)
            return step * (j - 1) + rate * (d - before), rate
        before = reached
    return d + lift[-1], 1.0


@compiled
def _linear_many(
    flexibility: Array, target: Array, bilateral: bool, beside: Array, force: Array
) -> float:
    """Solve flexibility @ lambda = target, or its complementarity problem with lambda >= 0 on top.

    The linear solution counts if nowhere tensile. Otherwise projected Gauss-Seidel sweeps, which
    converge for every positive definite matrix, find who is apart.
    """
    force[:] = solve_in_envelope(flexibility, target)
    holds = beside > 0.0
    if bilateral or not np.any((force < 0.0) & ~holds):
        return 0.0
    force[:] = np.where(holds, force, np.maximum(force, 0.0))
    change = 0.0
    for _ in range(1000 * _ITERATIONS):
        change = 0.0
        for i in range(len(force)):
            rest = target[i]
            for j in range(len(force)):
                if j != i:
                    rest -= flexibility[i, j] * force[j]
            new = rest / flexibility[i, i]
            if not holds[i]:
                new = max(0.0, new)
            change = max(change, abs(new - force[i]))
            force[i] = new
        if change <= 1e-14 * np.max(np.abs(force)):
            return 0.0
    return change * np.max(np.diag(flexibility))


@compiled
def _nonlinear_one(
    kind: int, numbers: Array, shape: Array, compliance: float, free_gap: float
) -> float:
    """Newton's method in the penetration d: g* + W lambda(d) + d = 0, kept between bounds.

    The left side increases from g* < 0 at d = 0 to W lambda at d = -g*. For Hertz's law it is
    convex, so that Newton's method started on its right side decreases steadily to the solution;
    for any other law a step that leaves the bounds halves them instead.
    """
    if free_gap >= 0.0:
        return 0.0
    low, high = 0.0, -free_gap
    d = high
    for _ in range(_ITERATIONS):
        force, slope = of_penetration(kind, numbers, shape, d)
        left = free_gap + compliance * force + d
        if left > 0.0:
            high = d
        else:
            low = d
        move = left / (compliance * slope + 1.0)
        if abs(move) <= 4e-16 * d:
            d -= move
            break
        d = d - move if low <= d - move <= high else 0.5 * (low + high)
    return of_penetration(kind, numbers, shape, d)[0]


@compiled
def _nonlinear_many(
    kind: int,
    numbers: Array,
    shape: Array,
    compliance: Array,
    free_gap: Array,
    beside: Array,
    force: Array,
) -> float:
    """Newton with a line search on g* + W lambda(d) + d = 0, d < 0 being an open gap."""
    n, scale = len(free_gap), np.abs(free_gap).max()
    trial_force, trial_slope = np.zeros(n), np.zeros(n)
    d = -free_gap
    slope = np.zeros(n)
    _of_penetrations(kind, numbers, shape, beside, d, force, slope)
    left = compliance @ force  # + g* + d = 0
    for _ in range(_ITERATIONS):
        if np.abs(left).max() <= 1e-15 * scale:
            break
        # (I + W D) move = left is regular for W positive definite and D = r r >= 0: with
        # (I + r W r) z = r left, symmetric, move = left - W r z
        root = np.sqrt(slope)
        symmetric = compliance * root
        for i in range(n):
            symmetric[i] *= root[i]
            symmetric[i, i] += 1.0
        move = left - compliance @ (root * solve_in_envelope(symmetric, root * left))
        length, size = 1.0, np.linalg.norm(left)
        better = False
        while not better and length > 1e-10:
            trial = d - length * move
            _of_penetrations(kind, numbers, shape, beside, trial, trial_force, trial_slope)
            trial_left = free_gap + compliance @ trial_force + trial
            better = np.linalg.norm(trial_left) < size
            length *= 0.5
        if not better:
            break  # no further decrease: either solved to rounding, or stuck
        d, left = trial, trial_left
        force[:], slope[:] = trial_force, trial_slope
    remaining = np.abs(left).max()
    return remaining if remaining > 1e-12 * scale else 0.0


@compiled
def _of_penetrations(
    kind: int,
    numbers: Array,
    shape: Array,
    beside: Array,
    d: Array,
    force: Array,
    slope: Array,
) -> None:
    """Forces and slopes of all contacts at their penetrations, into `force` and `slope`."""
    for i in range(len(d)):
        if beside[i] > 0.0:
            force[i], slope[i] = beside[i] * d[i], beside[i]
        else:
            force[i], slope[i] = of_penetration(kind, numbers, shape[i], d[i])

"""Contacts in two directions at once: a law on top of the rail, a linear spring beside it.

The paper's wheel element, eqs (4)-(6), stands once in Z and once in Y. Across the rail the spring
holds in both senses and has no static load: lambda_y = -k_y g_y, whatever the force on top.
"""

from collections.abc import Callable

import numpy as np

from contactstudy.arrays import Array, BoolArray

LATERAL_STIFFNESS = 1e9
"""N/m, of the contact across the rail without slip: 0.8 of the normal tangent of 1.2 GN/m, the
ratio 2(1 - nu)/(2 - nu) of R. D. Mindlin, J. Appl. Mech. 16 (1949) 259."""


def forces_in_two_directions(
    lateral: BoolArray,
    stiffness: float,
    compliance: Array,
    free_gap: Array,
    vertical: Callable[[Array, Array], Array],
) -> Array:
    """Forces (nc,) [N] of all contacts at the end of a step.

    Parameters
    ----------
    lateral : ndarray of bool
        (nc,) which contacts are lateral.
    stiffness : float
        k_y [N/m].
    compliance, free_gap : ndarray
        W (nc, nc) [m/N] and g* (nc,) [m], as of `contactstudy.contact.laws`.
    vertical : callable
        Forces of the vertical contacts from their compliance and free gaps.
    """
    # g_y = g*_y + W_yz l_z + W_yy l_y and l_y = -k_y g_y give, with A = W_yy + 1/k_y,
    # l_y = -A^-1 (g*_y + W_yz l_z); put into the vertical gaps, these see
    # W_zz - W_zy A^-1 W_yz and g*_z - W_zy A^-1 g*_y.
    z, y = np.flatnonzero(~lateral), np.flatnonzero(lateral)
    across = compliance[np.ix_(y, z)]
    A = compliance[np.ix_(y, y)] + np.eye(len(y)) / stiffness
    solved = np.linalg.solve(A, np.column_stack([across, free_gap[y]]))
    through, still = solved[:, :-1], solved[:, -1]
    forces = np.empty(len(free_gap))
    forces[z] = vertical(
        compliance[np.ix_(z, z)] - across.T @ through, free_gap[z] - across.T @ still
    )
    forces[y] = -(still + through @ forces[z])
    return forces

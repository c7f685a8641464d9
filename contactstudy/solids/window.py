"""Exact static responses of a window of rail cells with full interfaces.

The window is `2*margin + 2` cells long and clamped at both ends; loads act on the two middle
cells. Its responses serve twice: seen from afar they are the shapes that the interface modes
must represent, and what the reduced window cannot represent is the residual flexibility.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl

from contactstudy.arrays import Array
from contactstudy.solids.chain import BlockTridiagonal, chain_blocks, merge, repeat
from contactstudy.solids.held_cell import HeldCell
from contactstudy.solids.section_rows import SectionRows

MARGIN = 3  # cells on each side of the two loaded ones
_AT_ONCE = 10  # planes, or somewhat more, whose loads are solved for together


@dataclass(frozen=True)
class WindowResponse:
    """Responses to unit loads on the first half of the two middle cells.

    Plane p of the pair lies at ``x = p * thickness``, p = 0 ... 2*ns. Loads on the second
    half follow by reflection in x. A load with index j*ny + a acts on plane j, j = 0 ... ns,
    along the outward normal of surface node a; foot loads work on the nm mean motions of the
    foot, centre loads are vertical, in proportion to the section's area.

    Attributes
    ----------
    surface : ndarray (2*ns + 1, ny, (ns + 1)*ny)
        Normal displacements of the surface nodes.
    centre : ndarray (2*ns + 1, nm, (ns + 1)*ny)
        Mean motions of the sections.
    own_centre : ndarray (2, ns + 1)
        Mean displacement of a section under a centre load on it, and of the next one.
    interfaces : ndarray (5, n, (ns + 1)*(ny + nm))
        Displacements of the interface planes at x = -L, 0, L, 2L, 3L; the last (ns + 1)*nm
        columns belong to the foot loads, one motion of the foot after the other.
    """

    surface: Array
    centre: Array
    own_centre: Array
    interfaces: Array


def window_response(cell: HeldCell, rows: SectionRows) -> WindowResponse:
    """Solve the window for loads on its middle: responses in m/N."""
    ns, n, ny, nm = cell.n_slices, len(rows.weights), len(rows.surface_y), len(rows.foot)
    # none of these loads is axial: mirrored, they are those of the mirrored plane
    B = np.vstack([rows.surface, rows.foot, rows.centre]).T
    nb = B.shape[1]
    own, left, right = _held_response(cell, B)
    one = repeat(cell.piece.stiffness, ns)
    before = repeat(one, MARGIN - 1)
    beyond = merge(before, one)
    factor = BlockTridiagonal(*chain_blocks([one, one], beyond.bb, beyond.aa))
    kept = np.stack(factor.solve([left, right, np.zeros_like(left)]))
    # the cell with the loads: own response and that to its end planes' motion; the cell after it
    first = (own + left.T @ kept[0] + right.T @ kept[1]).reshape(ns + 1, nb, ns + 1, nb)
    second = (left.T @ kept[1] + right.T @ kept[2]).reshape(ns + 1, nb, ns + 1, nb)
    u = np.concatenate([first, second[1:]])
    contact, foot, mean = slice(ny), slice(ny, ny + nm), ny + nm
    p = np.arange(ns + 1)
    planes = kept.reshape(3, n, ns + 1, nb)
    feet = np.swapaxes(planes[..., foot], 2, 3)
    kept = np.concatenate([x.reshape(3, n, -1) for x in (planes[..., contact], feet)], axis=-1)
    # the neighbouring interfaces follow from the cells beyond: (beyond' + K_aa) u_2 = -K_ab u_3
    outer_left = -sl.solve(before.bb + one.aa, one.ab @ kept[0], assume_a="pos")
    outer_right = -sl.solve(before.aa + one.bb, one.ab.T @ kept[2], assume_a="pos")
    return WindowResponse(
        u[:, contact, :, contact].reshape(2 * ns + 1, ny, -1),
        u[:, mean:, :, contact].reshape(2 * ns + 1, nm, -1),
        np.stack([u[p, mean, p, mean], u[p + 1, mean, p, mean]]),
        np.stack([outer_left, *kept, outer_right]),
    )


def _held_response(cell: HeldCell, B: Array) -> tuple[Array, Array, Array]:
    """Loads B (n, nb) on every plane of a cell whose end planes are held.

    Displacements B^T u of all planes, ((ns+1)*nb, (ns+1)*nb), and what goes to the left and to the
    right end plane, (n, (ns+1)*nb).
    """
    ns, (n, nb) = cell.n_slices, B.shape
    own = np.zeros((ns + 1, nb, ns + 1, nb))
    left, right = np.zeros((n, ns + 1, nb)), np.zeros((n, ns + 1, nb))
    left[:, 0], right[:, ns] = B, B
    R, E = cell.mirror, cell.coupling
    # loads on the right half are those on the left one, mirrored; some planes of loads at a time,
    # which keeps the memory small
    half = np.arange(1, ns // 2 + 1)
    for group in np.array_split(half, max(1, len(half) // _AT_ONCE)):
        rhs = [np.zeros((n, len(group) * nb)) for _ in range(ns - 1)]
        for i, j in enumerate(group):
            rhs[j - 1][:, i * nb : (i + 1) * nb] = B
        u = cell.solve(rhs)
        moved = np.stack([B.T @ x for x in u]).reshape(ns - 1, nb, len(group), nb)
        own[1:-1, :, group] = moved
        own[1:-1, :, ns - group] = moved[::-1]
        to_left, to_right = (-(A @ x).reshape(n, -1, nb) for A, x in ((E, u[0]), (E.T, u[-1])))
        left[:, group], right[:, group] = to_left, to_right
        left[:, ns - group], right[:, ns - group] = R[..., None] * to_right, R[..., None] * to_left
    size = (ns + 1) * nb
    return own.reshape(size, size), left.reshape(n, size), right.reshape(n, size)

"""Exact static responses of a window of rail cells with full interfaces.

The window is `2*margin + 2` cells long and clamped at both ends; loads act on the two middle
cells. Its responses serve twice: seen from afar they are the shapes that the interface modes
must represent, and what the reduced window cannot represent is the residual flexibility.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl

from contactstudy.arrays import Array, IntArray
from contactstudy.solids.chain import BlockTridiagonal, Slice, chain_blocks, repeat
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


def window_response(piece: Slice, n_slices: int, rows: SectionRows) -> WindowResponse:
    """Solve the window for loads on its middle: responses in m/N.

    `piece` is the stiffness of one slice in N/m, of `n_slices` to a cell.
    """
    cell = repeat(piece, n_slices)
    beyond = repeat(cell, MARGIN)
    factor = BlockTridiagonal(*chain_blocks([piece] * (2 * n_slices), beyond.bb, beyond.aa))
    # some planes of loads at a time, which keeps the memory small
    groups = np.array_split(np.arange(n_slices + 1), max(1, (n_slices + 1) // _AT_ONCE))
    parts = [_loaded(factor, group, n_slices, rows) for group in groups]
    # the columns of a part are (contact, foot, planes of the group), each motion of the foot apart
    surface, centre, own = (np.concatenate([p[i] for p in parts], axis=-1) for i in range(3))
    planes = np.concatenate([p[3] for p in parts], axis=-1)
    feet = np.concatenate([p[4] for p in parts], axis=-1)
    kept = np.concatenate([planes, feet.reshape(*feet.shape[:2], -1)], axis=-1)
    # the neighbouring interfaces follow from the cells beyond: (beyond' + K_aa) u_2 = -K_ab u_3
    before = repeat(cell, MARGIN - 1)
    left = -sl.solve(before.bb + cell.aa, cell.ab @ kept[0], assume_a="pos")
    right = -sl.solve(before.aa + cell.bb, cell.ab.T @ kept[2], assume_a="pos")
    return WindowResponse(surface, centre, own, np.stack([left, *kept, right]))


def _loaded(
    factor: BlockTridiagonal, group: IntArray, n_slices: int, rows: SectionRows
) -> tuple[Array, Array, Array, Array, Array]:
    """Responses to loads on a group of planes: surface, centre, own centre of `WindowResponse`.

    Then the displacements of the window's first, middle and last plane under the contact loads,
    (3, n, len(group)*ny), and under those on the foot, (3, n, nm, len(group)).
    """
    n, ny, nm, k = len(rows.weights), len(rows.surface_y), len(rows.foot), len(group)
    others = np.vstack([rows.foot, rows.centre[:1]]).T
    rhs = [np.zeros((n, k * (ny + nm + 1))) for _ in range(2 * n_slices + 1)]
    for j, p in enumerate(group):
        rhs[p][:, j * ny : (j + 1) * ny] = rows.surface.T
        rhs[p][:, k * ny + j :: k] = others
    u = factor.solve(rhs)
    contact, foot = slice(0, k * ny), slice(k * ny, k * (ny + nm))
    load = k * (ny + nm) + np.arange(k)
    ends = np.stack([u[0], u[n_slices], u[-1]])
    return (
        np.stack([rows.surface @ x[:, contact] for x in u]),
        np.stack([rows.centre @ x[:, contact] for x in u]),
        np.array(
            [
                [rows.centre[0] @ u[p + q][:, c] for p, c in zip(group, load, strict=True)]
                for q in (0, 1)
            ]
        ),
        ends[:, :, contact],
        ends[:, :, foot].reshape(3, n, nm, k),
    )

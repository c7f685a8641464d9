"""Exact static responses of a window of rail cells with full interfaces.

The window is `2*margin + 2` cells long and clamped at both ends; loads act on the two middle
cells. Its responses serve twice: seen from afar they are the shapes that the interface modes
must represent, and what the reduced window cannot represent is the residual flexibility.
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
from numpy.typing import NDArray

from contactstudy.solids.chain import BlockTridiagonal, Slice, chain_blocks, repeat
from contactstudy.solids.section_rows import SectionRows

Array = NDArray[np.float64]
MARGIN = 3  # cells on each side of the two loaded ones


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
    """Solve the window for loads on its middle.

    Parameters
    ----------
    piece : Slice
        Stiffness of one slice in N/m.
    n_slices : int
        Slices of a cell.
    rows : SectionRows
        Functionals of a plane.

    Returns
    -------
    WindowResponse
        In m/N.
    """
    cell = repeat(piece, n_slices)
    beyond = repeat(cell, MARGIN)
    n, ny, nm = len(rows.weights), len(rows.surface_y), len(rows.foot)
    count = n_slices + 1
    factor = BlockTridiagonal(*chain_blocks([piece] * (2 * n_slices), beyond.bb, beyond.aa))
    others = np.vstack([rows.foot, rows.centre[:1]]).T
    rhs = []
    for p in range(2 * n_slices + 1):
        b = np.zeros((n, count * (ny + nm + 1)))
        if p < count:
            b[:, p * ny : (p + 1) * ny] = rows.surface.T
            b[:, count * ny + p :: count] = others
        rhs.append(b)
    u = factor.solve(rhs)
    contact = slice(0, count * ny)
    kept = slice(0, count * (ny + nm))
    centre_load = count * (ny + nm) + np.arange(count)
    # the neighbouring interfaces follow from the cells beyond: (beyond' + K_aa) u_2 = -K_ab u_3
    before = repeat(cell, MARGIN - 1)
    left = -sl.solve(before.bb + cell.aa, cell.ab @ u[0][:, kept], assume_a="pos")
    right = -sl.solve(before.aa + cell.bb, cell.ab.T @ u[-1][:, kept], assume_a="pos")
    return WindowResponse(
        surface=np.stack([rows.surface @ x[:, contact] for x in u]),
        centre=np.stack([rows.centre @ x[:, contact] for x in u]),
        own_centre=np.array(
            [[rows.centre[0] @ u[p + q][:, centre_load[p]] for p in range(count)] for q in (0, 1)]
        ),
        interfaces=np.stack([left, *(x[:, kept] for x in (u[0], u[n_slices], u[-1])), right]),
    )

"""One slice of a solid of revolution, between two planes through its axis."""

import numpy as np
from numpy.typing import NDArray

from contactstudy.solids.chain import Slice
from contactstudy.solids.hexahedron import hex_stiffness
from contactstudy.solids.wheel_section import WheelSection

Array = NDArray[np.float64]


def ring_slice(
    section: WheelSection, angle: float, youngs_modulus: float, poisson_ratio: float
) -> Slice:
    """Stiffness of the slice between two planes through the axis, of both halves y.

    Parameters
    ----------
    section : WheelSection
        With n nodes.
    angle : float
        Between the planes in rad.
    youngs_modulus, poisson_ratio : float
        Elastic constants, E in Pa.

    Returns
    -------
    Slice
        Blocks (3n, 3n) in N/m. Components of a node in either plane are those of that plane's
        own axes: (radial outwards, y, tangential in the sense of growing angle), so that the
        blocks depend on the angle between the planes only.
    """
    y, rho = section.nodes.T
    n = len(y)

    def plane(theta: float) -> Array:
        # first plane's axes: radial, y, tangential
        return np.stack([rho * np.cos(theta), y, rho * np.sin(theta)], axis=1)

    nodes = np.concatenate([plane(0.0), plane(angle)])
    elements = np.concatenate([section.quads, section.quads + n], axis=1)
    # quads turn counter-clockwise in (y, radial), so the kernel wants (y, radial, tangential)
    K = hex_stiffness(nodes[elements][:, :, [1, 0, 2]], youngs_modulus, poisson_ratio)
    swap = (3 * np.arange(8)[:, None] + np.array([1, 0, 2])).ravel()
    K = K[:, swap[:, None], swap]
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    A = np.zeros((6 * n, 6 * n))
    np.add.at(A, (dofs[:, :, None], dofs[:, None, :]), 2.0 * K)
    c, s = np.cos(angle), np.sin(angle)
    # u (first plane's axes) = Q u' (second plane's axes)
    Q = np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
    aa, ab, bb = A[: 3 * n, : 3 * n], A[: 3 * n, 3 * n :], A[3 * n :, 3 * n :]
    ab = (ab.reshape(3 * n, n, 3) @ Q).reshape(3 * n, 3 * n)
    bb = (bb.reshape(3 * n, n, 3) @ Q).reshape(3 * n, 3 * n)
    bb = np.einsum("ki,akb->aib", Q, bb.reshape(n, 3, 3 * n)).reshape(3 * n, 3 * n)
    return Slice(aa, ab, bb)

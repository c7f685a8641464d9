"""Several patches of one wheel: which points in contact belong together."""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from contactstudy.contact.points import ContactPoints

Array = NDArray[np.float64]

_TOUCHING = np.ones((3, 3), dtype=int)


def patch_forces(points: ContactPoints, forces: Array) -> list[Array]:
    """Forces split into those of separate patches.

    Facets of the wheel's tread that share a side or a corner belong to one patch; so patches are
    apart where at least one whole facet between them carries nothing. (Points at nodes: where at
    least one node carries nothing.)

    Parameters
    ----------
    points : ContactPoints
    forces : ndarray (n,)
        Normal forces at the points in N.

    Returns
    -------
    list of ndarray (n,)
        Forces of one patch each, zero elsewhere; the largest resultant first. They sum to the
        given ones. Of half a symmetric model, its half only.
    """
    shape = len(points.x), len(points.y)
    grid = forces.reshape(shape)
    # two Gauss points an interval, or one point a node
    parts = 2 if points.facet.shape[1] == 1 else 1
    loaded = grid.reshape(shape[0] // parts, parts, shape[1] // parts, parts).any(axis=(1, 3))
    number, count = label(loaded, structure=_TOUCHING)
    if count < 2:
        return [forces] * count
    of_point = np.repeat(np.repeat(number, parts, axis=0), parts, axis=1).ravel()
    found = [np.where(of_point == k, forces, 0.0) for k in range(1, count + 1)]
    return sorted(found, key=lambda f: -float(f.sum()))


def patch_record(points: ContactPoints, forces: Array) -> dict[str, float]:
    """How many patches there are, and of the one that carries most its share and semi-axes.

    Parameters
    ----------
    points : ContactPoints
    forces : ndarray (n,)
        Normal forces at the points in N.

    Returns
    -------
    dict
        `patch_count`, `largest_patch_share` (of the sum of normal forces, 0 without contact), and
        `semi_axis_along`, `semi_axis_across` in m, see `ContactPoints.semi_axes`.
    """
    found = patch_forces(points, forces)
    largest = found[0] if found else forces
    share = float(largest.sum() / forces.sum()) if found else 0.0
    return {
        "patch_count": float(len(found)),
        "largest_patch_share": share,
        **points.semi_axes(largest),
    }

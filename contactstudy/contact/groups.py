"""Several patches of one wheel: which points in contact belong together."""

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.contact.area import patch_area
from contactstudy.geometry.points import ContactPoints

_TOUCHING = np.ones((3, 3), dtype=int)
_OPEN = 2e-6  # m; at a jump from R300 to R80 elements of 2 mm are off by dk h^2/8 = 5 um


def patch_numbers(points: ContactPoints, gap: Array, forces: Array) -> IntArray:
    """Patch of every point (n,), from 1 on by falling resultant; 0 where there is no force.

    Facets of the wheel's tread that share a side or a corner belong to one patch; so patches are
    apart where at least one whole facet between them carries nothing and is open by 2 um or more:
    at a ridge of the rail's profile whole facets inside a patch open by less. A force at a node is
    carried by all the facets around it. Gaps of the deformed bodies (n,) in m, forces (n,) in N.
    """
    from scipy.ndimage import label

    carrying = forces > 0.0
    pressing = (carrying | (gap < _OPEN)).reshape(len(points.x), len(points.y))
    # two Gauss points an interval, or one point a node
    parts = 2 if points.facet.shape[1] == 1 else 1
    if parts == 2:
        nx, ny = (n // 2 for n in pressing.shape)
        loaded = pressing.reshape(nx, 2, ny, 2).any(axis=(1, 3))
    else:
        loaded = pressing[:-1, :-1] | pressing[1:, :-1] | pressing[:-1, 1:] | pressing[1:, 1:]
    number, count = label(loaded, structure=_TOUCHING)
    if count < 2:
        return carrying.astype(int)
    # a pressing node has the number of any facet around it, here of one before or behind it
    of_point = np.repeat(np.repeat(number, parts, axis=0), parts, axis=1)
    if parts == 1:
        of_point = np.pad(number, ((0, 1), (0, 1)), mode="edge")
    of_point = np.where(carrying, of_point.ravel(), 0)
    resultants = np.bincount(of_point, forces, count + 1)
    resultants[0] = np.inf
    rank = np.empty(count + 1, dtype=int)
    rank[np.argsort(-resultants, kind="stable")] = np.arange(count + 1)
    return rank[of_point]


def contact_area(points: ContactPoints, gap: Array, forces: Array) -> float:
    """Area of all patches in m^2, of both halves of a symmetric model.

    Not the sum of the areas of the points in contact, single ones of which open inside a patch,
    but from the gap around each patch, see `contactstudy.contact.area`; gap and forces as in
    `patch_numbers`.

    Notes
    -----
    Within 2 % for two circles whose edges are three facets apart. Near a large patch a small one
    has no room for the lines around it and may be missed.
    """
    return _area(points, gap, patch_numbers(points, gap, forces))


def _area(points: ContactPoints, gap: Array, number: IntArray) -> float:
    from scipy.ndimage import distance_transform_edt

    shape, count = (len(points.x), len(points.y)), int(number.max())
    grid = points.x, points.arc, gap.reshape(shape), points.symmetric
    if count < 2:
        return patch_area(*grid) if count else 0.0
    number = number.reshape(shape)
    near = distance_transform_edt(
        number == 0,
        sampling=[np.ptp(lines) / (len(lines) - 1) for lines in grid[:2]],
        return_distances=False,
        return_indices=True,
    )
    number = number[tuple(near)]
    return sum(patch_area(*grid, number == k + 1) for k in range(count))


def patch_record(points: ContactPoints, gap: Array, forces: Array) -> dict[str, float]:
    """Histories of the patches; gap and forces as in `patch_numbers`.

    Returns
    -------
    dict
        `patch_count`, `contact_area` in m^2, and of the patch that carries most
        `largest_patch_share` (of the sum of normal forces, 0 without contact), `semi_axis_along`,
        `semi_axis_across` in m, see `ContactPoints.semi_axes`.
    """
    number = patch_numbers(points, gap, forces)
    largest = np.where(number == 1, forces, 0.0)
    return {
        "contact_area": _area(points, gap, number),
        "patch_count": float(number.max()),
        "largest_patch_share": float(largest.sum() / forces.sum()) if number.any() else 0.0,
        **points.semi_axes(largest),
    }

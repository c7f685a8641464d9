"""Generalised modes of an interface plane: beam kinematics and what loads from afar add."""

import numpy as np

from contactstudy.arrays import Array, BoolArray
from contactstudy.solids.section_rows import SectionRows
from contactstudy.solids.window import WindowResponse


def interface_basis(
    response: WindowResponse, rows: SectionRows, axial: BoolArray, count: int
) -> Array:
    """Basis (n, count) of the displacements of an interface plane.

    The first columns are the rigid motions of the section. The others are the proper orthogonal
    modes (in the area-weighted product) of the static responses to contact and foot loads at least
    half a cell away: loads nearer by would fill the basis with their local dents, which belong to
    the residual flexibility. They are orthonormal and orthogonal to the rigid motions in that
    product, so that the mean vertical displacement of a plane is its second coordinate. The `axial`
    (n,) degrees of freedom, along X, change sign in a reflection in x.
    """
    planes, n_surface = response.interfaces, response.centre.shape[2]
    n_slices = (response.surface.shape[0] - 1) // 2
    ny = response.surface.shape[1]
    n_foot = (planes.shape[2] - n_surface) // (n_slices + 1)
    numbers = np.arange(n_slices + 1)
    plane_of_load = np.r_[np.repeat(numbers, ny), np.tile(numbers, n_foot)]
    snapshots = []
    for i, u in enumerate(planes):
        distance = np.abs(plane_of_load - (i - 1) * n_slices)
        snapshots.append(u[:, distance >= n_slices // 2])
    # a pad presses evenly over its footprint: the mean over three quarters of a cell on each
    # side of the middle plane (both halves are alike but for the sign of u_x)
    near = numbers[numbers >= n_slices // 4]
    for motion in range(n_foot):
        columns = n_surface + motion * (n_slices + 1) + near
        pad = planes[2][:, columns].mean(axis=1, keepdims=True)
        snapshots.append(np.sqrt(len(near)) * np.where(axial[:, None], 0.0, pad))
    X = np.hstack(snapshots)
    # the reflected loads: u_x changes sign. Taking both makes modes either axial or transverse.
    X = np.hstack([np.where(axial[:, None], X, 0.0), np.where(axial[:, None], 0.0, X)])
    root = np.sqrt(rows.weights)[:, None]
    Q, _ = np.linalg.qr(root * rows.rigid)
    X = root * X
    X = X - Q @ (Q.T @ X)
    U, _, _ = np.linalg.svd(X, full_matrices=False)
    extra = U[:, : count - rows.rigid.shape[1]]
    # a fixed sign makes the same inputs give the same bytes
    extra = extra * np.sign(extra[np.abs(extra).argmax(axis=0), np.arange(extra.shape[1])])
    return np.hstack([rows.rigid, extra / root])

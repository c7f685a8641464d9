"""Invariants of the stress tensor.

A stress is stored as (xx, yy, zz, yz, zx, xy) in Pa, tension positive.
"""

import numpy as np

from contactstudy.arrays import Array


def stress_tensor(stress: Array) -> Array:
    """Symmetric tensors (..., 3, 3) of stresses (..., 6)."""
    return np.asarray(stress)[..., [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]


def von_mises(stress: Array) -> Array:
    """Equivalent stress (...) of von Mises of stresses (..., 6), in Pa.

    ``sqrt(((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2)/2 + 3 (yz^2 + zx^2 + xy^2))``
    """
    xx, yy, zz, yz, zx, xy = np.moveaxis(np.asarray(stress, dtype=float), -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(0.5 * normal + 3.0 * (yz**2 + zx**2 + xy**2)))


def maximum_shear(stress: Array) -> Array:
    """Largest shear stress (...) on any plane of stresses (..., 6), ``(s_1 - s_3)/2`` in Pa."""
    principal = np.linalg.eigvalsh(stress_tensor(stress))
    return np.asarray(0.5 * (principal[..., 2] - principal[..., 0]))

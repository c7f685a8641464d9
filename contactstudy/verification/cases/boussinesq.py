"""Displacement of a half-space under a point load."""

import numpy as np

from contactstudy.arrays import Array


def boussinesq(
    x: Array, y: Array, depth: Array, youngs_modulus: float, poisson_ratio: float
) -> Array:
    """Displacement of a half-space under a unit normal point load at the origin.

    Johnson, Contact Mechanics (1985), eq. (3.18), with R = |(x, y, depth)|::

        u_r = P/(4 pi G) [ r z/R^3 - (1 - 2 nu) r/(R (R + z)) ]
        u_z = P/(4 pi G) [ z^2/R^3 + 2 (1 - nu)/R ]

    Parameters
    ----------
    x, y, depth : ndarray (...)
        Position in m, depth positive into the body; not the origin.
    youngs_modulus, poisson_ratio : float
        Elastic constants, E in Pa.

    Returns
    -------
    ndarray (..., 3)
        Displacement along (x, y, depth) in m/N for a load into the body.
    """
    G = youngs_modulus / (2 * (1 + poisson_ratio))
    R = np.sqrt(x**2 + y**2 + depth**2)
    radial = depth / R**3 - (1 - 2 * poisson_ratio) / (R * (R + depth))
    u = np.stack([radial * x, radial * y, depth**2 / R**3 + 2 * (1 - poisson_ratio) / R], axis=-1)
    return np.asarray(u / (4 * np.pi * G))

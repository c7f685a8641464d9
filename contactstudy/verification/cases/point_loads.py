"""Displacements of a half-space under a point load and of a half-plane under a line load."""

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
    youngs_modulus : float
        In Pa.

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


def flamant(x: Array, depth: Array, youngs_modulus: float, poisson_ratio: float) -> Array:
    """Displacement in plane strain under a unit line load, but for a rigid shift.

    Johnson, Contact Mechanics (1985), eq. (2.19), theta from the load's line of action::

        pi E u_r/(1 + nu)     = -2 (1-nu) cos(th) ln r - (1-2nu) th sin(th)
        pi E u_theta/(1 + nu) = 2 (1-nu) sin(th) ln r + sin(th) - (1-2nu) th cos(th)

    Parameters
    ----------
    x, depth : ndarray (...)
        In m, not the origin.
    youngs_modulus : float
        In Pa.

    Returns
    -------
    ndarray (..., 2)
        Along (x, depth) in m for 1 N/m into the body.
    """
    nu, theta, log_r = poisson_ratio, np.arctan2(x, depth), 0.5 * np.log(x**2 + depth**2)
    s, c = np.sin(theta), np.cos(theta)
    radial = -2 * (1 - nu) * c * log_r - (1 - 2 * nu) * theta * s
    around = 2 * (1 - nu) * s * log_r + s - (1 - 2 * nu) * theta * c
    u = np.stack([radial * s + around * c, radial * c - around * s], axis=-1)
    return np.asarray((1 + nu) / (np.pi * youngs_modulus) * u)

"""The ellipse of Hertz with the moments of a pressure."""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.geometry.points import ContactPoints


@dataclass(frozen=True)
class ContactEllipse:
    """Semi-axes and peak pressure of the ellipse of Hertz with the moments of a pressure field.

    Hertz's pressure ``p0 sqrt(1 - x^2/a^2 - y^2/b^2)`` has ``<x^2> = a^2/5`` under its own
    weight and ``F = 2/3 pi a b p0``. Integrals, unlike the outermost active point, vary
    smoothly with the load and converge quickly with the mesh.

    Attributes
    ----------
    along, across : float
        Semi-axes in x and y, m.
    peak_pressure : float
        p0 in Pa.
    centre : tuple of float
        Centre of pressure (x, y) in m; y = 0 on a plane of symmetry.
    """

    along: float
    across: float
    peak_pressure: float
    centre: tuple[float, float]


def contact_ellipse(points: ContactPoints, forces: Array) -> ContactEllipse:
    """Ellipse with the resultant and second moments of a pressure field.

    `forces` are the normal ones (n,) at the points in N, not all zero.
    """
    x, y = points.x_of_points, points.y_of_points
    total = float(forces.sum())
    if not total > 0:
        raise InputError("contact ellipse: there is no contact")
    cx = float(forces @ x) / total
    cy = 0.0 if points.symmetric else float(forces @ y) / total
    a = float(np.sqrt(5 * (forces @ (x - cx) ** 2) / total))
    b = float(np.sqrt(5 * (forces @ (y - cy) ** 2) / total))
    return ContactEllipse(a, b, 1.5 * total / (np.pi * a * b), (cx, cy))

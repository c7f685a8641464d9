"""Integrals of a cross-section, its Timoshenko shear coefficients and its torsion constant."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.exceptions import InputError
from contactstudy.profiles.shear import integration_mesh, shear_coefficient, torsion_constant


@dataclass(frozen=True)
class SectionProperties:
    """What a beam needs to know of a cross-section, about its centroid.

    Parameters
    ----------
    area : float
        Area [m^2].
    second_moment_y : float
        About the lateral axis: vertical bending [m^4].
    second_moment_z : float
        About the vertical axis: lateral bending [m^4].
    centroid_z : float
        Height of the centroid in the profile's coordinates [m].
    shear_coefficient_z, shear_coefficient_y : float
        Timoshenko's kappa for vertical and for lateral shear, after Cowper [-].
    torsion_constant : float
        Saint-Venant's J [m^4].
    """

    area: float
    second_moment_y: float
    second_moment_z: float
    centroid_z: float
    shear_coefficient_z: float
    shear_coefficient_y: float
    torsion_constant: float


def polygon_properties(
    outline: ArrayLike,
) -> tuple[float, tuple[float, float], float, float]:
    """Integrals over a polygon, exact.

    Parameters
    ----------
    outline : array_like, shape (n, 2)
        Corners (y, z), counter-clockwise, not repeated at the end [m].

    Returns
    -------
    area : float
        [m^2], positive if counter-clockwise.
    centroid : tuple of float
        (y, z) [m].
    second_moment_y, second_moment_z : float
        Integrals of z^2 and of y^2 about the centroid [m^4].
    """
    p = np.asarray(outline, dtype=float)
    origin = p.mean(axis=0)
    y, z = (p - origin).T
    y1, z1 = np.roll(y, -1), np.roll(z, -1)
    cross = y * z1 - y1 * z  # Green's theorem, edge by edge
    area = cross.sum() / 2.0
    cy = ((y + y1) * cross).sum() / (6.0 * area)
    cz = ((z + z1) * cross).sum() / (6.0 * area)
    zz = ((z * z + z * z1 + z1 * z1) * cross).sum() / 12.0 - area * cz * cz
    yy = ((y * y + y * y1 + y1 * y1) * cross).sum() / 12.0 - area * cy * cy
    return float(area), (float(origin[0] + cy), float(origin[1] + cz)), float(zz), float(yy)


def section_properties(
    nodes: ArrayLike, quads: ArrayLike, poisson_ratio: float, symmetric: bool = False
) -> SectionProperties:
    """Integrals over a conforming mesh of bilinear quadrilaterals, and what follows from them.

    The area integrals are exact for the meshed section. The shear coefficients are Cowper's (1966),
    from Saint-Venant's flexure function computed on the same mesh; J is from his warping function.

    The nodes (n, 2) are (y, z) [m]; quads (m, 4) turn counter-clockwise. A symmetric mesh is the
    half y >= 0 of a section symmetric about y = 0; the properties are those of the whole.

    Raises
    ------
    InputError
        If an element is degenerate or clockwise, if a half mesh reaches beyond y = 0, or if y
        and z are not principal directions.
    """
    x = np.asarray(nodes, dtype=float)
    mesh = integration_mesh(x, np.asarray(quads, dtype=np.int64))
    if np.any(mesh.weight <= 0.0):
        bad = int(np.argmin(mesh.weight.min(axis=1)))
        raise InputError(f"section mesh: element {bad} is degenerate or not counter-clockwise")
    if symmetric and x[:, 0].min() < -1e-9:
        raise InputError("section mesh: a symmetric half must lie at y >= 0")
    whole = 2.0 if symmetric else 1.0
    area = whole * mesh.weight.sum()
    centre = whole * np.einsum("mg,mgd->d", mesh.weight, mesh.point) / area
    if symmetric:
        centre[0] = 0.0
    y, z = np.moveaxis(mesh.point - centre, -1, 0)
    second_y = whole * (mesh.weight * z * z).sum()
    second_z = whole * (mesh.weight * y * y).sum()
    # a mesh finer on one side of a symmetric outline turns the axes by some 1e-4 rad
    if not symmetric and abs((mesh.weight * y * z).sum()) > 1e-3 * max(second_y, second_z):
        raise InputError("section mesh: y and z must be principal directions of the section")
    # vertical shear: the flexure function is even in y, the plane y = 0 is free; lateral: odd, and
    # so is the warping function
    on_plane = np.flatnonzero(np.abs(x[:, 0]) < 1e-9) if symmetric else None
    return SectionProperties(
        area=float(area),
        second_moment_y=float(second_y),
        second_moment_z=float(second_z),
        centroid_z=float(centre[1]),
        shear_coefficient_z=shear_coefficient(mesh, centre, 1, poisson_ratio),
        shear_coefficient_y=shear_coefficient(mesh, centre, 0, poisson_ratio, on_plane),
        torsion_constant=whole * torsion_constant(mesh, on_plane),
    )

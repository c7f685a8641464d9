"""Stresses below pressed blocks: of their finite elements and of the recovered pressure."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from contactstudy.arrays import Array
from contactstudy.compare.refinement import fitted_order
from contactstudy.contact.complementarity import press
from contactstudy.geometry.quadrature import point_line
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.halfspace.pressure_field import recovered_pressure
from contactstudy.halfspace.subsurface import stress_maxima
from contactstudy.solids.stress import maximum_shear, von_mises
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.halfspace_block import HalfSpaceBlock
from contactstudy.verification.cases.line_contact import line_contact
from contactstudy.verification.cases.pressed_blocks import block_points
from contactstudy.verification.cases.strip import Strip

MODULUS = contact_modulus()
RADIUS = 0.3
SIZE = 1e-3
PENALTY = 1e17
SPHERE_ELEMENTS = (3.0, 4.5, 6.0, 9.0)
LINE_ELEMENTS = (4.0, 8.0, 16.0)


@dataclass(frozen=True)
class LargestStresses:
    """Largest stresses below one patch, relative to Hertz's peak pressure and semi-axis.

    Attributes
    ----------
    elements : float
        Elements over the semi-axis.
    shear, depth, mises : float
        Of the finite elements' nodal stresses on the axis.
    field_shear, field_depth, field_mises : float
        Of the half-space under the nodal pressure, as `contactstudy run` gives them; nan where
        there is none.
    """

    elements: float
    shear: float
    depth: float
    mises: float
    field_shear: float = np.nan
    field_depth: float = np.nan
    field_mises: float = np.nan


def peak(depth: Array, value: Array) -> tuple[float, float]:
    """Largest value and its place, of the cubic spline through nodal values."""
    spline, k = CubicSpline(depth, value), int(np.argmax(value[1:])) + 1
    found = minimize_scalar(
        lambda z: -float(spline(z)), bounds=(depth[k - 1], depth[k + 1]), method="bounded"
    )
    return -float(found.fun), float(found.x)


@cache
def sphere_stresses(elements: tuple[float, ...] = SPHERE_ELEMENTS) -> tuple[LargestStresses, ...]:
    """Press two equal blocks over a sphere's gap; one mesh, patches of growing size.

    `elements` are those over the radius of the patch.
    """
    widest = max(elements)
    n = int(np.ceil(1.15 * widest)) + 1
    x = graded_lines((n - 1) * SIZE, SIZE, 6 * widest * SIZE, growth=1.5)
    z = graded_lines(0.75 * widest * SIZE, SIZE, 6 * widest * SIZE, growth=1.5)
    block, loaded = HalfSpaceBlock(x, x, z), (slice(0, n), slice(0, n))
    points = block_points(x[:n], x[:n], (RADIUS, RADIUS), "gauss")
    tread = points.wheel_rows.matrix(n * n)
    M = 2 * tread @ block.patch(loaded).flexibility @ tread.T + np.diag(1 / (PENALTY * points.area))
    found = []
    for count in elements:
        a = count * SIZE
        # a^3 = 3 F R/(4 E*)
        hertz = hertz_contact(4 * MODULUS * a**3 / (3 * RADIUS), MODULUS, RADIUS, RADIUS)
        forces = press(M, points.gap, points.normal_z, hertz.load).forces
        u = block.displacement(loaded, (tread.T @ forces)[:, None])[..., 0]
        axis, p0 = block.stress(u)[0, 0], hertz.peak_pressure
        shear, depth = peak(z, maximum_shear(axis))
        pressure = points.nodal_pressure(forces).reshape(n, n)
        index = np.abs(np.arange(1 - n, n))
        whole = np.concatenate([-x[n - 1 : 0 : -1], x[:n]])
        mises_field, shear_field = stress_maxima(
            recovered_pressure(whole, whole, pressure[index[:, None], index])
        )
        nodal = (shear / p0, depth / a, peak(z, von_mises(axis))[0] / p0)
        field = (shear_field.value / p0, shear_field.depth / a, mises_field.value / p0)
        found.append(LargestStresses(count, *nodal, *field))
    return tuple(found)


@cache
def line_stresses(elements: tuple[float, ...] = LINE_ELEMENTS) -> tuple[LargestStresses, ...]:
    """Press two equal strips in plane strain over a cylinder's gap.

    `elements` are those over the half width of the contact.
    """
    found, half_width = [], 6e-3
    # b = 2 sqrt(P R/(pi E*))
    hertz = line_contact(np.pi * MODULUS * half_width**2 / (4 * RADIUS), MODULUS, RADIUS)
    load = np.pi / 2 * hertz.peak_pressure * half_width
    for count in elements:
        h = half_width / count
        n = int(np.ceil(1.2 * count)) + 1
        strip = Strip(
            graded_lines((n - 1) * h, h, 10 * half_width, growth=1.2),
            graded_lines(1.2 * half_width, h, 10 * half_width, growth=1.2),
        )
        unit = strip.displacement(n)
        points = point_line(strip.x[:n], "gauss")
        tread = points.rows.matrix(n)
        W = tread @ unit[:n, 0, 1] @ tread.T
        M = W + W.T + np.diag(1 / (PENALTY * 2 * points.weight))
        forces = press(M, points.at**2 / (2 * RADIUS), np.ones(len(points.at)), load).forces
        axis = strip.stress(unit @ (tread.T @ forces))[0]
        shear, depth = peak(strip.depth, maximum_shear(axis))
        mises = peak(strip.depth, von_mises(axis))[0]
        p0 = hertz.peak_pressure
        found.append(LargestStresses(count, shear / p0, depth / half_width, mises / p0))
    return tuple(found)


def shear_order(rows: tuple[LargestStresses, ...], reference: float) -> float:
    """Order of the shear's error between the two finest meshes."""
    sizes = [1.0 / row.elements for row in rows[-2:]]
    return fitted_order(sizes, [abs(row.shear - reference) for row in rows[-2:]])

"""Two-node beam elements in space: bending in two planes, torsion, extension.

Nodal dofs are (ux, uy, uz, rx, ry, rz): displacements [m] and the rotation vector [rad] of a
section whose centroid is also its shear centre. With w' = -ry and v' = rz both bending planes are
the element of `contactstudy.track.hermite`; extension and torsion are linear along the element.
A point of the section at (y, z) from its centroid moves by u + r x (0, y, z).
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.track.hermite import BeamElement

N_DOFS = 6
"""Dofs of a node."""
UX, UY, UZ, RX, RY, RZ = range(N_DOFS)
Axis = Literal["X", "Y", "Z"]

# dofs of a (w, theta) element, and the sign of each: theta = w' = -ry, theta = v' = rz
_VERTICAL = np.array([UZ, RY, N_DOFS + UZ, N_DOFS + RY])
_VERTICAL_SIGNS = np.array([1.0, -1.0, 1.0, -1.0])
_LATERAL = np.array([UY, RZ, N_DOFS + UY, N_DOFS + RZ])


@dataclass(frozen=True)
class SpaceBeam:
    """What a straight, uniform beam is, its axis along X.

    Parameters
    ----------
    axial_stiffness : float
        EA [N].
    bending_stiffness, lateral_bending_stiffness : float
        EI [N m^2] for deflection along Z and along Y.
    torsion_stiffness : float
        GJ [N m^2], Saint-Venant's.
    mass_per_length : float
        [kg/m].
    polar_inertia : float
        Mass moment of inertia about the axis, per length [kg m].
    shear_stiffness, lateral_shear_stiffness : float
        kappa G A [N]; infinite for Euler-Bernoulli.
    rotary_inertia, lateral_rotary_inertia : float
        Per length, for bending along Z and Y [kg m]; zero for Euler-Bernoulli.
    """

    axial_stiffness: float
    bending_stiffness: float
    lateral_bending_stiffness: float
    torsion_stiffness: float
    mass_per_length: float
    polar_inertia: float
    shear_stiffness: float = np.inf
    lateral_shear_stiffness: float = np.inf
    rotary_inertia: float = 0.0
    lateral_rotary_inertia: float = 0.0

    def bending(self, length: float) -> tuple[BeamElement, BeamElement]:
        """The element in the vertical and in the lateral plane."""
        return (
            BeamElement(
                length,
                self.bending_stiffness,
                self.mass_per_length,
                self.shear_stiffness,
                self.rotary_inertia,
            ),
            BeamElement(
                length,
                self.lateral_bending_stiffness,
                self.mass_per_length,
                self.lateral_shear_stiffness,
                self.lateral_rotary_inertia,
            ),
        )

    def stiffness(self, length: float) -> Array:
        """Stiffness matrix (12, 12) of an element of a length [m]."""
        vertical, lateral = self.bending(length)
        bar = np.array([[1.0, -1.0], [-1.0, 1.0]]) / length
        return _placed(
            vertical.stiffness(),
            lateral.stiffness(),
            self.axial_stiffness * bar,
            self.torsion_stiffness * bar,
        )

    def mass(self, length: float) -> Array:
        """Consistent mass matrix (12, 12)."""
        vertical, lateral = self.bending(length)
        bar = np.array([[2.0, 1.0], [1.0, 2.0]]) * length / 6.0
        return _placed(
            vertical.mass(), lateral.mass(), self.mass_per_length * bar, self.polar_inertia * bar
        )

    def motion(self, length: Array, xi: Array) -> Array:
        """Shape functions (m, 6, 12) of u and r of the section at xi = x/L (m,), in 0..1."""
        length, xi = np.broadcast_arrays(np.asarray(length, float), np.asarray(xi, float))
        shapes = np.zeros((len(xi), N_DOFS, 2 * N_DOFS))
        for dof in (UX, RX):
            shapes[:, dof, dof], shapes[:, dof, N_DOFS + dof] = 1.0 - xi, xi
        for one in np.unique(length):
            here = np.flatnonzero(length == one)
            vertical, lateral = self.bending(float(one))
            at = here[:, None]
            shapes[at, UZ, _VERTICAL] = vertical.deflection_shapes(xi[here]) * _VERTICAL_SIGNS
            shapes[at, RY, _VERTICAL] = -vertical.rotation_shapes(xi[here]) * _VERTICAL_SIGNS
            shapes[at, UY, _LATERAL] = lateral.deflection_shapes(xi[here])
            shapes[at, RZ, _LATERAL] = lateral.rotation_shapes(xi[here])
        return shapes


def _placed(vertical: Array, lateral: Array, axial: Array, torsion: Array) -> Array:
    matrix = np.zeros((2 * N_DOFS, 2 * N_DOFS))
    matrix[np.ix_(_VERTICAL, _VERTICAL)] = vertical * np.outer(_VERTICAL_SIGNS, _VERTICAL_SIGNS)
    matrix[np.ix_(_LATERAL, _LATERAL)] = lateral
    for dof, bar in ((UX, axial), (RX, torsion)):
        ends = [dof, N_DOFS + dof]
        matrix[np.ix_(ends, ends)] = bar
    return matrix


def displacement(axis: Axis, arm: tuple[float, float, float]) -> Array:
    """Row (6,) over a section's motion: displacement of a point along an axis.

    The point is rigidly joined to the section at `arm` (x, y, z) from its centroid [m]:
    u + r x arm.
    """
    x, y, z = arm
    rows = {
        "X": (1.0, 0.0, 0.0, 0.0, z, -y),
        "Y": (0.0, 1.0, 0.0, -z, 0.0, x),
        "Z": (0.0, 0.0, 1.0, y, -x, 0.0),
    }
    return np.array(rows[axis])


def along_z(matrix: Array) -> Array:
    """An element's matrix (12, 12) turned so that its axis, x of the element, points up.

    The element's y stays lateral: x, y, z of the element are Z, Y, -X.
    """
    turn = np.zeros((3, 3))
    turn[0, 2], turn[1, 1], turn[2, 0] = 1.0, 1.0, -1.0
    whole = np.kron(np.eye(4), turn)  # element = whole @ global
    return np.asarray(whole.T @ matrix @ whole)

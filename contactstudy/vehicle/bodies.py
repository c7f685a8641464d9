"""Rigid bodies joined by springs: mass, damping and stiffness from their energies.

A body has the dofs of small motion that it is given. A point r off its centre moves by

    u = (0, y, z) + theta x r,    theta = (roll, pitch, yaw) about X, Y, Z,

so u_y = y + yaw r_x - roll r_z and u_z = z + roll r_y - pitch r_x. Bodies keep their distance
along the track, so u_x = -yaw r_y only: its share of pitch would need their motion along X.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array

PLANAR = ("z", "pitch")
"""Dofs in the vertical plane."""
SPATIAL = ("y", "z", "roll", "pitch", "yaw")


@dataclass(frozen=True)
class Body:
    """A rigid body: its centre (x, y, z) [m], mass [kg], inertias about X, Y, Z [kg m^2]."""

    name: str
    centre: tuple[float, float, float]
    mass: float
    inertia: tuple[float, float, float]
    dofs: tuple[str, ...]

    def masses(self) -> list[float]:
        """Mass or inertia of each dof."""
        turning = dict(zip(("roll", "pitch", "yaw"), self.inertia, strict=True))
        return [turning.get(dof, self.mass) for dof in self.dofs]

    def row(self, point: Sequence[float], direction: str) -> Array:
        """(n_dofs,) displacement of a point [m] of the body in "X", "Y" or "Z"."""
        x, y, z = (p - c for p, c in zip(point, self.centre, strict=True))
        of_dof = {
            "X": {"yaw": -y},
            "Y": {"y": 1.0, "yaw": x, "roll": -z},
            "Z": {"z": 1.0, "roll": y, "pitch": -x},
        }[direction]
        return np.array([of_dof.get(dof, 0.0) for dof in self.dofs])


@dataclass(frozen=True)
class Spring:
    """Stiffness [N/m] and damping [N s/m] in one direction between points of two bodies."""

    lower: str
    upper: str
    point: tuple[float, float, float]
    direction: str
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Turning:
    """Stiffness [N m/rad] against the relative roll of two bodies."""

    lower: str
    upper: str
    stiffness: float


@dataclass(frozen=True)
class Bodies:
    """Bodies in the order of their dofs, and the springs between them."""

    bodies: tuple[Body, ...]
    springs: tuple[Spring, ...]
    turning: tuple[Turning, ...] = ()

    @property
    def dof_names(self) -> tuple[str, ...]:
        """Body and dof."""
        return tuple(f"{body.name} {dof}" for body in self.bodies for dof in body.dofs)

    def row(self, name: str, point: Sequence[float], direction: str) -> Array:
        """(n,) displacement of a point of a body in a direction, of all dofs."""
        parts = [
            body.row(point, direction) if body.name == name else np.zeros(len(body.dofs))
            for body in self.bodies
        ]
        return np.concatenate(parts)

    def matrices(self) -> tuple[Array, Array, Array]:
        """Mass, damping and stiffness: sums of c a a^T over the extensions a.u of the springs."""
        mass = np.diag([m for body in self.bodies for m in body.masses()])
        damping, stiffness = np.zeros_like(mass), np.zeros_like(mass)
        for spring in self.springs:
            at = spring.point, spring.direction
            a = self.row(spring.upper, *at) - self.row(spring.lower, *at)
            stiffness += spring.stiffness * np.outer(a, a)
            damping += spring.damping * np.outer(a, a)
        names = self.dof_names
        for bar in self.turning:
            a = np.zeros(len(names))
            a[names.index(f"{bar.upper} roll")] = 1.0
            a[names.index(f"{bar.lower} roll")] = -1.0
            stiffness += bar.stiffness * np.outer(a, a)
        return mass, damping, stiffness

"""Quasi-static elastic wheel: flexibility of its tread nodes in the contact zone.

The wheel is a solid of revolution, meshed by slices between planes through its axis. It does
not turn: an axisymmetric wheel looks the same at every angle, so only its bottom is meshed
finely. The bore is held: displacements are relative to the hub. The mirror symmetry about the
vertical plane x = 0 is used: each load is the sum of a symmetric and an antisymmetric one on
half the ring, and both are solved by block elimination over the angle. All inertia of the
wheel is in the vehicle model's wheel mass.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from contactstudy.exceptions import InputError
from contactstudy.profiles.rail import rail_profile
from contactstudy.profiles.wheel import wheel_profile
from contactstudy.solids.chain import BlockTridiagonal, Slice, chain_blocks
from contactstudy.solids.ring import ring_slice
from contactstudy.solids.wheel_section import (
    WheelDimensions,
    WheelSection,
    fine_lines,
    wheel_section_mesh,
)

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class WheelRecipe:
    """What an elastic wheel is made from; two equal recipes give equal wheels.

    Attributes
    ----------
    profile : str
        Wheel profile; even in y.
    rail_profile : str
        Gives the direction of the contact forces: its outward normal at each y.
    dimensions : WheelDimensions
        Of the section.
    size : float
        Element size at the tread in m (lateral, depth and along the circumference).
    contact_half_length, contact_half_width : float
        Extent of the contact zone along and across the rail on each side in m.
    youngs_modulus, poisson_ratio : float
        Material, E in Pa.
    """

    profile: str = "cylinder"
    rail_profile: str = "60E1"
    dimensions: WheelDimensions = field(default_factory=WheelDimensions)
    size: float = 0.002
    contact_half_length: float = 0.012
    contact_half_width: float = 0.008
    youngs_modulus: float = 210e9
    poisson_ratio: float = 0.3

    def __post_init__(self) -> None:
        """Refuse what cannot be meshed; all problems at once."""
        problems = []
        if not 0 < self.size <= 0.008:
            problems.append(f"wheel size = {self.size} m: must be above 0 and at most 0.008 m")
        for name, value in (
            ("contact_half_length", self.contact_half_length),
            ("contact_half_width", self.contact_half_width),
        ):
            if not self.size <= value <= 0.04:
                problems.append(
                    f"wheel {name} = {value} m: must be at least the size and at most 0.04 m"
                )
        if problems:
            raise InputError(problems)

    @property
    def angles(self) -> Array:
        """Angles of the planes from the bottom (0) to the top (pi) in rad.

        Equal arcs of about `size` in the contact zone, then steps that grow by half each time
        up to 12 degrees.
        """
        R = self.dimensions.radius
        n = max(2, round(self.contact_half_length / self.size))
        fine = self.size / R * np.arange(n + 1)
        steps: list[float] = []
        while fine[-1] + sum(steps) < np.pi:
            steps.append(min(self.size / R * 1.5 ** (len(steps) + 1), np.pi / 15))
        coarse = np.cumsum(steps) * (np.pi - fine[-1]) / sum(steps)
        return np.concatenate([fine, fine[-1] + coarse])

    @property
    def x(self) -> Array:
        """Grid lines of the contact zone along the rail, symmetric about 0, in m."""
        n = max(2, round(self.contact_half_length / self.size))
        right = self.dimensions.radius * np.sin(self.angles[: n + 1])
        return np.concatenate([-right[:0:-1], right])

    @property
    def y(self) -> Array:
        """Grid lines of the contact zone across the rail from 0 in m."""
        return fine_lines(self.contact_half_width, self.size)


@dataclass(frozen=True)
class WheelFlexibility:
    """Elastic wheel as the contact sees it.

    Node ``ix*len(y) + iy`` of the tread lies at ``(x[ix], y[iy])``. A nodal force is the total
    of the node and its mirror image about y = 0; forces and displacements are along the rail's
    outward normal (upwards).

    Attributes
    ----------
    recipe : WheelRecipe
        What it was made from.
    x, y : ndarray (nx,), (ny,)
        Grid lines in m.
    flexibility : ndarray (n, n)
        Displacement relative to the hub in m/N.
    section_nodes : ndarray (k, 2)
        Half section in the plane x = 0: y and the height z above the lowest point, in m.
    section_quads : ndarray of int (m, 4)
        Its quadrilaterals.
    section_response : ndarray (k, 2, n)
        Displacement (y, z) of the section relative to the hub for unit nodal forces in m/N.
    """

    recipe: WheelRecipe
    x: Array
    y: Array
    flexibility: Array
    section_nodes: Array
    section_quads: IntArray
    section_response: Array


def rigid_wheel(recipe: WheelRecipe) -> WheelFlexibility:
    """Wheel with the recipe's tread grid that does not deform."""
    section = _section(recipe)
    n = len(recipe.x) * len(recipe.y)
    return WheelFlexibility(
        recipe,
        recipe.x,
        recipe.y,
        np.zeros((n, n)),
        _upright(recipe, section),
        section.quads,
        np.zeros((len(section.nodes), 2, n)),
    )


def elastic_wheel(recipe: WheelRecipe) -> WheelFlexibility:
    """Condense a wheel to its tread nodes in the contact zone.

    Parameters
    ----------
    recipe : WheelRecipe
        Mesh and material.

    Returns
    -------
    WheelFlexibility
    """
    section = _section(recipe)
    angles = recipe.angles
    pieces: dict[float, Slice] = {}
    slices = []
    for step in np.diff(angles):
        key = round(float(step), 12)
        if key not in pieces:
            pieces[key] = ring_slice(section, key, recipe.youngs_modulus, recipe.poisson_ratio)
        slices.append(pieces[key])
    diagonal, upper = chain_blocks(slices)
    n_loaded = len(recipe.x) // 2 + 1
    loads = _normal_loads(recipe, section, angles[:n_loaded])
    ny, n = len(section.tread), len(diagonal[0])
    results = []
    for symmetric in (True, False):
        free = [_free(section, i in (0, len(angles) - 1), symmetric) for i in range(len(angles))]
        # from the top down, so that the loaded planes are eliminated last
        order = range(len(angles) - 1, -1, -1)
        factor = BlockTridiagonal(
            [diagonal[i][np.ix_(free[i], free[i])] for i in order],
            [upper[i][np.ix_(free[i], free[i + 1])].T for i in range(len(angles) - 2, -1, -1)],
        )
        rhs = []
        for i in order:
            b = np.zeros((len(free[i]), n_loaded * ny))
            if i < n_loaded:
                # half of the load belongs to this symmetry
                b[:, i * ny : (i + 1) * ny] = 0.5 * loads[i][:, free[i]].T
            rhs.append(b)
        solution = factor.solve(rhs)[::-1]
        u = np.zeros((n_loaded, n, n_loaded * ny))
        for i in range(n_loaded):
            u[i][free[i]] = solution[i]
        results.append(u)
    even, odd = (np.concatenate([loads[i] @ u[i] for i in range(n_loaded)]) for u in results)
    F = _unfold(even, odd, n_loaded, ny)
    # plane x = 0: only the symmetric part moves in y and z; components there are
    # (radial outwards = down, y, tangential), see `ring_slice`
    bottom = results[0][0].reshape(len(section.nodes), 3, n_loaded, ny)
    response = np.stack([bottom[:, 1], -bottom[:, 0]], axis=1)
    response = np.concatenate([response[:, :, :0:-1], response], axis=2)
    return WheelFlexibility(
        recipe,
        recipe.x,
        recipe.y,
        0.5 * (F + F.T),
        _upright(recipe, section),
        section.quads,
        response.reshape(len(section.nodes), 2, -1),
    )


def _section(recipe: WheelRecipe) -> WheelSection:
    return wheel_section_mesh(
        recipe.dimensions, wheel_profile(recipe.profile), recipe.size, recipe.contact_half_width
    )


def _upright(recipe: WheelRecipe, section: WheelSection) -> Array:
    """Section nodes as (y, z), z up from the lowest point of the tape circle."""
    y, rho = section.nodes.T
    return np.stack([y, recipe.dimensions.radius - rho], axis=1)


def _free(section: WheelSection, on_mirror: bool, symmetric: bool) -> IntArray:
    """Degrees of freedom of a plane that are not held."""
    held = np.zeros((len(section.nodes), 3), dtype=bool)
    held[section.bore] = True
    held[section.plane_of_symmetry, 1] = True
    if on_mirror:
        held[:, [2] if symmetric else [0, 1]] = True
    return np.flatnonzero(~held.ravel())


def _normal_loads(recipe: WheelRecipe, section: WheelSection, angles: Array) -> list[Array]:
    """Unit forces along the rail's outward normal at the tread nodes, (ny, 3n) a plane."""
    y = section.nodes[section.tread, 0]
    slope = np.asarray(rail_profile(recipe.rail_profile).running_slope(y))
    normal_z = 1 / np.sqrt(1 + slope**2)
    normal_y = -slope * normal_z
    rows = np.arange(len(y))
    loads = []
    for theta in angles:
        load = np.zeros((len(y), 3 * len(section.nodes)))
        # up = -cos(theta) radial + sin(theta) tangential (theta grows from the bottom)
        load[rows, 3 * section.tread] = -np.cos(theta) * normal_z
        load[rows, 3 * section.tread + 1] = normal_y
        load[rows, 3 * section.tread + 2] = np.sin(theta) * normal_z
        loads.append(load)
    return loads


def _unfold(even: Array, odd: Array, n: int, ny: int) -> Array:
    """Flexibility of the whole zone from its symmetric and antisymmetric halves (n lines each)."""
    right = np.arange(n - 1, 2 * n - 1)  # lines x >= 0 of the whole zone
    left = right[0] - np.arange(n)
    F = np.empty((2 * n - 1, ny, 2 * n - 1, ny))
    E, D = even.reshape(n, ny, n, ny), odd.reshape(n, ny, n, ny)
    for rows, columns, sign in (
        (right, right, 1),
        (left, right, -1),
        (right, left, -1),
        (left, left, 1),
    ):
        F[np.ix_(rows, np.arange(ny), columns, np.arange(ny))] = E + sign * D
    return F.reshape((2 * n - 1) * ny, -1)

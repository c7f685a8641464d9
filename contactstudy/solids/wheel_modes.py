"""Elastic modes of a wheel on a rigid hub, and what they leave of its flexibility.

The displacement of a wheel relative to its hub is that of its modes up to a chosen frequency,
with their inertia, and the static rest of all others, the residual flexibility.

The modes are found in two steps. A ring of equal slices has modes with a whole number n of waves
round the wheel, each from a small eigenvalue problem on one plane (`ring_modes`). These are
the basis (Rayleigh and Ritz) of the modes of the very mesh that carries the contact, finer at
the bottom. So modes and static flexibility belong to one stiffness matrix K, and the residual

    B^T (K^-1 - Phi Omega^-2 Phi^T) B

is positive semi-definite for any basis: the second term is the Galerkin solution of the first.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp

from contactstudy.arrays import Array, IntArray
from contactstudy.exceptions import InputError
from contactstudy.solids.ring import slice_mass, slice_stiffness
from contactstudy.solids.ring_modes import ring_families
from contactstudy.solids.wheel import WheelFlexibility, held_dofs, normal_loads
from contactstudy.solids.wheel_recipe import WheelRecipe
from contactstudy.solids.wheel_section import WheelSection
from contactstudy.validation import positive, raise_if


@dataclass(frozen=True)
class ModesRecipe:
    """What the modes of a wheel are made from.

    Attributes
    ----------
    wheel : WheelRecipe
        Best with ``far_step = FAR_STEP_OF_MODES``.
    highest : float
        Highest natural frequency in Hz.
    """

    wheel: WheelRecipe
    highest: float = 5000.0

    def __post_init__(self) -> None:
        """Refuse an impossible frequency."""
        raise_if(positive("wheel modes: highest frequency", self.highest, "Hz"))


@dataclass(frozen=True)
class WheelModes:
    """Modes of a wheel whose bore is held, mass-normalised.

    Attributes
    ----------
    recipe : ModesRecipe
        What they were made from.
    frequencies : ndarray (m,)
        Natural frequencies in Hz, increasing.
    waves : ndarray of int (m,)
        Waves round the wheel.
    shapes : ndarray (m, n)
        Displacement of the tread nodes along the contact normal, as in `WheelFlexibility`,
        in 1/sqrt(kg).
    participation : ndarray (m,)
        L = integral of rho phi_z over the wheel, the coupling with the hub's vertical motion,
        in sqrt(kg).
    section_shapes : ndarray (m, k, 2)
        Displacement (y, z) of the section in the plane x = 0 in 1/sqrt(kg).
    mass, inertia : ndarray ()
        Of the meshed wheel in kg, and about its axle in kg m^2.
    """

    recipe: ModesRecipe
    frequencies: Array
    waves: IntArray
    shapes: Array
    participation: Array
    section_shapes: Array
    mass: Array
    inertia: Array

    @property
    def stiffness(self) -> Array:
        """Squared angular natural frequencies (m,) in 1/s^2."""
        return np.asarray((2 * np.pi * self.frequencies) ** 2)


def wheel_modes(recipe: ModesRecipe) -> WheelModes:
    """Modes up to a frequency, by growing frequency, the two mirror symmetries in x together.

    Raises
    ------
    NumericalError
        If an eigenvalue problem is not solved.
    """
    wheel = recipe.wheel
    section, angles = wheel.section(), wheel.angles
    steps = [round(float(step), 12) for step in np.diff(angles)]
    stiffness = {
        step: slice_stiffness(section, step, wheel.youngs_modulus, wheel.poisson_ratio)
        for step in set(steps)
    }
    mass = {step: slice_mass(section, step, wheel.density) for step in set(steps)}
    free = ~held_dofs(section)
    material = wheel.youngs_modulus, wheel.poisson_ratio, wheel.density
    # somewhat more than wanted, so that the highest ones are not left without neighbours
    families = ring_families(section, free, steps[-1], material, 1.1 * recipe.highest)
    n_loaded, n_tread = len(wheel.x) // 2 + 1, len(wheel.x) * len(wheel.y)
    loads = normal_loads(wheel, section, angles[:n_loaded])
    found = []
    for symmetric in (True, False):
        basis = [part for f in families if len((part := f.part(symmetric)).squares)]
        # last column: upright motion of the rigid wheel, or its rotation about the axle
        planes = [
            np.column_stack([f.at(t, symmetric) for f in basis] + [_rigid(section, t, symmetric)])
            for t in angles
        ]
        # the half ring and its mirror image
        M = 2 * _gram(planes, [mass[step] for step in steps])
        K = 2 * _gram(planes, [stiffness[step] for step in steps])
        waves = np.array([f.waves for f in basis for _ in f.squares], dtype=np.int64)
        m = len(waves)
        squares, vectors = sl.eigh(K[:m, :m], M[:m, :m]) if m else (np.zeros(0), np.zeros((0, 0)))
        kept = squares <= (2 * np.pi * recipe.highest) ** 2
        vectors = vectors[:, kept]
        leading = np.abs(vectors).argmax(axis=0) if kept.any() else np.zeros(0, dtype=np.int64)
        vectors = vectors * np.sign(vectors[leading, np.arange(len(leading))])
        moved = [plane[:, :m] @ vectors for plane in planes[:n_loaded]]
        right = np.stack([load @ u for load, u in zip(loads, moved, strict=True)])  # (nx', ny, m)
        left = right[:0:-1] if symmetric else -right[:0:-1]
        bottom = moved[0].reshape(len(section.nodes), 3, vectors.shape[1])
        found.append(
            {
                "frequencies": np.sqrt(squares[kept]) / (2 * np.pi),
                "waves": waves[leading],
                "shapes": np.concatenate([left, right]).reshape(n_tread, vectors.shape[1]).T,
                "participation": vectors.T @ M[:m, m] * symmetric,
                "section_shapes": np.stack([bottom[:, 1], -bottom[:, 0]], axis=1).T.swapaxes(1, 2),
                "rigid": M[m:, m],
            }
        )
    even, odd = found
    order = np.argsort(np.concatenate([even["frequencies"], odd["frequencies"]]), kind="stable")
    joined = {key: np.concatenate([even[key], odd[key]])[order] for key in even if key != "rigid"}
    return WheelModes(
        recipe=recipe,
        mass=np.asarray(even["rigid"][0]),
        inertia=np.asarray(odd["rigid"][0]),
        **joined,
    )


def residual_flexibility(wheel: WheelFlexibility, modes: WheelModes) -> WheelFlexibility:
    """The wheel without the static flexibility of its modes, F - Phi Omega^-2 Phi^T.

    Raises
    ------
    InputError
        If the modes are those of another wheel.
    """
    if modes.recipe.wheel != wheel.recipe:
        raise InputError("wheel modes: they belong to another wheel than the flexibility")
    part = modes.shapes / modes.stiffness[:, None]
    return replace(
        wheel,
        flexibility=wheel.flexibility - modes.shapes.T @ part,
        section_response=wheel.section_response
        - np.einsum("mkc,mn->kcn", modes.section_shapes, part),
    )


def _gram(planes: list[Array], matrices: list[sp.csr_array]) -> Array:
    """Sum over the slices of U^T A U, U the displacements of a slice's two planes."""
    total = np.zeros((planes[0].shape[1],) * 2)
    for first, second, A in zip(planes[:-1], planes[1:], matrices, strict=True):
        U = np.concatenate([first, second])
        total += U.T @ (A @ U)
    return 0.5 * (total + total.T)


def _rigid(section: WheelSection, theta: float, symmetric: bool) -> Array:
    """Upright motion of a plane by 1 m, or rotation about the axle by 1 rad."""
    motion = np.zeros((len(section.nodes), 3))
    if symmetric:
        motion[:] = [-np.cos(theta), 0.0, np.sin(theta)]
    else:
        motion[:, 2] = section.nodes[:, 1]
    return motion.ravel()

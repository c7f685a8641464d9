"""Cases of the elastic wheel's modes: a disc in closed form, a wheel by brute force."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import eigsh

from contactstudy.arrays import IntArray
from contactstudy.compare.refinement import convergence
from contactstudy.profiles.wheel_body import WheelDimensions
from contactstudy.solids.hexahedron import hex_mass, hex_stiffness
from contactstudy.solids.ring_modes import ring_families
from contactstudy.solids.wheel import held_dofs
from contactstudy.solids.wheel_modes import ModesRecipe, wheel_modes
from contactstudy.solids.wheel_recipe import FAR_STEP_OF_MODES, WheelRecipe
from contactstudy.solids.wheel_section import WheelSection
from contactstudy.verification.cases.annulus import Annulus
from contactstudy.verification.check import CaseResult, Cell, Check, ResultTable

COARSE = WheelRecipe(
    profile="S1002",
    symmetric=False,
    size=0.008,
    contact_half_length=0.016,
    contact_half_width=0.016,
    far_step=np.pi / 15,
)
"""Wheel that can be solved with every dof of the whole ring at once."""

NEEDS_WAVES = (0, 1, 2, 3, 4)


def disc() -> CaseResult:
    """Annular disc clamped at its bore, against plane stress and Kirchhoff's plate."""
    annulus = Annulus()
    exact = {"torsion": annulus.torsion(), "breathing": annulus.breathing()}
    exact |= {f"bending, {n} waves": annulus.bending(n) for n in NEEDS_WAVES}
    meshes = [disc_frequencies(annulus, elements) for elements in (10, 20, 40)]
    rows: list[tuple[Cell, ...]] = []
    for name, reference in exact.items():
        errors = [mesh[name] / reference - 1 for mesh in meshes]
        rows.append((name, reference, *(100 * e for e in errors)))
    checks = [
        Check(name, meshes[-1][name], reference, "Hz", "closed form", 0.005)
        for name, reference in exact.items()
    ]
    # of the meshes alone: Kirchhoff's plate has no shear, so it is not their limit
    order = convergence((4.0, 2.0, 1.0), [mesh["torsion"] for mesh in meshes]).order
    checks.append(Check("order of convergence, torsion", order, 2.0, "", "trilinear elements", 0.1))
    return CaseResult(
        name="wheel_disc",
        title="Modes of an annular disc clamped at its bore",
        method=(
            "A disc 4.3 mm thin, of radii 129 and 430 mm, as a ring of equal slices: modes by "
            "waves round the ring. Torsion is exact at any thickness; radial motion is plane "
            "stress; bending is Kirchhoff's plate, which neglects shear and rotary inertia "
            "(below 0.1 % here)."
        ),
        checks=tuple(checks),
        tables=(
            ResultTable(
                "Error of the frequency by elements between bore and edge",
                ("mode", "closed form (Hz)", "10 (%)", "20 (%)", "40 (%)"),
                tuple(rows),
            ),
        ),
    )


def disc_frequencies(annulus: Annulus, elements: int) -> dict[str, float]:
    """Lowest frequencies in Hz of each kind; twice as many elements a quarter."""
    section = disc_section(annulus, elements)
    material = annulus.youngs_modulus, annulus.poisson_ratio, annulus.density
    highest = 1.2 * max(annulus.torsion(), annulus.breathing())
    families = ring_families(
        section, ~held_dofs(section), np.pi / (4 * elements), material, highest
    )
    found: dict[str, float] = {}
    for family in families:
        if family.waves not in NEEDS_WAVES:
            continue
        size = np.linalg.norm(family.vectors.reshape(-1, 3, len(family.squares)), axis=0)
        kind = size.argmax(axis=0)  # 0 radial, 1 across, 2 tangential
        frequencies = np.sqrt(family.squares) / (2 * np.pi)
        found[f"bending, {family.waves} waves"] = float(frequencies[kind == 1].min())
        if family.waves == 0:
            found["torsion"] = float(frequencies[kind == 2].min())
            found["breathing"] = float(frequencies[kind == 0].min())
    return found


def disc_section(annulus: Annulus, elements: int) -> WheelSection:
    """Rectangular section with two elements through the thickness."""
    y = np.linspace(-0.5, 0.5, 3) * annulus.thickness
    rho = np.linspace(annulus.inner, annulus.outer, elements + 1)
    nodes = np.stack(np.meshgrid(y, rho), axis=-1).reshape(-1, 2)
    number = np.arange(len(nodes)).reshape(len(rho), len(y))
    quads = np.stack(
        [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1
    ).reshape(-1, 4)
    return WheelSection(nodes, quads, number[-1], number[0], symmetric=False)


def brute_force() -> CaseResult:
    """Modes and masses of a whole wheel against one sparse matrix of the whole ring."""
    modes = wheel_modes(ModesRecipe(COARSE, 2500.0))
    K, M, free = whole_ring(COARSE)
    K, M, count = K[free][:, free], M[free][:, free], len(modes.frequencies)
    squares = eigsh(K, count, M, sigma=0.0, v0=np.ones(K.shape[0]), return_eigenvectors=False)
    reference = np.sort(np.sqrt(squares)) / (2 * np.pi)
    worst = int(np.abs(modes.frequencies / reference - 1).argmax())
    outline = section_integrals(COARSE.dimensions)
    box = wheel_modes(ModesRecipe(WheelRecipe(size=0.004, far_step=FAR_STEP_OF_MODES), 1000.0))
    checks = [
        Check(
            "frequency with the largest difference",
            float(modes.frequencies[worst]),
            float(reference[worst]),
            "Hz",
            "sparse matrix of the whole ring",
            0.005,
        ),
        Check("mass", float(box.mass), outline[0], "kg", "Pappus", 0.003),
        Check("inertia about the axle", float(box.inertia), outline[1], "kg m²", "Pappus", 0.003),
    ]
    rows = tuple(
        (int(n), float(f), float(r), float(100 * (f / r - 1)))
        for n, f, r in zip(modes.waves, modes.frequencies, reference, strict=True)
    )
    return CaseResult(
        name="wheel_modes",
        title="Modes of a wheel with flange, S1002 tread and straight web",
        method=(
            "A coarse wheel, held at its bore. Modes by waves round the ring, put onto the mesh "
            "of the contact (Rayleigh and Ritz), against the lowest eigenvalues of that mesh's "
            f"{K.shape[0]} degrees of freedom at once in Cartesian axes: upper bounds of them. "
            "Masses of the default wheel by Pappus' theorem on its drawing."
        ),
        checks=tuple(checks),
        tables=(
            ResultTable(
                "Natural frequencies up to 2.5 kHz",
                ("waves", "ring (Hz)", "brute force (Hz)", "difference (%)"),
                rows,
            ),
        ),
    )


def whole_ring(recipe: WheelRecipe) -> tuple[sp.csc_array, sp.csc_array, IntArray]:
    """Stiffness and mass of the whole ring in Cartesian axes, and its dofs off the bore.

    Plane i at the angle ``theta[i]`` from the bottom, dof ``3*(i*n + node) + component``; of a
    symmetric wheel one half.
    """
    section, half = recipe.section(), recipe.angles
    theta = np.concatenate([half, 2 * np.pi - half[-2:0:-1]])
    y, rho = section.nodes.T
    n, m = len(y), len(theta)
    # z up from the axis, the bottom at theta = 0
    nodes = np.stack(
        [rho * np.sin(theta[:, None]), np.tile(y, (m, 1)), -rho * np.cos(theta[:, None])], axis=2
    ).reshape(-1, 3)
    first = n * np.arange(m)[:, None, None]
    # quads turn counter-clockwise in (y, rho): the plane after comes first for a right-handed one
    elements = np.concatenate(
        [section.quads + np.roll(first, -1, axis=0), section.quads + first], axis=2
    ).reshape(-1, 8)
    corners = nodes[elements]
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(-1, 24)
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    free = np.ones((m, n, 3), dtype=bool)
    free[:, section.bore] = False
    free[:, section.plane_of_symmetry, 1] = False
    K, M = (
        sp.csc_array(sp.coo_array((A.ravel(), (rows, columns)), shape=(3 * n * m,) * 2))
        for A in (
            hex_stiffness(corners, recipe.youngs_modulus, recipe.poisson_ratio),
            hex_mass(corners, recipe.density),
        )
    )
    return K, M, np.flatnonzero(free.ravel())


def section_integrals(d: WheelDimensions, density: float = 7850.0) -> tuple[float, float]:
    """Mass in kg and inertia about the axle in kg m^2 of a cylindrical wheel without flange."""
    parts = (
        (d.hub_width, d.bore_radius, d.hub_radius),
        (d.web_thickness[0], d.hub_radius, d.inner_radius),
        (d.rim_width, d.inner_radius, d.radius),
    )
    # of a ring of width b: rho pi b (R^2 - r^2) and rho pi b (R^4 - r^4)/2
    mass = sum(density * np.pi * b * (R**2 - r**2) for b, r, R in parts)
    inertia = sum(0.5 * density * np.pi * b * (R**4 - r**4) for b, r, R in parts)
    return float(mass), float(inertia)

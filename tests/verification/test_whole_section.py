"""The condensed whole rail section: against every node kept, against its half, against beams."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import skfem
from skfem.helpers import dot, grad

from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.banded import Factor
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.pose import Pose
from contactstudy.geometry.tread import wheel_points
from contactstudy.solids.cell import condense, section_of
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.model import DiscreteSupports, Track, WinklerFoundation
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.unreduced import UnreducedTrack
from contactstudy.vehicle import wheel_column

RECIPE = CellRecipe(
    size=0.008,
    symmetric=False,
    contact_centre=-0.008,
    contact_half_width=0.016,
    interface_modes=24,
)
# round the gauge corner: the lowest nodes lie on the side face
CORNER = replace(RECIPE, contact_centre=-0.028)
HALF_LENGTH = 0.016


@cache
def cell(recipe=RECIPE):
    return condense(recipe)


def short_track(support, recipe=RECIPE, length=0.8):
    return Track(rail=solid_rail(recipe), length=length, support=support)


def responses(track, x):
    """Surface flexibility, and vertical, lateral and roll motion for unit nodal forces."""
    p = track.stretch(x, HALF_LENGTH)
    E = np.zeros((track.n_dofs, len(p.map)))
    for column, row in enumerate(p.map):
        np.add.at(E[:, column], p.dofs, row)
    u = Factor(track.stiffness).solve(E)
    return p, E.T @ u + p.residual, p.centre_map @ u[p.centre_dofs] + p.centre_residual


@pytest.mark.parametrize(
    ("support", "recipe", "bound"),
    [
        (WinklerFoundation(100e6, lateral_stiffness=50e6), RECIPE, 1e-3),
        (DiscreteSupports(spacing=0.4, pad_length=0.0), RECIPE, 1e-3),
        (DiscreteSupports(spacing=0.4, pad_length=0.0), CORNER, 1e-3),
    ],
    ids=["winkler", "pads", "gauge-corner"],
)
def test_static_flexibility_is_that_of_the_full_mesh(support, recipe, bound):
    track = short_track(support, recipe)
    full, reduced = UnreducedTrack(track, recipe), SolidTrack(track, cell(recipe))
    print(f"\n{full.n_dofs} dofs reduced to {reduced.n_dofs}")
    for x in (0.33, 0.41):
        p, A, a = responses(full, x)
        _, B, b = responses(reduced, x)
        worst = np.abs(A - B).max() / np.abs(A).max()
        # forces on each line of nodes: vertical, lateral and roll motion, of the largest of each
        lines = np.tile(np.eye(len(p.arc)), (len(p.x), 1))
        motion = np.abs((b - a) @ lines).max(axis=1) / np.abs(a @ lines).max(axis=1)
        print(f"X = {x} m: worst {worst:.1e}, vertical, lateral, roll", motion)
        assert worst < bound
        assert motion.max() < bound


def test_a_symmetric_load_moves_the_half_section_alike():
    """The half model's nodal force is the total of node and image: half of it on each."""
    half = CellRecipe(size=0.008, contact_half_width=0.016)
    whole = CellRecipe(size=0.008, contact_half_width=0.016, symmetric=False, interface_modes=24)
    support = DiscreteSupports(spacing=0.4)
    moved = []
    for recipe in (half, whole):
        track = SolidTrack(short_track(support, recipe), cell(recipe))
        p, F, motion = responses(track, 0.41)
        ny = len(p.arc)
        if not recipe.symmetric:
            fold = np.zeros((ny // 2 + 1, ny))
            for a in range(ny):
                fold[abs(a - ny // 2), a] += 0.5 if a != ny // 2 else 1.0
            T = np.kron(np.eye(len(p.x)), fold)
            F, motion = T @ F @ T.T, motion @ T.T
            assert np.abs(motion[1:]).max() < 1e-9 * np.abs(motion[0]).max()
        moved.append((F, motion[0]))
    np.testing.assert_allclose(moved[1][0], moved[0][0], rtol=0, atol=1e-3 * moved[0][0].max())
    np.testing.assert_allclose(moved[1][1], moved[0][1], rtol=1e-3)


def test_lateral_bending_and_torsion_are_those_of_beams():
    """Force and torque on the section in the middle of clamped rails of 1.6 and 2.4 m.

    The section's centroid is not its shear centre, so a lateral force also twists; with the
    roll prevented the deflection is P L^3/(192 E I_z) + P L/(4 kappa G A). Clamped ends hold
    the warping, the same near both ends of both rails, so the twist grows by T dL/(4 G J) with
    the length. J is Saint-Venant's, solved by scikit-fem on the same coarse section mesh: 234.6
    cm^4, of which a fine mesh leaves 221 cm^4 (tables of 60E1 say 209 cm^4).
    """
    rail = solid_rail(RECIPE)
    E, G, section = RECIPE.youngs_modulus, RECIPE.youngs_modulus / 2.6, rail.section
    bending, twist = [], []
    for length in (1.6, 2.4):
        track = SolidTrack(short_track(None, length=length), cell())
        p = track.stretch(0.5 * length, HALF_LENGTH)
        rows = np.zeros((track.n_dofs, 2))
        for k in (1, 2):
            np.add.at(rows[:, k - 1], p.centre_dofs, p.centre_map[k])
        C = rows.T @ Factor(track.stiffness).solve(rows)
        beam = length**3 / (192 * E * section.second_moment_z)
        beam += length / (4 * section.shear_coefficient_y * G * section.area)
        bending.append((C[0, 0] - C[0, 1] ** 2 / C[1, 1]) / beam - 1)
        twist.append(C[1, 1])
    J = 0.8 / (4 * G * (twist[1] - twist[0]))
    expected = saint_venant(skfem.ElementQuad1())
    print(f"\nlateral {bending[0]:+.2%} {bending[1]:+.2%}, J {J * 1e8:.1f} cm4")
    print(f"Saint-Venant's {expected * 1e8:.1f} cm4")
    assert np.abs(bending).max() < 0.02
    assert pytest.approx(expected, rel=0.015) == J


def saint_venant(element):
    """Torsion constant: integral y^2 + z^2 - |grad psi|^2, grad psi . grad v = (z, -y) . grad v."""
    mesh, _, _ = section_of(RECIPE)
    basis = skfem.Basis(skfem.MeshQuad(mesh.nodes.T, mesh.quads.T), element)
    stiffness = skfem.BilinearForm(lambda u, v, w: dot(grad(u), grad(v))).assemble(basis)
    load = skfem.LinearForm(lambda v, w: w.x[1] * grad(v)[0] - w.x[0] * grad(v)[1]).assemble(basis)
    polar = skfem.Functional(lambda w: w.x[0] ** 2 + w.x[1] ** 2).assemble(basis)
    psi = skfem.solve(*skfem.condense(stiffness, load, D=np.array([0])))
    return polar - load @ psi


@pytest.mark.slow
def test_s1002_rolls_on_an_inclined_rail():
    """Smooth rail on a uniform foundation at 4 mm: the static load, and a rail that leans.

    The contact lies on the gauge side of the shear centre's vertical, so the head moves and
    rolls to one side; no force but the static one, up to the ripple of a coarse mesh.
    """
    recipe = CellRecipe(
        size=0.004,
        symmetric=False,
        contact_centre=-0.001,
        contact_half_width=0.016,
        interface_modes=24,
        internal_modes=8,
    )
    wheel = elastic_wheel(
        WheelRecipe(
            profile="S1002",
            symmetric=False,
            size=0.004,
            contact_centre=0.002,
            contact_half_width=0.012,
        )
    )
    foundation = WinklerFoundation(100e6, 50e3, lateral_stiffness=50e6, lateral_damping=50e3)
    track = SolidTrack(short_track(foundation, recipe, length=6.0), condense(recipe))
    geometry = Geometry.of(wheel.recipe, Pose(np.arctan(1 / 40), -0.0030))
    vehicle = wheel_column()
    data = surface_contact(
        track,
        SurfaceContact(wheel, geometry=geometry),
        vehicle,
        lambda x: np.zeros_like(x),
        Journey(start=2.0, end=4.0, speed=50.0, time_step=1e-4, fade_in=0.0),
    )
    load, force = vehicle.static_loads[0], data["contact_force"].values
    ripple = np.abs(force[100:] / load - 1).max()
    lateral, roll = data["rail_lateral"].values, data["rail_roll"].values
    print(f"\nstart {force[0] / load - 1:.1e}, ripple {ripple:.2%}")
    print(f"lateral {lateral.mean() * 1e6:.1f} um, roll {roll.mean() * 1e6:.1f} urad")
    assert force[0] == pytest.approx(load, rel=1e-6)
    assert ripple < 0.01
    # frictionless forces along the inclined normals push the rail towards the field side
    points = wheel_points(wheel, "gauss", geometry)
    assert np.all(points.normal_z > 0.99)
    assert lateral.std() < 0.05 * abs(lateral.mean())

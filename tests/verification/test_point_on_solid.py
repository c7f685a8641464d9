"""A point law on the solid rail: what it feels is surface contact less its own spring."""

from functools import cache

import numpy as np
import scipy.sparse.linalg

from contactstudy.compare.passing import passing_amplitude
from contactstudy.contact.laws import LinearSpring, PressSpring, RigidContact
from contactstudy.contact.press import tangent_stiffness
from contactstudy.contact.rail_surface import RailSurface
from contactstudy.contact.surface_contact import SurfaceContact
from contactstudy.dynamics.banded import Factor
from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.wheel import WheelRecipe, elastic_wheel
from contactstudy.solvers.at_rest import bodies_at_rest, geometry_press, geometry_table
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point import point_contact
from contactstudy.solvers.point_case import point_coupling
from contactstudy.solvers.surface import surface_contact
from contactstudy.track.bay import BayRecipe, bay_compliance
from contactstudy.track.model import Track, WinklerFoundation
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.vehicle import wheel_column

RECIPE = CellRecipe(size=0.004)
LOAD = float(wheel_column().static_loads[0])


@cache
def track(support=None, length=6.0):
    described = Track(rail=solid_rail(RECIPE), length=length)
    if support is not None:
        described = Track(described.rail, support, length)
    return SolidTrack(described, cell())


@cache
def cell():
    return condense(RECIPE)


@cache
def contact():
    return SurfaceContact(elastic_wheel(WheelRecipe(size=0.004)))


def k_r(on):
    return tangent_stiffness(geometry_press(on, contact(), LOAD * np.linspace(0.6, 1.4, 9)), LOAD)


def softness_of_the_surface(on, places):
    """d(approach of the hub to the ground)/dF of surface contact at the static load [m/N]."""
    # with the points in contact of mid-bay throughout: their steps from place to place are none
    active = geometry_press(on, contact(), np.array([LOAD])).solutions[0].active
    found = []
    for x in places:
        at = bodies_at_rest(on, contact(), x)
        M = at.flexibility + np.diag(contact().enforcement.compliance(at.points.area))
        normal = at.points.normal_z[active]
        found.append(1.0 / float(normal @ np.linalg.solve(M[np.ix_(active, active)], normal)))
    return np.array(found)


def softness_on_top(on, law, start, stop):
    """Of places, the same of a point law that acts on top of the rail, but for its spring."""
    passage = Passage(
        on, wheel_column(), SmoothRail(), Journey(start, stop, time_step=1e-4, fade_in=0.0)
    )
    coupling, factor, places = point_coupling(passage, law), Factor(on.stiffness), passage.positions
    found = np.empty(len(places))
    for step in range(len(places)):
        dofs, weights = coupling.gaps.rail(step)
        row = np.zeros(on.n_dofs)
        np.add.at(row, dofs[0], weights[0])
        found[step] = row @ factor.solve(row) + coupling.gaps.compliance[step, 0]
    return places[:, 0], found


def softness_of_the_point(on, places, pressed=None):
    """The same of the point on the rail with the tangent spring, and without the correction."""
    # the slope of the computed polygon, with the same points in contact
    spring = geometry_press(pressed or on, contact(), np.array([LOAD])).stiffness[0]
    own, factor = [], Factor(on.stiffness)
    for dofs, weights in zip(*on.rail_rows(places), strict=True):
        row = np.zeros(on.n_dofs)
        np.add.at(row, dofs, weights)
        own.append(row @ factor.solve(row))
    plain = np.array(own) + on.local_compliance(places) + 1.0 / spring
    return plain + on.top_load_compliance(places), plain


def test_softness_over_a_bay_is_that_of_surface_contact():
    on = track()
    places = 3.0 + 0.6 * np.array([0.0, 0.08, 0.17, 0.25, 0.33, 0.5, 0.67, 1.0])
    surface = softness_of_the_surface(on, places)
    point, plain = softness_of_the_point(on, places)
    print("pm/N: X - 3 m, surface, point, without the correction")
    print(np.c_[places - 3, 1e12 * np.c_[surface, point, plain]].round(3))
    swing = [np.ptp(c) for c in (surface, point, plain)]
    print(f"change over the bay {1e12 * np.array(swing)} pm/N")
    assert abs(swing[1] / swing[0] - 1) < 0.03
    assert swing[2] / swing[0] - 1 > 0.3
    assert np.ptp(point - surface) < 0.05 * swing[0]
    np.testing.assert_allclose(point, surface, rtol=1e-3)


def test_on_a_uniform_bed_the_correction_is_one_number():
    on, places = track(WinklerFoundation(100e6, 100e3)), np.array([2.0, 2.31, 3.0])
    assert np.ptp(on.top_load_compliance(places)) == 0.0
    surface, (point, _) = softness_of_the_surface(on, places), softness_of_the_point(on, places)
    print(f"pm/N: surface {1e12 * surface}, point {1e12 * point}")
    np.testing.assert_allclose(point, surface, rtol=1e-3)


def test_on_top_of_the_rail_the_softness_is_the_same():
    # the dofs hold more of it there, and the contact gives that back
    law = PressSpring(np.array([1e-4]), np.array([1e5]))
    for on in (track(), track(WinklerFoundation(100e6, 100e3))):
        places, found = softness_on_top(on, law, 2.4, 3.2)
        spring = 1.0 / geometry_press(on, contact(), np.array([LOAD])).stiffness[0]
        wanted = softness_of_the_point(on, places)[0] - spring
        print(f"largest difference {np.abs(found / wanted - 1).max():.1e}")
        np.testing.assert_allclose(found, wanted, rtol=3e-4)


def test_the_head_vibrates_on_its_web_as_under_surface_contact():
    # what inertia does to the give under the wheel, against the patch of surface contact
    on, x = track(), 2.97
    table, points = geometry_table(on, contact(), LOAD), contact().points
    under = RailSurface(on, points).under(x)
    patch, crown, centre = (np.zeros(on.n_dofs) for _ in range(3))
    row = table.shares @ under.rows(np.arange(len(points.gap))) @ under.stretch.map
    np.add.at(patch, under.stretch.dofs, row)
    for load, rows in ((crown, on.crown_rows), (centre, on.rail_rows)):
        (dofs,), (weights,) = rows(np.array([x]))
        np.add.at(load, dofs, weights)
    loads = np.stack([patch, crown, centre], axis=1)

    def give(frequency):
        omega = 2 * np.pi * frequency
        dynamic = on.stiffness + 1j * omega * on.damping - omega**2 * on.mass
        solved = scipy.sparse.linalg.spsolve(dynamic.tocsc(), loads.astype(complex))
        return np.einsum("dk,dk->k", loads, solved)

    static, spring = give(0.0), 1.0 / float(table.tangent)
    for frequency in (1000.0, 2800.0, 4200.0):
        of_patch, of_crown, of_centre = give(frequency) - static
        off = [abs(f - of_patch) / spring for f in (of_crown, of_centre)]
        print(
            f"{frequency:.0f} Hz, of the spring: crown {off[0]:.2%}, centre line {off[1]:.2%} off"
        )
        assert off[0] < 0.005
    assert off[1] > 0.04


def test_a_spring_gives_back_no_more_than_it_stands_for():
    passage = Passage(track(), wheel_column(), SmoothRail(), Journey(3.0, 4.0, fade_in=0.0))
    x = passage.positions.ravel()
    own, top = passage.track.local_compliance(x), passage.track.top_load_compliance(x)
    assert top.min() < -30e-12
    for law, least in ((RigidContact(), 0.0), (LinearSpring(1e11), -1e-11)):
        added = point_coupling(passage, law).gaps.compliance.ravel() - own
        np.testing.assert_allclose(added, np.maximum(top, least), atol=1e-20)
    rough = sample_profile(paper_spectrum(), seed=1)
    for law in (RigidContact(), LinearSpring(1e11)):
        data = point_contact(
            track(), wheel_column(), rough, Journey(3.0, 4.5, fade_in=1.0), law=law
        )
        force = data.contact_force.values
        print(f"{law}: {force.min():.0f} to {force.max():.0f} N")
        assert force.min() > 0.5 * LOAD and force.max() < 1.5 * LOAD


def test_dynamic_part_and_sleeper_passing_come_near_those_of_the_surface():
    on, vehicle = track(length=12.0), wheel_column()
    rough, smooth = sample_profile(paper_spectrum(), seed=1), SmoothRail()
    journey = Journey(2.4, 9.6, time_step=1e-4, fade_in=1.2)
    forces, passing = {}, {}
    for name, profile in (("rough", rough), ("smooth", smooth)):
        surface = surface_contact(on, contact(), vehicle, profile, journey)
        point = point_contact(on, vehicle, profile, journey, law=LinearSpring(k_r(on)))
        forces[name] = surface.contact_force.values, point.contact_force.values
    x = surface.position.values
    late = x > 4.8
    of_surface, of_point = (force[late] for force in forces["rough"])
    difference = np.linalg.norm(of_point - of_surface) / np.linalg.norm(of_surface - LOAD)
    passing = [passing_amplitude(x[late], f[late], 0.6, 1)[0] / LOAD for f in forces["smooth"]]
    print(f"dynamic part {difference:.2%} off; passing: surface, point {100 * np.array(passing)} %")
    assert difference < 0.015
    assert abs(passing[1] / passing[0] - 1) < 0.05


def test_a_beam_with_the_compliance_of_the_bay():
    # the give of the meshed rail less that of the beam, against surface contact's own softness
    on = track()
    beam = BayRecipe(on.track, "timoshenko", 4, RECIPE)
    corrected = beam.beam.with_top_load(bay_compliance(beam).over_bay())
    places = 3.0 + 0.6 * np.array([0.0, 0.08, 0.17, 0.25, 0.33, 0.5, 0.67, 1.0])
    surface = softness_of_the_surface(on, places)
    found, plain = softness_of_the_point(corrected, places, on)
    off = [100 * np.ptp(c - surface) / np.ptp(surface) for c in (found, plain)]
    print(f"change over the bay off by {off[0]:.1f} %, without the correction by {off[1]:.1f} %")
    assert off[0] < 5 and off[1] > 15
    np.testing.assert_allclose(found, surface, rtol=3e-3)


def test_sleeper_passing_of_a_corrected_beam():
    on, vehicle = track(length=12.0), wheel_column()
    recipe = BayRecipe(on.track, "timoshenko", 4, RECIPE)
    corrected = recipe.beam.with_top_load(bay_compliance(recipe).over_bay())
    journey = Journey(2.4, 9.6, time_step=1e-4, fade_in=1.2)
    surface = surface_contact(on, contact(), vehicle, SmoothRail(), journey)
    late = surface.position.values > 4.8
    found = {}
    for name, rail in (("plain", recipe.beam), ("corrected", corrected)):
        point = point_contact(rail, vehicle, SmoothRail(), journey, law=LinearSpring(k_r(on)))
        apart = (point.contact_force - surface.contact_force).values[late]
        found[name] = np.std(apart) / np.std(surface.contact_force.values[late])
    print({name: f"{value:.1%}" for name, value in found.items()})
    assert found["corrected"] < 0.5 * found["plain"] and found["plain"] > 0.3

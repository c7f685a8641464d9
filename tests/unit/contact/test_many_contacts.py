"""Many contacts against the same contacts with all columns of S^-1 whole."""

import numpy as np
import pytest

from contactstudy.contact import many_contacts
from contactstudy.contact.few_contacts import AttachedFew
from contactstudy.contact.laws import HertzSpring, LinearSpring, MovingForce, RigidContact
from contactstudy.contact.many_contacts import AttachedMany, combined, overlaps, products
from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import LocalColumns
from contactstudy.irregularity import paper_spectrum, sample_profile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point_case import point_coupling
from contactstudy.track.bridge import Bridge
from contactstudy.track.model import Track
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import Train

LAWS = [LinearSpring(1e9), HertzSpring(9.2e10), RigidContact(), MovingForce()]


def passage(planar):
    bridge = Bridge(spans=(8.0, 8.0), approach_before=30.0, approach_behind=30.0)
    car = "s300" if planar else "high_speed_trailer"
    model = "planar" if planar else "three_dimensional"
    train = Train(cars=(car, car), model=model).vehicle(2)
    journey = Journey(start=66.0, end=70.0, time_step=1e-3, fade_in=1.0)
    structure = StructureTrack(Track(structure=bridge), planar=planar)
    return Passage(structure, train, sample_profile(paper_spectrum(), seed=1), journey)


def factor_of(made, dt):
    return Factor(made.system.combine(4.0 / dt**2, 2.0 / dt, 1.0))


@pytest.mark.parametrize("planar", [True, False])
@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("dt", [1e-4, 1e-3])
def test_forces_and_what_they_move_are_those_of_the_whole_solution(planar, law, dt):
    if planar and isinstance(law, RigidContact):
        return  # both wheels of a wheelset are one: refused
    made = passage(planar)
    coupling, factor = point_coupling(made, law), factor_of(made, dt)
    u_free = np.random.default_rng(1).normal(scale=1e-4, size=made.n_dofs)
    u_free[-made.vehicle.n_dofs :] -= 2e-4
    whole = AttachedFew(coupling, factor, 1.0)(5, u_free, None)
    many = AttachedMany(coupling, factor, 1.0)(5, u_free, None)
    force = whole.record["contact_force"]
    np.testing.assert_allclose(
        many.record["contact_force"], force, rtol=0.0, atol=1e-5 * np.abs(force).max()
    )
    scale = np.abs(whole.increment).max()
    np.testing.assert_allclose(many.increment, whole.increment, rtol=0.0, atol=1e-5 * scale)


def test_a_static_system_is_solved_whole(monkeypatch):
    made = passage(True)
    coupling, factor = point_coupling(made, LinearSpring(1e9)), factor_of(made, 0.1)
    near = AttachedMany(coupling, factor, 1.0).compliance(0)
    monkeypatch.setattr(many_contacts, "_WIDE", 0.0)
    whole = AttachedMany(coupling, factor, 1.0).compliance(0)
    np.testing.assert_allclose(whole, near, rtol=0.0, atol=1e-7 * np.diag(whole).min())


@pytest.mark.parametrize("dt", [2e-4, 1e-3])
def test_compliance_of_near_rows_is_that_of_the_inverse(dt):
    made = passage(False)
    factor = factor_of(made, dt)
    dofs, weights = point_coupling(made, LinearSpring(1e9)).gaps.rows(3)
    B = np.zeros((len(dofs), factor.n))
    for row, d, w in zip(B, dofs, weights, strict=True):
        np.add.at(row, d, w)
    exact = B @ factor.solve(B.T)
    columns = LocalColumns(factor, cut=1e-8, half=True).at(dofs)
    pieces = combined(columns, dofs, weights, made.wheels[0].shape[1])
    np.testing.assert_allclose(overlaps(pieces), exact, rtol=0.0, atol=1e-7 * np.diag(exact).min())
    b = np.random.default_rng(2).normal(size=factor.n)
    y = factor.forward(b)[factor.blocks.before :]
    free = B @ factor.solve(b)
    np.testing.assert_allclose(products(pieces, y), free, atol=1e-6 * np.abs(free).max())


@pytest.mark.parametrize("planar", [True, False])
@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("dt", [1e-4, 1e-3])
def test_half_way_through_a_solution_forces_are_those_of_the_whole_one(planar, law, dt):
    """y of L y = rhs tells as much as the free displacements u_known + of_a S^-1 rhs."""
    if planar and isinstance(law, RigidContact):
        return
    made, of_a, scale = passage(planar), 0.25 * dt**2, 0.2 * dt**2
    coupling, factor = point_coupling(made, law), factor_of(made, dt)
    random = np.random.default_rng(1)
    u_known = random.normal(scale=1e-4, size=made.n_dofs)
    u_known[-made.vehicle.n_dofs :] -= 2e-4
    rhs = random.normal(scale=1e2, size=made.n_dofs)
    free = factor.solve(rhs)
    whole = AttachedFew(coupling, factor, scale)(5, u_known + of_a * free, None)
    y = factor.forward(rhs)
    again = AttachedMany(coupling, factor, scale).half_way(5, u_known, of_a, y.copy())
    found = AttachedMany(coupling, factor, scale).half_way(5, u_known, of_a, y)
    force = whole.record["contact_force"]
    np.testing.assert_allclose(
        found.record["contact_force"], force, rtol=0.0, atol=1e-8 * np.abs(force).max()
    )
    np.testing.assert_array_equal(again.record["contact_force"], found.record["contact_force"])
    moved = of_a * (factor.backward(y) - free)
    np.testing.assert_allclose(
        moved, whole.increment, rtol=0.0, atol=1e-8 * np.abs(whole.increment).max()
    )

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse.linalg as spla

from contactstudy.exceptions import InputError
from contactstudy.track.beam import BeamTrack
from contactstudy.track.hermite import BeamElement
from contactstudy.track.model import (
    DiscreteSupports,
    GivenRail,
    Rail,
    Slab,
    Track,
    WinklerFoundation,
)
from contactstudy.track.receptance import receptance

THEORIES = ["euler", "timoshenko"]


def static_deflection(beam, load_at, at):
    """Deflection at X per unit force, with the local compliance where the two coincide."""
    force, row = np.zeros(beam.n_dofs), np.zeros(beam.n_dofs)
    for vector, x in ((force, load_at), (row, at)):
        dofs, weights = beam.rail_rows(np.array([x]))
        np.add.at(vector, dofs[0], weights[0])
    local = beam.local_compliance(np.array([load_at]))[0] if at == load_at else 0.0
    return row @ spla.spsolve(beam.stiffness.tocsc(), force) + local


def test_element_matrices_of_both_theories():
    rail = BeamElement(0.6, 6.4e6, 60.0)
    L = 0.6
    np.testing.assert_allclose(
        rail.mass()[0], 60.0 * L / 420 * np.array([156, 22 * L, 54, -13 * L]), rtol=1e-12
    )
    np.testing.assert_allclose(
        rail.stiffness()[1], 6.4e6 / L**3 * np.array([6 * L, 4 * L**2, -6 * L, 2 * L**2])
    )
    thick = BeamElement(0.6, 6.4e6, 60.0, 2.5e8, 0.24)
    rigid = np.array([[1, 0, 1, 0], [0, 1, L, 1]])  # lift, and rotation about the left node
    for element in (rail, thick):
        np.testing.assert_allclose(element.stiffness() @ rigid.T, 0.0, atol=1e-6)
        moments = rigid @ element.mass() @ rigid.T
        rotary = element.rotary_inertia * L
        np.testing.assert_allclose(
            moments, 60.0 * np.array([[L, L**2 / 2], [L**2 / 2, L**3 / 3]]) + [[0, 0], [0, rotary]]
        )
    # cantilever: FL^3/3EI + FL/kGA
    tip = np.linalg.inv(thick.stiffness()[2:, 2:])[0, 0]
    assert tip == pytest.approx(L**3 / (3 * 6.4e6) + L / 2.5e8, rel=1e-12)


def test_clamped_compliance():
    a, b, L, EI = 0.06, 0.09, 0.15, 6.4e6
    euler = BeamElement(L, EI, 60.0)
    assert euler.clamped_compliance(np.array([0.4]))[0] == pytest.approx(
        a**3 * b**3 / (3 * EI * L**3), rel=1e-12
    )
    np.testing.assert_array_equal(euler.clamped_compliance(np.array([0.0, 1.0])), 0.0)
    # clamped at both ends, load in the middle: L^3/192EI + L/4kGA
    thick = BeamElement(L, EI, 60.0, 2.5e8)
    assert thick.clamped_compliance(np.array([0.5]))[0] == pytest.approx(
        L**3 / (192 * EI) + L / (4 * 2.5e8), rel=1e-12
    )


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("per_bay", [1, 3, 4, 7])
def test_coarse_mesh_with_element_compliance_is_statically_exact(theory, per_bay):
    track = Track(length=4.8)
    fine = BeamTrack(track, theory, 15, True)
    coarse = BeamTrack(track, theory, per_bay, True)
    for x in (1.0, 1.83, 2.391, 2.4, 2.7, 4.77):
        assert static_deflection(coarse, x, x) == pytest.approx(
            static_deflection(fine, x, x), rel=1e-8
        )


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("per_bay", [1, 2, 4])
def test_pads_of_no_length_with_element_compliance(theory, per_bay):
    def track(pad_length):
        return Track(support=DiscreteSupports(pad_length=pad_length), length=6.0)

    points, short = (BeamTrack(track(pad), theory, per_bay, True) for pad in (0.0, 1e-6))
    # nodal shapes of the beam are exact for loads at nodes: here every 1/96 bay
    fine = BeamTrack(track(0.0), theory, 96)
    for x in 3.0 + 0.6 * np.array([0.0, 0.125, 0.25, 0.3125, 0.5]):
        ours, limit, exact = (static_deflection(beam, x, x) for beam in (points, short, fine))
        print(f"{theory} {per_bay} X = {x:.4f} m: {ours:.9e}, 1 um pads {limit:.9e}, {exact:.9e}")
        np.testing.assert_allclose(ours, exact, rtol=1e-8)
        np.testing.assert_allclose(ours, limit, rtol=1e-7)


@pytest.mark.parametrize("theory", THEORIES)
def test_plain_mesh_converges_to_the_exact_deflection(theory):
    track = Track(length=4.8)
    exact = static_deflection(BeamTrack(track, theory, 4, True), 2.43, 2.43)
    errors = [
        static_deflection(BeamTrack(track, theory, n), 2.43, 2.43) / exact - 1 for n in (2, 40)
    ]
    assert abs(errors[1]) < 1e-2 * abs(errors[0]) + 1e-4


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("compliance", [False, True])
@pytest.mark.parametrize("direction", ["Z", "Y"])
@pytest.mark.parametrize("ends", ["clamped", "pinned", "free"])
@pytest.mark.parametrize(
    "support", [DiscreteSupports(), DiscreteSupports(layer=Slab()), WinklerFoundation(3e7, 1e4)]
)
def test_matrices_are_symmetric_definite_and_narrow(theory, compliance, direction, ends, support):
    beam = BeamTrack(
        Track(support=support, length=3.0, ends=ends), theory, 2, compliance, direction
    )
    for matrix in (beam.mass, beam.stiffness, beam.damping):
        dense = matrix.toarray()
        np.testing.assert_allclose(dense, dense.T, rtol=1e-12, atol=1e-9 * np.abs(dense).max())
    np.linalg.cholesky(beam.stiffness.toarray())
    np.linalg.cholesky(beam.mass.toarray())
    rows, columns = beam.stiffness.nonzero()
    assert np.abs(rows - columns).max() <= 14


def test_pad_averages_a_linear_deflection_exactly():
    # footprint 0.16 m over elements of 0.1 m; with free ends a rigid tilt is possible
    beam = BeamTrack(Track(length=1.2, ends="free"), elements_per_bay=6)
    tilt = np.zeros(beam.n_dofs)
    x = np.arange(13) * 0.1
    tilt[beam._final_dof[0::2][:13]] = x
    tilt[beam._final_dof[1::2][:13]] = 1.0
    sleepers = np.setdiff1d(np.arange(beam.n_dofs), beam._final_dof[beam._final_dof >= 0])
    pad_forces = -(beam.stiffness @ tilt)[sleepers]
    # average of X over the footprints cut off at the ends: 0.04, 0.6, 1.16
    np.testing.assert_allclose(pad_forces / 65e6, [0.04, 0.6, 1.16], rtol=1e-12)


def test_slab_and_rail_lifted_together_weigh_and_resist_what_they_should():
    slab, length = Slab(), 6.0
    support = DiscreteSupports(layer=slab)
    beam = BeamTrack(Track(support=support, length=length, ends="free"), elements_per_bay=2)
    lift = np.zeros(beam.n_dofs)
    rail_dofs = beam._final_dof[: 2 * beam.n_elements + 2]
    below = np.setdiff1d(np.arange(beam.n_dofs), rail_dofs)  # slab: w, theta at each seat
    lift[rail_dofs[0::2]] = lift[below[0::2]] = 1.0
    assert lift @ beam.stiffness @ lift == pytest.approx(slab.stiffness * length, rel=1e-9)
    assert lift @ beam.damping @ lift == pytest.approx(slab.damping * length, rel=1e-9)
    mass = (Rail().mass_per_length + slab.mass_per_length) * length + 11 * support.sleeper_mass
    assert lift @ beam.mass @ lift == pytest.approx(mass, rel=1e-9)


def test_inner_dofs_on_a_foundation_leave_the_exact_solution():
    EI, k, x = 6.4155e6, 30e6, 18.07
    beta = (k / (4 * EI)) ** 0.25
    track = Track(GivenRail(EI=EI, mass=60.0), WinklerFoundation(k), length=36.0)
    errors = [
        static_deflection(BeamTrack(track, "euler", 1, on), x, x) / (beta / (2 * k)) - 1
        for on in (False, True)
    ]
    assert abs(errors[1]) < 1e-5 < abs(errors[0])


def test_ends():
    EI, L = 2.1e7, 6.0
    for ends, coefficient in (("pinned", 48.0), ("clamped", 192.0)):
        beam = BeamTrack(Track(GivenRail(EI=EI, mass=78.5), None, L, ends), elements_per_bay=1)
        exact = L**3 / (coefficient * EI)
        assert static_deflection(beam, L / 2, L / 2) == pytest.approx(exact, rel=1e-10)
        dofs, weights = beam.rail_rows(np.array([0.0, L]))
        np.testing.assert_array_equal(weights[:, [0]] * (dofs[:, [0]] >= 0), 0.0)


def test_receptance_tends_to_the_static_compliance_and_peaks_at_a_resonance():
    beam = BeamTrack(Track(length=12.0), elements_per_bay=2, element_compliance=True)
    static = static_deflection(beam, 6.1, 6.1)
    assert receptance(beam, 6.1, np.array([1e-3]))[0] == pytest.approx(static, rel=1e-6)
    # reciprocity
    there = receptance(beam, 6.1, np.array([200.0]), at=4.0)
    back = receptance(beam, 4.0, np.array([200.0]), at=6.1)
    assert there[0] == pytest.approx(back[0], rel=1e-9)
    # against a dense solution
    omega = 2 * np.pi * 200.0
    D = beam.stiffness + 1j * omega * beam.damping - omega**2 * beam.mass
    dofs, weights = beam.rail_rows(np.array([6.1]))
    n = np.zeros(beam.n_dofs)
    np.add.at(n, dofs[0], weights[0])
    dense = n @ scipy.linalg.solve(D.toarray(), n) + beam.local_compliance(np.array([6.1]))[0]
    assert receptance(beam, 6.1, np.array([200.0]))[0] == pytest.approx(dense, rel=1e-8)


def test_impossible_discretisations_are_reported_all_at_once():
    with pytest.raises(InputError) as caught:
        BeamTrack(Track(), "rayleigh", 0, direction="X")
    assert len(caught.value.problems) == 3
    with pytest.raises(InputError, match="whole number"):
        BeamTrack(Track(), elements_per_bay=2.5)

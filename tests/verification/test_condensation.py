"""Condensed rail cells against the same mesh with every node kept."""

from functools import cache

import numpy as np
import pytest

from contactstudy.dynamics.banded import Factor
from contactstudy.solids.cell import condense
from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import DiscreteSupports, Track, WinklerFoundation
from contactstudy.track.solid import SolidTrack, solid_rail
from contactstudy.track.unreduced import UnreducedTrack

RECIPE = CellRecipe(size=0.006)
HALF_LENGTH = 0.012


@cache
def cell():
    return condense(RECIPE)


def short_track(support):
    return Track(rail=solid_rail(RECIPE), length=1.2, support=support)


def flexibility(track, factor, x):
    """Flexibility of surface nodes and centre line in a stretch, last row the centre line."""
    p = track.stretch(x, HALF_LENGTH)
    E = np.zeros((track.n_dofs, len(p.map) + 1))
    for column, row in enumerate(p.map):
        np.add.at(E[:, column], p.dofs, row)
    np.add.at(E[:, -1], p.centre_dofs, p.centre_map[0])
    G = E.T @ factor.solve(E)
    G[:-1, :-1] += p.residual
    G[-1, :-1] += p.centre_residual[0]
    G[:-1, -1] += p.centre_residual[0]
    return G


# A pad of no length keeps the full mesh's band narrow, but presses on the foot along a line,
# and foot loads have no residual flexibility: twice the bound.
@pytest.mark.parametrize(
    ("support", "bound"),
    [(WinklerFoundation(100e6), 1e-4), (DiscreteSupports(pad_length=0.0), 2e-4)],
    ids=["winkler", "pads"],
)
def test_static_flexibility_is_that_of_the_full_mesh(support, bound):
    track = short_track(support)
    full, reduced = UnreducedTrack(track, RECIPE), SolidTrack(track, cell())
    f_full, f_reduced = Factor(full.stiffness), Factor(reduced.stiffness)
    print(f"\n{full.n_dofs} dofs reduced to {reduced.n_dofs}")
    for x in (0.58, 0.6, 0.63, 0.65, 0.7):
        a, b = flexibility(full, f_full, x), flexibility(reduced, f_reduced, x)
        n = len(a) - 1
        load = np.full(n, 1 / n)
        mean = (load @ b[:n, :n] @ load) / (load @ a[:n, :n] @ load) - 1
        centre = (b[n, :n] @ load) / (a[n, :n] @ load) - 1
        worst = np.abs(a - b)[:n, :n].max() / a[:n, :n].max()
        print(f"X = {x:.2f} m: mean {mean:+.1e}, centre line {centre:+.1e}, worst {worst:.1e}")
        assert abs(mean) < bound
        assert abs(centre) < 2 * bound
        assert worst < 2 * bound


def test_residual_is_local_positive_and_the_same_in_every_cell():
    ns, ny = RECIPE.n_slices, len(cell().surface_y)
    R = cell().residual.reshape(2 * ns + 1, ny, 2 * ns + 1, ny)
    own = R[ns, 0, ns, 0]
    reach = np.arange(2 * ns + 1) * RECIPE.length / ns
    beyond = np.abs(reach - reach[ns]) >= 0.05
    assert np.linalg.eigvalsh(cell().residual)[0] > 0
    assert np.abs(R[beyond, :, ns, :]).max() < 1e-3 * own
    # one cell further on: the window's clamped ends must not show
    assert np.abs(R[: ns + 1, :, 0, :] - R[ns:, :, ns, :]).max() < 1e-3 * own


def test_more_interface_modes_come_closer():
    track = short_track(WinklerFoundation(100e6))
    full = UnreducedTrack(track, RECIPE)
    exact = flexibility(full, Factor(full.stiffness), 0.63)
    errors = []
    for modes in (4, 8, 14):
        recipe = CellRecipe(size=RECIPE.size, interface_modes=modes)
        reduced = SolidTrack(track, condense(recipe))
        G = flexibility(reduced, Factor(reduced.stiffness), 0.63)
        # a load on the centre line (last row and column) has no residual
        errors.append(np.abs(G - exact)[:-1, :-1].max() / exact.max())
    print("\nworst error with 4, 8, 14 modes:", *(f"{e:.1e}" for e in errors))
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


def test_deflection_is_timoshenkos_on_a_long_foundation():
    """Far from the load's own section both rails are the same beam."""
    track = Track(rail=solid_rail(RECIPE), length=12.0, support=WinklerFoundation(30e6))
    solid = SolidTrack(track, cell())
    beam = BeamTrack(track, "timoshenko", 8)
    values = []
    for t in (solid, beam):
        dofs, weights = t.rail_rows(np.array([6.0, 6.0, 6.6, 7.2, 8.4]))
        load = np.zeros(t.n_dofs)
        np.add.at(load, dofs[0], weights[0] * 1e5)
        u = Factor(t.stiffness).solve(load)
        values.append(np.sum(weights * u[dofs], axis=1))
    print("\nsolid     ", values[0], "\nTimoshenko", values[1])
    np.testing.assert_allclose(values[0], values[1], atol=1e-3 * values[1].max())


def test_mass_and_clamped_modes():
    """Total mass, and the lowest frequencies of a clamped 1.2 m rail against the full mesh."""
    from scipy.sparse.linalg import eigsh

    track = short_track(WinklerFoundation(1e3))
    frequencies = []
    for t in (UnreducedTrack(track, RECIPE), SolidTrack(track, cell())):
        values = eigsh(
            t.stiffness.tocsc(),
            k=5,
            M=t.mass.tocsc(),
            sigma=0.0,
            return_eigenvectors=False,
            OPinv=_inverse(t),
            v0=np.ones(t.n_dofs),
        )
        frequencies.append(np.sqrt(np.sort(values)) / (2 * np.pi))
    print("\nfull   ", frequencies[0], "\nreduced", frequencies[1])
    bending, axial = [0, 1, 2, 4], 3  # the axial one is c/2L = 2155 Hz
    np.testing.assert_allclose(frequencies[1][bending], frequencies[0][bending], rtol=1e-3)
    assert frequencies[0][axial] == pytest.approx(5172 / 2.4, rel=0.01)
    assert frequencies[1][axial] == pytest.approx(frequencies[0][axial], rel=0.01)


def _inverse(track):
    from scipy.sparse.linalg import LinearOperator

    factor = Factor(track.stiffness)
    return LinearOperator((track.n_dofs,) * 2, matvec=lambda b: factor.solve(b.ravel()))


def test_deformed_section_is_that_of_the_full_mesh():
    track, x = short_track(WinklerFoundation(100e6)), 0.598
    full, reduced = UnreducedTrack(track, RECIPE), SolidTrack(track, cell())
    moved = []
    force = -np.linspace(1.0, 2.0, len(reduced.stretch(x, HALF_LENGTH).map))
    for t in (full, reduced):
        p = t.stretch(x, HALF_LENGTH)
        load = np.zeros(t.n_dofs)
        np.add.at(load, p.dofs, p.map.T @ force)
        moved.append(Factor(t.stiffness).solve(load))
    s = reduced.section(x, HALF_LENGTH)
    got = s.map @ moved[1][s.dofs] + s.residual @ force
    all_nodes = full.section(s.position, HALF_LENGTH)
    expected = all_nodes.map @ moved[0][all_nodes.dofs]
    assert np.abs(got - expected).max() < 1e-3 * np.abs(expected).max()


def test_centre_compliance_under_a_load_on_the_section():
    """A point law presses on the section's mean: deflection under it, at planes and between."""
    track = short_track(WinklerFoundation(100e6))
    full, reduced = UnreducedTrack(track, RECIPE), SolidTrack(track, cell())
    own = []
    x = np.array([0.55, 0.6, 0.603, 0.63, 0.65])
    for t in (full, reduced):
        factor, (dofs, weights) = Factor(t.stiffness), t.rail_rows(x)
        E = np.zeros((t.n_dofs, len(x)))
        for k in range(len(x)):
            np.add.at(E[:, k], dofs[k], weights[k])
        own.append(np.einsum("nk,nk->k", E, factor.solve(E)) + t.local_compliance(x))
    print("\nreduced over full - 1:", own[1] / own[0] - 1)
    np.testing.assert_allclose(own[1], own[0], rtol=2e-4)

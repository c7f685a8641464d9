"""Beams in space against closed forms."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse.linalg as spla

from contactstudy.track.frame import Chain, Frame, numbered
from contactstudy.track.space_beam import (
    N_DOFS,
    RX,
    RY,
    RZ,
    UX,
    UY,
    UZ,
    SpaceBeam,
    along_z,
    displacement,
)

L, EA, EI, EIy, GJ, MASS, POLAR = 12.0, 3e9, 4e8, 9e8, 2e8, 800.0, 350.0
BEAM = SpaceBeam(EA, EI, EIy, GJ, MASS, POLAR)


def framed(beam=BEAM, n=16, held=((0, (UX, UY, UZ, RX)), (-1, (UY, UZ, RX)))):
    x = np.linspace(0.0, L, n + 1)
    kept = np.ones((n + 1, N_DOFS), dtype=bool)
    for node, dofs in held:
        kept[node, list(dofs)] = False
    nodes = np.arange(n + 1)
    chain = Chain(nodes, x, beam)
    dof = numbered(x, np.zeros(n + 1, int), kept, nodes)
    return chain, Frame([chain], [], np.zeros((n + 1, N_DOFS)), dof)


def moved(frame, dof, force):
    load = np.zeros(frame.n_dofs)
    load[frame.dof[dof]] = force
    return spla.spsolve(frame.matrices[2].tocsc(), load)


def test_natural_frequencies_of_a_simply_supported_beam_in_space():
    _, frame = framed(n=32)
    M, _, K = frame.matrices
    found = np.sqrt(scipy.linalg.eigh(K.toarray(), M.toarray(), eigvals_only=True))
    k = np.arange(1, 4)
    expected = {
        "vertical": (k * np.pi / L) ** 2 * np.sqrt(EI / MASS),
        "lateral": (k * np.pi / L) ** 2 * np.sqrt(EIy / MASS),
        "torsion": k * np.pi / L * np.sqrt(GJ / POLAR),
        "axial": (2 * k - 1) * np.pi / (2 * L) * np.sqrt(EA / MASS),
    }
    for name, frequencies in expected.items():
        for frequency in frequencies:
            assert np.abs(found / frequency - 1.0).min() < 4e-3, name
    assert found[0] == pytest.approx(expected["vertical"][0], rel=1e-6)


@pytest.mark.parametrize(("motion", "order"), [((UZ, RY), 4), ((RX,), 2)])
def test_order_of_convergence_of_the_frequencies(motion, order):
    exact = (2 * np.pi / L) ** 2 * np.sqrt(EI / MASS)
    if order == 2:
        exact = 2 * np.pi / L * np.sqrt(GJ / POLAR)
    still = tuple(dof for dof in range(N_DOFS) if dof not in motion)
    errors = []
    for n in (8, 16):
        held = [(node, still) for node in range(n + 1)] + [(0, (UZ, RX)), (-1, (UZ, RX))]
        M, _, K = framed(n=n, held=held)[1].matrices
        found = np.sqrt(scipy.linalg.eigh(K.toarray(), M.toarray(), eigvals_only=True))
        errors.append(found[1] / exact - 1.0)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)


def test_cantilever_with_shear():
    shear = SpaceBeam(EA, EI, EIy, GJ, MASS, POLAR, 5e7, 8e7, 40.0, 90.0)
    for beam, s, sy in ((BEAM, np.inf, np.inf), (shear, 5e7, 8e7)):
        _, frame = framed(beam, 3, [(0, range(6))])
        u = {d: moved(frame, (-1, d), 1.0) for d in range(N_DOFS)}
        tip = frame.dof[-1]
        assert u[UX][tip[UX]] == pytest.approx(L / EA)
        assert u[UZ][tip[UZ]] == pytest.approx(L**3 / (3 * EI) + L / s)
        assert u[UY][tip[UY]] == pytest.approx(L**3 / (3 * EIy) + L / sy)
        assert u[RX][tip[RX]] == pytest.approx(L / GJ)
        assert u[UZ][tip[RY]] == pytest.approx(-(L**2) / (2 * EI))  # w' = -ry
        assert u[UY][tip[RZ]] == pytest.approx(L**2 / (2 * EIy))
        assert u[RY][tip[RY]] == pytest.approx(L / EI)


@pytest.mark.parametrize("turned", [np.asarray, along_z])
def test_rigid_motion_costs_nothing_and_has_the_bodys_inertia(turned):
    length = 1.7
    beam = SpaceBeam(EA, EI, EIy, GJ, MASS, POLAR, 5e7, 8e7, 40.0, 90.0)
    K, M = turned(beam.stiffness(length)), turned(beam.mass(length))
    axis = np.array([0.0, 0.0, 1.0]) if turned is along_z else np.array([1.0, 0.0, 0.0])
    rigid = np.vstack([rigid_motion(np.zeros(3)), rigid_motion(length * axis)])
    np.testing.assert_allclose(K @ rigid, 0.0, atol=1e-5)
    inertia = rigid.T @ M @ rigid
    np.testing.assert_allclose(inertia[:3, :3], MASS * length * np.eye(3), atol=1e-9)
    about = np.flatnonzero(axis)[0]
    assert inertia[3 + about, 3 + about] == pytest.approx(POLAR * length)
    lateral = MASS * length**3 / 3 + 90.0 * length
    across = inertia[3 if turned is along_z else 5, 3 if turned is along_z else 5]
    assert across == pytest.approx(lateral)


def rigid_motion(at):
    """(6, 6) displacements and rotations at a place for unit motions of a rigid body."""
    whole = np.eye(6)
    for k in range(3):
        whole[:3, 3 + k] = np.cross(np.eye(3)[k], at)
    return whole


def test_a_rigidly_joined_point_moves_by_the_rotation():
    arm = np.array([0.3, -0.7, 1.1])
    whole = rigid_motion(arm)
    for k, axis in enumerate("XYZ"):
        np.testing.assert_allclose(displacement(axis, tuple(arm)), whole[k])


def test_a_beams_shapes_are_those_of_its_statics():
    """Motion between the nodes of unequal elements under a load at a node, against 1 element."""
    x = np.array([0.0, 2.0, 5.0, 12.0])
    kept = np.ones((4, N_DOFS), dtype=bool)
    kept[0] = False
    chain = Chain(np.arange(4), x, BEAM)
    frame = Frame(
        [chain], [], np.zeros((4, N_DOFS)), numbered(x, np.zeros(4, int), kept, np.arange(4))
    )
    at = np.array([0.0, 1.0, 3.7, 5.0, 11.0, 12.0])
    dofs, motion = chain.motion_at(at)
    for load, shape in {
        UZ: lambda s: s**2 * (3 * L - s) / (6 * EI),
        UY: lambda s: s**2 * (3 * L - s) / (6 * EIy),
        RX: lambda s: s / GJ,
    }.items():
        u = np.zeros(4 * N_DOFS)
        u[N_DOFS:] = moved(frame, (3, load), 1.0)
        np.testing.assert_allclose(
            np.einsum("mk,mk->m", motion[:, load], u[dofs]), shape(at), atol=1e-18
        )

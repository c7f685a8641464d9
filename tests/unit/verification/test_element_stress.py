"""Stress recovery of hexahedra: constant strain, pure bending, extrapolation to nodes."""

import numpy as np
import pytest

from contactstudy.solids.hexahedron import elasticity_matrix, hex_stiffness, strain_operators
from contactstudy.verification.cases.element_stress import hex_stress, nodal_stress
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.halfspace_block import HalfSpaceBlock

E, NU = 210e9, 0.3
CUBE = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    dtype=float,
)


def test_constant_strain_in_a_distorted_element():
    corners = (CUBE + 0.15 * np.random.default_rng(2).standard_normal(CUBE.shape))[None]
    gradient = 1e-4 * np.array([[1.0, 0.3, -0.2], [0.7, -0.5, 0.4], [0.1, -0.6, 0.8]])
    u = corners @ gradient.T
    e = 0.5 * (gradient + gradient.T)
    strain = np.array([e[0, 0], e[1, 1], e[2, 2], 2 * e[1, 2], 2 * e[2, 0], 2 * e[0, 1]])
    exact = elasticity_matrix(E, NU) @ strain
    for incompatible in (True, False):
        stress = hex_stress(corners, u, E, NU, incompatible)
        np.testing.assert_allclose(stress, np.broadcast_to(exact, (1, 8, 6)), rtol=1e-9, atol=1)
    nodes = nodal_stress(stress, np.arange(8)[None], np.ones(1), 9)
    np.testing.assert_allclose(nodes[:8], np.broadcast_to(exact, (8, 6)), rtol=1e-9, atol=1)
    assert np.isnan(nodes[8]).all()


def test_pure_bending_needs_the_bubbles():
    # s_xx = E k z: u = k x z, w = -k x^2/2 - nu k (z^2 - y^2)/2, v = -nu k y z
    k, corners = 1e-3, CUBE - 0.5
    x, y, z = corners.T
    u = np.stack(
        [k * x * z, -NU * k * y * z, -0.5 * k * x**2 - 0.5 * NU * k * (z**2 - y**2)], axis=1
    )
    stress = hex_stress(corners[None], u[None], E, NU)[0]
    exact = np.zeros((8, 6))
    exact[:, 0] = E * k * np.sign(corners[:, 2]) / np.sqrt(12.0)
    np.testing.assert_allclose(stress, exact, atol=1e-9 * E * k)
    locked = hex_stress(corners[None], u[None], E, NU, incompatible=False)[0]
    assert np.abs(locked - exact).max() > 0.1 * E * k / np.sqrt(12.0)
    # extrapolated to the corners the linear stress is exact
    nodes = nodal_stress(stress[None], np.arange(8)[None], np.ones(1), 8)
    np.testing.assert_allclose(nodes[:, 0], E * k * z, atol=1e-9 * E * k)


def test_stress_does_the_work_of_the_stiffness():
    # the energy u K u/2 is that of the stresses: integral s D^-1 s/2
    rng = np.random.default_rng(5)
    corners = (0.01 * (CUBE + 0.1 * rng.standard_normal(CUBE.shape)))[None]
    u = 1e-6 * rng.standard_normal((1, 8, 3))
    stress = hex_stress(corners, u, E, NU)
    volume = strain_operators(corners)[2]
    energy = np.einsum(
        "mps,st,mpt,mp->", stress, np.linalg.inv(elasticity_matrix(E, NU)), stress, volume
    )
    K = hex_stiffness(corners, E, NU)[0]
    assert energy == pytest.approx(u.ravel() @ K @ u.ravel(), rel=1e-12)


def test_block_under_a_nodal_load_is_in_balance_with_it():
    # on a plane below a nodal force: integral s_zz = -F; a coarse mesh gives it within 2 %
    lines = graded_lines(8e-3, 2e-3, 40e-3, growth=1.5)
    block = HalfSpaceBlock(lines, lines, lines)
    loaded = (slice(0, 2), slice(0, 2))
    u = block.displacement(loaded, np.array([[250.0], [250.0], [250.0], [250.0]]))[..., 0]
    szz = block.stress(u)[:, :, 3, 2]
    quarter = np.trapezoid(np.trapezoid(szz, lines, axis=1), lines)
    depth, c = lines[3], lines[-1]
    # what of Boussinesq's load passes outside the square of half side c: about 1.3 (z/c)^3
    assert -4 * quarter == pytest.approx(1000.0, rel=0.02 + 1.3 * (depth / c) ** 3)

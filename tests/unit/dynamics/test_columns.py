"""Local columns of an inverse against the dense inverse."""

import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.dynamics.banded import Factor
from contactstudy.dynamics.columns import CUT, LocalColumns, add_columns, compliance
from contactstudy.dynamics.integrators import average_acceleration
from contactstudy.dynamics.stepper import LinearSystem
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import Track


def matrix(theory="timoshenko"):
    """S of a step, and a block beside it as of a vehicle."""
    track = BeamTrack(Track(length=60.0), theory)
    c0, _, _, d0, _, _ = average_acceleration().kinematics(5e-5)
    vehicle = 1e9 * np.array([[2.0, -1.0, 0.0], [-1.0, 3.0, -1.0], [0.0, -1.0, 2.0]])
    S = LinearSystem(track.mass, track.damping, track.stiffness).combine(c0, d0, 1.0)
    return sp.csr_array(sp.block_diag([S, vehicle]))


def whole(columns, dof, n):
    first, width, begin, values = columns
    column = np.zeros(n)
    column[first[dof] : first[dof] + width[dof]] = values[begin[dof] : begin[dof] + width[dof]]
    return column


@pytest.mark.parametrize("theory", ["euler", "timoshenko"])
def test_columns_are_those_of_the_inverse(theory):
    S = matrix(theory)
    n = S.shape[0]
    inverse = np.linalg.inv(S.toarray())
    local = LocalColumns(Factor(S))
    dofs = np.array([[0, 1, n // 2], [n // 2 + 1, n - 2, n // 2]])
    columns = local.at(dofs)
    for dof in dofs.ravel():
        largest = np.abs(inverse[dof]).max()
        np.testing.assert_allclose(whole(columns, dof, n), inverse[dof], atol=1e-12 * largest)
    # what was cut off is below CUT, and it was much: felt on less than 12 m of 60 m
    full = Factor(S).solve(np.eye(n)[n // 2])
    cut = np.setdiff1d(np.arange(n), np.flatnonzero(whole(columns, n // 2, n)))
    assert np.abs(full[cut]).max() < 2 * CUT * np.abs(full).max()
    assert columns.width[n // 2] < n / 5
    # the vehicle's block does not feel the rail, nor the rail the vehicle
    assert columns.first[n - 2] == n - 3
    assert columns.width[n - 2] == 3


def test_columns_do_not_depend_on_what_was_asked_for():
    S = matrix()
    n = S.shape[0]
    factor = Factor(S)
    one, other = LocalColumns(factor), LocalColumns(factor)
    for dof in range(0, n, 7):
        one.at(np.array([dof]))
    asked = np.array([n // 2, n // 3])
    a, b = one.at(asked), other.at(asked[::-1])
    for dof in asked:
        np.testing.assert_array_equal(whole(a, dof, n), whole(b, dof, n))


def test_memory_is_bounded_and_what_is_wanted_stays():
    S = matrix()
    n = S.shape[0]
    factor = Factor(S)
    most = 8 * 3000
    local = LocalColumns(factor, memory=most)
    for dof in range(n - 5):
        asked = np.arange(dof, dof + 4)
        columns = local.at(asked)
        assert (columns.begin[asked] >= 0).all()
        assert columns.values.nbytes <= most
    last = np.arange(n - 5, n - 1)
    columns = local.at(last)
    fresh = LocalColumns(factor).at(last)
    for dof in last:
        np.testing.assert_array_equal(whole(columns, dof, n), whole(fresh, dof, n))
    # more than fits at once is there all the same
    assert (local.at(np.arange(n)).begin >= 0).all()


def test_block_of_neighbours():
    S = matrix()
    n = S.shape[0]
    dofs = np.array([400, 403, 401, 400])
    first, block = LocalColumns(Factor(S)).block(dofs)
    inverse = np.linalg.inv(S.toarray())[dofs]
    rebuilt = np.zeros((len(dofs), n))
    rebuilt[:, first : first + block.shape[1]] = block
    np.testing.assert_allclose(rebuilt, inverse, atol=1e-12 * np.abs(inverse).max())


def test_products_with_rows_of_many_wheels():
    """Near and far wheels, two in one element, and a row that names a dof twice."""
    S = matrix()
    n = S.shape[0]
    rng = np.random.default_rng(3)
    at = np.array([100, 101, 130, 400, 860])
    dofs = np.hstack([np.full((5, 1), n - 2), at[:, None] + np.arange(4)])
    dofs[2, 4] = dofs[2, 3]
    weights = rng.standard_normal(dofs.shape)
    B = np.zeros((5, n))
    for row, where, values in zip(B, dofs, weights, strict=True):
        np.add.at(row, where, values)
    inverse = np.linalg.inv(S.toarray())
    columns, work = LocalColumns(Factor(S)).at(dofs), np.zeros(n)
    W = B @ inverse @ B.T
    for _ in range(2):  # the work is left as it was found
        found = compliance(columns, dofs, weights, work)
        np.testing.assert_allclose(found, W, atol=1e-12 * np.abs(W).max())
    factors, total = rng.standard_normal(5), rng.standard_normal(n)
    exact = total + inverse @ B.T @ factors
    add_columns(columns, dofs, weights, factors, total)
    np.testing.assert_allclose(total, exact, rtol=1e-12)

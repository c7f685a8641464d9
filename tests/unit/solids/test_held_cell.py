"""A cell between held end planes against dense linear algebra on all of its nodes."""

import numpy as np
import pytest

from contactstudy.solids.cell import section_of
from contactstudy.solids.chain import repeat
from contactstudy.solids.held_cell import HeldCell
from contactstudy.solids.recipe import CellRecipe
from contactstudy.solids.window import MARGIN, window_response

COARSE = CellRecipe(size=0.008, length=0.04, coarse=0.02, contact_half_width=0.008)
_, PIECE, ROWS = section_of(COARSE)
N = len(PIECE.free)


def dense(count: int) -> np.ndarray:
    """Stiffness of `count` slices in a row, end planes included."""
    K, s = np.zeros(((count + 1) * N,) * 2), PIECE.stiffness
    for i in range(count):
        at = slice(i * N, (i + 2) * N)
        K[at, at] += np.block([[s.aa, s.ab], [s.ab.T, s.bb]])
    return K


@pytest.mark.parametrize("count", [4, 5, 6, 7])
def test_solves_the_dense_system(count: int) -> None:
    b = np.random.default_rng(count).normal(size=((count - 1) * N, 2))
    exact = np.linalg.solve(dense(count)[N:-N, N:-N], b)
    found = np.vstack(HeldCell(PIECE, count).solve(np.split(b, count - 1)))
    np.testing.assert_allclose(found, exact, atol=1e-11 * np.abs(exact).max())


@pytest.mark.parametrize("count", [4, 5])
def test_loads_on_one_plane_only(count: int) -> None:
    K = dense(count)[N:-N, N:-N]
    for plane in range(count - 1):
        b = np.zeros((len(K), 1))
        b[plane * N + 7] = 1.0
        found = np.vstack(HeldCell(PIECE, count).solve(np.split(b, count - 1)))
        exact = np.linalg.solve(K, b)
        np.testing.assert_allclose(found, exact, atol=1e-11 * np.abs(exact).max())


@pytest.mark.parametrize(("count", "planes"), [(4, 1), (5, 2), (50, 24), (71, 35)])
def test_half_the_planes_are_kept_and_the_middle(count: int, planes: int) -> None:
    # what the memory of condensing a cell is made of: one block (n, n) a plane
    held = HeldCell(PIECE, count)
    assert len(held._P) == planes
    assert all(P.shape == (N, N) for P in (*held._P, held._middle))


@pytest.mark.parametrize("count", [4, 5])
def test_window_against_every_node(count: int) -> None:
    """Loads on the first of the two middle cells, eight cells, clamped."""
    found = window_response(HeldCell(PIECE, count), ROWS)
    K = dense(count * (2 * MARGIN + 2))
    first, ny = MARGIN * count, len(ROWS.surface_y)
    flexibility = np.zeros_like(K)
    flexibility[N:-N, N:-N] = np.linalg.inv(K[N:-N, N:-N])
    F = flexibility.reshape(len(K) // N, N, -1, N)
    pair = F[first : first + 2 * count + 1][:, :, first : first + count + 1]
    surface = np.einsum("an,pnqm,bm->paqb", ROWS.surface, pair, ROWS.surface)
    centre = np.einsum("an,pnqm,bm->paqb", ROWS.centre, pair, ROWS.surface)
    own = np.einsum("n,pnqm,m->pq", ROWS.centre[0], pair, ROWS.centre[0])
    p = np.arange(count + 1)
    expected = {
        "surface": surface.reshape(2 * count + 1, ny, -1),
        "centre": centre.reshape(2 * count + 1, 1, -1),
        "own_centre": np.stack([own[p, p], own[p + 1, p]]),
    }
    planes = F[(MARGIN - 1) * count :: count][:5, :, first : first + count + 1]
    contact = np.einsum("pnqm,bm->pnqb", planes, ROWS.surface).reshape(5, N, -1)
    foot = np.einsum("pnqm,bm->pnbq", planes, ROWS.foot).reshape(5, N, -1)
    expected["interfaces"] = np.concatenate([contact, foot], axis=-1)
    for name, exact in expected.items():
        tolerance = 1e-10 * np.abs(exact).max()
        np.testing.assert_allclose(getattr(found, name), exact, atol=tolerance, err_msg=name)


def test_slices_are_their_own_mirror_image() -> None:
    """What the elimination rests on, of a slice and of several in a row."""
    R = np.where(PIECE.free % 3 == 0, -1.0, 1.0)
    for s in (PIECE.stiffness, repeat(PIECE.stiffness, 5)):
        scale = np.abs(s.aa).max()
        np.testing.assert_allclose(R[:, None] * s.aa * R, s.bb, atol=1e-12 * scale)
        np.testing.assert_allclose(R[:, None] * s.ab * R, s.ab.T, atol=1e-12 * scale)

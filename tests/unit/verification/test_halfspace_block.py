import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.halfspace_block import HalfSpaceBlock
from contactstudy.verification.cases.point_loads import boussinesq


def test_graded_lines() -> None:
    lines = graded_lines(0.01, 0.002, 0.06)
    np.testing.assert_allclose(lines[:6], 0.002 * np.arange(6))
    steps = np.diff(lines)
    assert lines[-1] == pytest.approx(0.06)
    assert np.all(steps[5:] / steps[4:-1] < 1.351)
    with pytest.raises(InputError, match="graded mesh"):
        graded_lines(0.01, 0.02, 0.06)


def test_boussinesq_is_in_equilibrium() -> None:
    # Navier: (1/(1-2nu)) grad div u + laplace u = 0, by central differences
    nu, h = 0.3, 1e-4
    p0 = np.array([0.02, -0.01, 0.03])

    def u(p: np.ndarray) -> np.ndarray:
        return boussinesq(p[0], p[1], p[2], 210e9, nu)

    e = h * np.eye(3)
    laplace = sum((u(p0 + d) - 2 * u(p0) + u(p0 - d)) for d in e) / h**2

    def div(p: np.ndarray) -> float:
        return float(sum((u(p + e[i]) - u(p - e[i]))[i] for i in range(3)) / (2 * h))

    grad = np.array([(div(p0 + d) - div(p0 - d)) / (2 * h) for d in e])
    assert np.abs(grad / (1 - 2 * nu) + laplace).max() < 1e-3 * np.abs(laplace).max()


def test_far_surface_nodes_move_as_the_closed_form() -> None:
    lines = graded_lines(12e-3, 2e-3, 60e-3)
    patch = HalfSpaceBlock(lines, lines, lines).patch((slice(0, 7), slice(0, 7)))
    u = patch.flexibility[0].reshape(7, 7)
    X, Y = np.meshgrid(patch.x, patch.y, indexing="ij")
    far = np.hypot(X, Y) > 7e-3
    exact = boussinesq(X[far], Y[far], 0 * X[far], 210e9, 0.3)[:, 2]
    error = np.abs(u[far] / exact - 1).max()
    print(f"largest error beyond 3.5 elements: {100 * error:.2f} %")
    assert error < 0.02
    assert np.linalg.eigvalsh(patch.flexibility).min() > 0


def test_symmetry_gives_the_same_as_the_whole() -> None:
    lines = graded_lines(4e-3, 4e-3, 40e-3, growth=1.6)
    half = np.concatenate([-lines[:0:-1], lines])
    c = len(lines) - 1
    quarter = HalfSpaceBlock(lines, lines, lines).patch((slice(0, 3), slice(0, 3)))
    block = HalfSpaceBlock(half, half, lines, symmetric=(False, False))
    whole = block.patch((slice(c - 2, c + 3), slice(c - 2, c + 3)))
    F = whole.flexibility.reshape(5, 5, 5, 5)
    # unit total force shared by the four images, seen in the quarter x, y >= 0
    images = 0.25 * (F + F[:, :, ::-1] + F[:, :, :, ::-1] + F[:, :, ::-1, ::-1])[2:, 2:, 2:, 2:]
    np.testing.assert_allclose(quarter.flexibility, images.reshape(9, 9), rtol=1e-6)

"""Half-space stresses against Johnson's point load, numerical integration and Hertz's axis."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.halfspace.pressure_field import (
    SurfacePressure,
    bilinear_pressure,
    recovered_pressure,
)
from contactstudy.halfspace.subsurface import half_space_stress, stress_maxima
from contactstudy.solids.stress import maximum_shear, von_mises

POINTS = np.array([[0.3, -0.2, 0.8], [-1.4, 0.5, 0.25], [0.02, 1.3, 0.1], [0.1, 0.45, 0.6]])


def point_load(x, y, z, nu):
    """Stresses of a unit normal force, Johnson, Contact Mechanics (1985), eq. (3.19).

    The factor 2 in xy follows from rotating xx and yy about the axis.
    """
    rho = np.sqrt(x**2 + y**2 + z**2)
    r2 = x**2 + y**2
    k = (1 - 2 * nu) / r2
    xx = k * ((1 - z / rho) * (x**2 - y**2) / r2 + z * y**2 / rho**3) - 3 * z * x**2 / rho**5
    yy = k * ((1 - z / rho) * (y**2 - x**2) / r2 + z * x**2 / rho**3) - 3 * z * y**2 / rho**5
    xy = k * ((1 - z / rho) * 2 * x * y / r2 - x * y * z / rho**3) - 3 * x * y * z / rho**5
    rest = -3 * z**2 / rho**5
    return np.stack([xx, yy, z * rest, y * rest, x * rest, xy], axis=-1) / (2 * np.pi)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.45])
def test_rectangle_is_the_integral_of_point_loads(nu):
    load = SurfacePressure(
        np.array([-0.5, 0.1, 0.7]), np.array([-0.3, 0.45]), np.array([[2.0], [5.0]])
    )
    node, weight = np.polynomial.legendre.leggauss(60)
    exact = np.zeros((len(POINTS), 6))
    for i in range(2):
        hx, hy = 0.5 * np.diff(load.x)[i], 0.5 * np.diff(load.y)[0]
        X, Y = np.meshgrid(load.x[i] + hx * (1 + node), load.y[0] + hy * (1 + node), indexing="ij")
        W = load.pressure[i, 0] * hx * hy * np.outer(weight, weight)
        for n, (x, y, z) in enumerate(POINTS):
            exact[n] += np.einsum("ij,ijs->s", W, point_load(x - X, y - Y, z, nu))
    np.testing.assert_allclose(half_space_stress(load, POINTS, nu), exact, atol=1e-8)


def test_equilibrium_and_the_load_on_a_plane():
    load = bilinear_pressure(
        np.linspace(-1, 1, 5), np.linspace(-1, 1, 4), np.random.default_rng(1).random((5, 4)), 2
    )
    # div s = 0 by central differences
    h, p = 1e-4, np.array([0.2, -0.4, 0.5])
    moved = p + h * np.concatenate([np.eye(3), -np.eye(3)])
    s = half_space_stress(load, moved)[:, [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]
    gradient = (s[:3] - s[3:]) / (2 * h)
    assert np.abs(np.einsum("iij->j", gradient)).max() < 1e-6 * np.abs(gradient).max()
    # the force through a plane at depth z is the load; beyond the distance c it lacks (z/c)^3
    line = np.arange(-60.0, 61.0)
    X, Y = np.meshgrid(line, line, indexing="ij")
    plane = np.stack([X.ravel(), Y.ravel(), np.full(X.size, 3.0)], axis=1)
    assert -half_space_stress(load, plane)[:, 2].sum() == pytest.approx(load.force, rel=1e-3)


def test_bilinear_pressure_keeps_the_force():
    x, y = np.array([0.0, 1.0, 1.5, 3.0]), np.array([-1.0, 0.0, 2.0])
    nodal = np.array([[1.0, 2.0, 0.0], [3.0, 1.0, 4.0], [0.5, 0.0, 2.0], [1.0, 1.0, 1.0]])
    exact = np.trapezoid(np.trapezoid(nodal, y, axis=1), x)
    for parts in (1, 3):
        assert bilinear_pressure(x, y, nodal, parts).force == pytest.approx(exact, rel=1e-14)
    with pytest.raises(InputError, match="as many values as nodes"):
        bilinear_pressure(x, y, nodal.T)
    with pytest.raises(InputError, match="depth must be above 0"):
        half_space_stress(bilinear_pressure(x, y, nodal), np.zeros((1, 3)))


def test_recovered_pressure_undoes_the_smoothing_of_the_projection():
    # p = S q for q = cos(x) cos(y), whose lumped projection is q (1 - h^2/6 ...)^2
    errors = []
    for n in (12, 24):
        x = np.linspace(-1.0, 1.0, n + 1)
        q = np.outer(np.cos(x), np.cos(x))
        h = x[1] - x[0]
        factor = (2 + np.cos(h)) / 3  # of the inner rows: (cos(x-h) + 4 cos x + cos(x+h))/6
        nodal = q * factor**2
        field = recovered_pressure(x, x, nodal, parts=1)
        exact = bilinear_pressure(x, x, q, parts=1)
        inner = np.s_[3:-3, 3:-3]
        errors.append(np.abs(field.pressure - exact.pressure)[inner].max())
        assert field.force == pytest.approx(bilinear_pressure(x, x, nodal, 1).force, rel=1e-14)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)


def test_stress_under_a_hertzian_patch_is_that_of_its_axis():
    # Huber 1904 (Johnson eq. 3.45), on the axis of a circular patch:
    # s_zz = -p0/(1 + t^2), s_rr = -p0 ((1+nu)(1 - t atan(1/t)) - 1/(2 (1+t^2))), t = z/a
    a, n, nu = 1.0, 40, 0.3
    lines = np.linspace(-a, a, n + 1)
    mid = 0.5 * (lines[1:] + lines[:-1])
    inside = 1 - mid[:, None] ** 2 - mid[None, :] ** 2
    load = SurfacePressure(lines, lines, np.sqrt(np.maximum(inside, 0)))
    t = np.array([0.1, 0.3, 0.48, 1.0, 2.0])
    s = half_space_stress(load, np.stack([0 * t, 0 * t, t], axis=1), nu)
    zz = -1 / (1 + t**2)
    rr = -(1 + nu) * (1 - t * np.arctan(1 / t)) + 0.5 / (1 + t**2)
    np.testing.assert_allclose(s[:, 2], zz, atol=3e-3)
    np.testing.assert_allclose(s[:, :2], np.stack([rr, rr], axis=1), atol=3e-3)
    np.testing.assert_allclose(s[:, 3:], 0, atol=1e-12)
    mises, shear = stress_maxima(load, nu)
    print(f"sphere: max shear {shear.value:.4f} p0 at {shear.depth:.3f} a (0.310 at 0.48)")
    assert shear.value == pytest.approx(0.310, rel=0.01)
    assert shear.depth == pytest.approx(0.48, abs=0.015)
    assert mises.value == pytest.approx(0.620, rel=0.01)
    assert abs(shear.x) < 0.05 and abs(shear.y) < 0.05


def test_no_pressure_no_stress():
    load = SurfacePressure(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.zeros((1, 1)))
    assert [m.value for m in stress_maxima(load)] == [0.0, 0.0]
    assert not half_space_stress(load, POINTS).any()


def test_invariants():
    uniaxial = np.array([7.0, 0, 0, 0, 0, 0])
    pure_shear = np.array([0, 0, 0, 0, 3.0, 0])
    assert von_mises(uniaxial) == pytest.approx(7.0)
    assert maximum_shear(uniaxial) == pytest.approx(3.5)
    assert von_mises(pure_shear) == pytest.approx(3 * np.sqrt(3))
    assert maximum_shear(pure_shear) == pytest.approx(3.0)
    assert von_mises(uniaxial + 5 * np.array([1, 1, 1, 0, 0, 0])) == pytest.approx(7.0)

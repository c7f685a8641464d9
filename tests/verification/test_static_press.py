"""Static press of a cylinder R = 0.43 m on the crown of 0.30 m against Hertz.

Both bodies are finite blocks with Boussinesq's displacements imposed on their outer faces, so
that they act as Hertz's half-spaces. Published figures: `references` in the comments.
"""

from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from contactstudy.contact.augmented import Penalty
from contactstudy.contact.press import (
    PressCurve,
    press_curve,
    tangent_stiffness,
)
from contactstudy.geometry.interpolation import SplineLine
from contactstudy.geometry.placement import Geometry
from contactstudy.geometry.points import ContactPoints, contact_points
from contactstudy.profiles.named import rail_curve, wheel_curve
from contactstudy.verification.cases.contact_ellipse import contact_ellipse
from contactstudy.verification.cases.graded import graded_lines
from contactstudy.verification.cases.halfspace_block import HalfSpaceBlock

BODIES = Geometry(rail_curve(), wheel_curve("cylinder"), 0.43)
LOADS = np.array([50e3, 60e3, 80e3, 100e3])
MARGIN = 2  # surface lines beyond the contact points, for the spline


def hertz(force: float) -> tuple[float, float, float, float]:
    """Semi-axes along and across, peak pressure, approach of the crossed cylinders (SI)."""
    modulus = 210e9 / (2 * (1 - 0.3**2))
    A, B = 1 / (2 * 0.43), 1 / (2 * 0.30)

    def ratio(k: float) -> float:
        m = 1 - k * k
        return float((ellipe(m) / k**2 - ellipk(m)) / (ellipk(m) - ellipe(m)) - B / A)

    k = brentq(ratio, 0.05, 0.9999)
    m = 1 - k * k
    a = (3 * force * ellipe(m) / (2 * np.pi * modulus * (A + B) * k**2)) ** (1 / 3)
    p0 = 1.5 * force / (np.pi * a * a * k)
    return float(a), float(k * a), float(p0), float(p0 * k * a * ellipk(m) / modulus)


@cache
def block(size: float) -> tuple[ContactPoints, np.ndarray]:
    """Contact points and flexibility of the two blocks, surface mesh of the given size."""
    length, width = 10e-3, 8e-3
    x = graded_lines(length + MARGIN * size, size, 60e-3)
    y = graded_lines(width + MARGIN * size, size, 60e-3)
    z = graded_lines(4e-3, size, 60e-3)
    nx, ny = round(length / size) + MARGIN + 1, round(width / size) + MARGIN + 1
    patch = HalfSpaceBlock(x, y, z).patch((slice(0, nx), slice(0, ny)))
    full = np.concatenate([-patch.x[:0:-1], patch.x])
    points = contact_points(BODIES, patch.x[:-MARGIN], patch.y[:-MARGIN], symmetric=True)
    assert len(full) == 2 * nx - 1
    # quarter model: the points stand for x < 0 as well, and the rail's rows mirror there
    quarter = points.__class__(**{**points.__dict__, "area": 2 * points.area})
    # rail's nodes at x < 0 fold onto their images
    fold = np.kron(np.eye(nx)[np.abs(np.arange(2 * nx - 1) - (nx - 1))], np.eye(ny))
    along, across = SplineLine(full), SplineLine(patch.y, mirrored=True)
    Pr = np.kron(along(quarter.x), across(quarter.y)) @ fold
    wheel = quarter.wheel_rows
    column = wheel.index // len(quarter.wheel_y) * ny + wheel.index % len(quarter.wheel_y)
    Pw = wheel.__class__(column, wheel.weight).matrix(nx * ny)
    F = patch.flexibility
    return quarter, Pr @ F @ Pr.T + Pw @ F @ Pw.T


@cache
def pressed(size: float, penalty: float = 1e16) -> PressCurve:
    points, W = block(size)
    return press_curve(points, W, LOADS, Penalty(penalty))


def force_errors(size: float, penalty: float = 1e16) -> np.ndarray:
    """Relative error of the force at Hertz's approach: F/F_H = (d_H/d)^(3/2) at equal F."""
    curve = pressed(size, penalty)
    reference = np.array([hertz(f)[3] for f in LOADS])
    return np.asarray((reference / curve.approach) ** 1.5 - 1)


def ellipse_errors(size: float) -> np.ndarray:
    """Relative errors of a, b, p0 by moments and p0 at the nodes, (4, loads)."""
    points, _ = block(size)
    wheel_x = np.concatenate([-points.wheel_x[:0:-1], points.wheel_x])
    whole = contact_points(BODIES, wheel_x, points.wheel_y, symmetric=True)
    rows = []
    for force, solution in zip(LOADS, pressed(size).solutions, strict=True):
        a, b, p0, _ = hertz(force)
        right = 0.5 * solution.forces.reshape(len(points.x), -1)
        ellipse = contact_ellipse(whole, np.concatenate([right[::-1], right]).ravel())
        nodal = points.nodal_pressure(solution.forces).max()
        rows.append([ellipse.along / a, ellipse.across / b, ellipse.peak_pressure / p0, nodal / p0])
    return np.array(rows).T - 1


def test_closed_form_is_the_published_one() -> None:
    # 50, 80, 100 kN: semi-axes mm, peak MPa, approach um
    for force, expected in (
        (50e3, (5.500, 4.327, 1003.1, 66.38)),
        (80e3, (6.433, 5.061, 1173.25, 90.808)),
        (100e3, (6.930, 5.452, 1263.8, 105.37)),
    ):
        a, b, p0, d = hertz(force)
        np.testing.assert_allclose((a * 1e3, b * 1e3, p0 * 1e-6, d * 1e6), expected, rtol=2e-4)


def test_force_over_approach_at_2_mm() -> None:
    errors = force_errors(2e-3)
    print("force over approach at 2 mm, error against Hertz:", np.round(100 * errors, 3), "%")
    assert np.abs(errors).max() < 0.005


def test_exponent() -> None:
    for size in (2e-3, 1e-3):
        exponent = pressed(size).exponent
        print(f"exponent at {size * 1e3:g} mm: {exponent:.4f} (Hertz 1.5)")
        assert abs(exponent - 1.5) < 0.02


def test_pressure_and_semi_axes_at_1_mm() -> None:
    errors = ellipse_errors(1e-3)
    for name, row in zip(("a", "b", "p0 (moments)", "p0 (nodes)"), errors, strict=True):
        print(f"{name} at 1 mm, error against Hertz:", np.round(100 * row, 2), "%")
    assert np.abs(errors[:2]).max() < 0.03
    assert np.abs(errors[2:]).max() < 0.02


def test_converges_with_the_mesh() -> None:
    sizes = (4e-3, 2e-3, 1e-3)
    force = [np.abs(force_errors(h)).mean() for h in sizes]
    axes = [np.abs(ellipse_errors(h)[:2]).mean() for h in sizes]
    peak = [np.abs(ellipse_errors(h)[2]).mean() for h in sizes]
    for name, row in (("force", force), ("semi-axes", axes), ("peak", peak)):
        print(f"{name}: mean error at 4, 2, 1 mm", np.round(100 * np.array(row), 3), "%")
        assert row[0] > row[1] > row[2]


def test_converges_with_the_penalty() -> None:
    # the published codes lose 0.83 and 9.9 % of the force at 1e15 and 1e14 Pa/m
    stiff = pressed(1e-3, 1e18).approach
    shares = [pressed(1e-3, e).approach / stiff - 1 for e in (1e14, 1e15, 1e16)]
    print("approach added by a penalty of 1e14, 1e15, 1e16 Pa/m:", [s.max() for s in shares])
    assert np.all(shares[0] > shares[1]) and np.all(shares[1] > shares[2])
    assert shares[2].max() < 0.002
    points, _ = block(1e-3)
    curve = pressed(1e-3)
    for delta, solution in zip(curve.approach, curve.solutions, strict=True):
        penetration = points.nodal_pressure(solution.forces).max() / 1e16
        assert penetration < 0.01 * delta


def test_tangent() -> None:
    points, W = block(2e-3)
    curve = press_curve(points, W, np.array([80e3 - 1, 80e3, 80e3 + 1]))
    slope = 2 / (curve.approach[2] - curve.approach[0])
    assert curve.stiffness[1] == pytest.approx(slope, rel=1e-5)
    curve = press_curve(points, W, np.linspace(40e3, 120e3, 9))
    fitted = tangent_stiffness(curve, 80e3)
    print(f"tangent at 80 kN, 2 mm: {fitted:.5e} N/m (Hertz 1.322e9); polygon {slope:.5e}")
    assert fitted == pytest.approx(1.322e9, rel=0.01)

"""Stresses below the patch against Johnson's closed forms and tables."""

import numpy as np
import pytest

from contactstudy.verification.cases import block_stresses, stress_below
from contactstudy.verification.cases.point_loads import flamant
from contactstudy.verification.cases.strip import Strip
from contactstudy.verification.check import check_lines


def judged(case):
    print(check_lines(case.checks))
    assert not case.failed


def test_line():
    judged(stress_below.below_line())


def test_ellipses():
    judged(stress_below.below_ellipses())


def test_sphere_on_coarse_meshes():
    rows = block_stresses.sphere_stresses((2.0, 3.0, 4.0))
    exact = stress_below.exact_sphere_shear()
    for row in rows:
        print(row)
    # second order: (2/4)^2 of the error
    assert block_stresses.shear_order(rows, exact) == pytest.approx(2.0, abs=0.5)
    assert rows[-1].field_shear == pytest.approx(exact, rel=0.03)
    assert exact == pytest.approx(0.310, abs=5e-4)
    assert stress_below.exact_line_shear() == pytest.approx(0.300, abs=5e-4)


@pytest.mark.slow
def test_sphere():
    judged(stress_below.below_sphere())


def test_flamant_is_the_simple_radial_stress():
    # s_rr = -2 cos(theta)/(pi r) and nothing else, by central differences
    E, nu, h = 210e9, 0.3, 1e-6
    for p in np.array([[0.02, 0.03], [-0.05, 0.01], [0.0, 0.04]]):
        gradient = np.stack(
            [
                (flamant(*(p + d), E, nu) - flamant(*(p - d), E, nu)) / (2 * h)
                for d in h * np.eye(2)
            ],
            axis=1,
        )
        strain = 0.5 * (gradient + gradient.T)
        lam, mu = E * nu / (1 + nu) / (1 - 2 * nu), E / (2 * (1 + nu))
        stress = lam * np.trace(strain) * np.eye(2) + 2 * mu * strain
        r = np.hypot(*p)
        np.testing.assert_allclose(
            stress, -2 * p[1] / (np.pi * r**4) * np.outer(p, p), atol=1e-6 / r
        )


def test_strip_moves_as_flamant_away_from_the_load():
    lines = np.linspace(0.0, 20e-3, 21)
    strip = Strip(lines, lines)
    u = strip.displacement(1)[..., 0]
    X, Z = np.meshgrid(lines, lines, indexing="ij")
    far = np.hypot(X, Z) > 5e-3
    exact = flamant(X[far], Z[far], 210e9, 0.3)
    assert np.abs(u[far] - exact).max() < 0.01 * np.ptp(exact)

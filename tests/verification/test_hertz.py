"""Hertz's closed forms against published figures and limits."""

import math

import numpy as np
import pytest

from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.verification.cases.line_contact import line_contact

# E [GPa], load [kN]: semi-axes [mm], p0 [MPa], approach [um], k_H [N/m^1.5], tangent [GN/m]
CROSSED = [
    (210, 50, 5.500, 4.327, 1003.1, 66.38, 9.245e10, 1.130),
    (210, 60, 5.84, 4.60, 1066.0, 74.96, 9.25e10, 1.20),
    (210, 80, 6.433, 5.061, 1173.25, 90.808, 9.245e10, 1.322),
    (210, 100, 6.930, 5.452, 1263.8, 105.37, 9.245e10, 1.424),
    (206, 75, 6.336, 4.985, 1133.65, 88.106, 9.0689e10, 1.27687),
]


@pytest.mark.parametrize(("modulus", "load", "a", "b", "p0", "approach", "k_h", "tangent"), CROSSED)
def test_wheel_on_crown(modulus, load, a, b, p0, approach, k_h, tangent):
    h = hertz_contact(1e3 * load, contact_modulus(1e9 * modulus, 0.3), 0.43, 0.30)
    print(f"{load} kN: published {a}/{b} mm, {p0} MPa, {approach} um; computed {h}")
    assert 1e3 * h.semi_axis_x == pytest.approx(a, rel=1e-3)
    assert 1e3 * h.semi_axis_y == pytest.approx(b, rel=1e-3)
    assert 1e-6 * h.peak_pressure == pytest.approx(p0, rel=1e-4)
    assert 1e6 * h.approach == pytest.approx(approach, rel=1e-4)
    assert h.stiffness == pytest.approx(k_h, rel=1e-3)
    assert 1e-9 * h.tangent_stiffness == pytest.approx(tangent, rel=1e-3)
    assert h.tangent_stiffness == pytest.approx(1.5 * h.secant_stiffness)
    # the axes follow the radii
    turned = hertz_contact(1e3 * load, contact_modulus(1e9 * modulus, 0.3), 0.30, 0.43)
    assert turned.semi_axis_y == h.semi_axis_x


def test_sphere_on_flat():
    h = hertz_contact(80e3, contact_modulus(), 0.43, 0.43)
    exact = 4 / 3 * contact_modulus() * math.sqrt(0.43)
    print(f"F/d^1.5: published 1.0088e11, 4/3 E* sqrt(R) = {exact:.5e}, computed {h.stiffness:.5e}")
    assert h.stiffness == pytest.approx(1.0088e11, rel=1e-4)
    assert h.stiffness == pytest.approx(exact, rel=1e-12)
    assert h.semi_axis_x == pytest.approx((3 * 80e3 * 0.43 / (4 * contact_modulus())) ** (1 / 3))


def test_two_spheres_of_code_aster_ssnv104():
    # R = 50 mm, E = 20 GPa, nu = 0.3, crush 4 mm: largest pressure 2798.3 MPa, radius 10 mm
    e_star = contact_modulus(20e9, 0.3)
    unit = hertz_contact(1.0, e_star, 0.025, 0.025)
    h = hertz_contact(unit.stiffness * 0.004**1.5, e_star, 0.025, 0.025)
    print(f"published 2798.3 MPa, 10 mm; computed {h.peak_pressure:.5e} Pa, {h.semi_axis_x:.6f} m")
    assert h.peak_pressure == pytest.approx(2798.3e6, rel=1e-4)
    assert h.semi_axis_x == pytest.approx(0.010, rel=1e-12)


def test_pressure_integrates_to_the_load_and_solves_the_gap():
    h = hertz_contact(60e3, contact_modulus(), 0.43, 0.30)
    x = np.linspace(-1, 1, 801)[:, None] * h.semi_axis_x
    y = np.linspace(-1, 1, 801)[None, :] * h.semi_axis_y
    total = h.pressure(x, y).sum() * (x[1, 0] - x[0, 0]) * (y[0, 1] - y[0, 0])
    assert total == pytest.approx(60e3, rel=1e-3)
    assert h.peak_pressure == pytest.approx(1.5 * h.load / h.area)


def test_a_long_ellipse_tends_to_line_contact():
    h = hertz_contact(1e5, contact_modulus(), 0.43, 4.3e4)
    # in the middle of a long patch the pressure is that of the line load there, 3F/4a
    line = line_contact(0.75 * h.load / h.semi_axis_y, contact_modulus(), 0.43)
    assert h.semi_axis_x == pytest.approx(line.half_width, rel=1e-3)
    assert h.peak_pressure == pytest.approx(line.peak_pressure, rel=1e-3)

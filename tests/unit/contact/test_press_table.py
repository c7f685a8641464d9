"""The table of a press: Hertz's half-spaces, and what a wheel's modes take of it."""

from types import SimpleNamespace

import numpy as np
import pytest

from contactstudy.contact.augmented import Penalty
from contactstudy.contact.law_forces import of_penetration
from contactstudy.contact.laws import PressSpring
from contactstudy.contact.press_table import LARGEST, PressTable, press_table
from contactstudy.exceptions import NumericalError
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.verification.cases.patch_filter import influence_matrix

LOAD, CELL = 80e3, 0.75e-3
HERTZ = hertz_contact(LOAD, contact_modulus(), 0.43, 0.30)


def pressed(n: int) -> PressTable:
    """Rectangles of Love's on half-spaces, n on half the length."""
    x, y = CELL * np.arange(-n, n + 1), CELL * np.arange(-11, 12)
    X, Y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    M = influence_matrix(X, Y, CELL, CELL, contact_modulus()) / CELL**2
    points = SimpleNamespace(
        x=x,
        gap=X**2 / 0.86 + Y**2 / 0.60,
        normal_z=np.ones(len(X)),
        area=np.full(len(X), CELL**2),
        edge_reached=lambda on: "along" if on.reshape(len(x), -1)[[0, -1]].any() else "",
    )
    law = Penalty(1e20)
    return press_table(points, M, LOAD, law, np.zeros(len(X)))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def table() -> PressTable:
    """Of places enough for the largest load."""
    return pressed(13)


def test_a_table_ends_where_the_places_do(table: PressTable) -> None:
    cut = pressed(11)
    short = PressSpring(cut.approach, cut.force)
    # a patch that reaches a = 11 cells carries (a/a0)^3 of the load
    limit = LOAD * (11 * CELL / HERTZ.semi_axis_x) ** 3
    assert 0.8 * limit < short.largest < 1.05 * limit < LARGEST * LOAD
    for share in (0.5, 1.0):
        whole = PressSpring(table.approach, table.force).approach_at(share * LOAD)
        assert short.approach_at(share * LOAD) == pytest.approx(whole, rel=1e-3)
    with pytest.raises(NumericalError, match=r"along the rail .* \(contact_half_length"):
        pressed(8)


def test_force_over_approach_is_that_of_hertz(table: PressTable) -> None:
    law = PressSpring(table.approach, table.force)
    assert law.largest == pytest.approx(LARGEST * LOAD)
    for share in (0.2, 0.5, 1.0, 2.0, LARGEST):
        exact = HERTZ.approach * share ** (2 / 3)
        print(f"{share:g} F0: approach {law.approach_at(share * LOAD):.4e}, Hertz {exact:.4e} m")
        assert law.approach_at(share * LOAD) == pytest.approx(exact, rel=6e-3)
    assert float(table.tangent) == pytest.approx(HERTZ.tangent_stiffness, rel=0.01)
    assert float(table.secant) == pytest.approx(HERTZ.secant_stiffness, rel=6e-3)


def test_slope_has_no_steps_of_the_cells(table: PressTable) -> None:
    d = np.linspace(0.3, 1.9, 200) * HERTZ.approach
    one, none = PressSpring(table.approach, table.force), np.zeros(0)
    slope = np.array([of_penetration(one.kind, one.numbers, none, v)[1] for v in d])
    exact = 1.5 * HERTZ.stiffness * np.sqrt(d)
    np.testing.assert_allclose(slope, exact, rtol=0.025)


@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("wavelength", [0.02, 0.05, 0.1])
def test_weights_are_those_of_the_ellipse(
    table: PressTable, share: float, wavelength: float
) -> None:
    weights = table.weights_at(share * LOAD)
    assert weights.sum() == pytest.approx(1.0)
    k = 2 * np.pi / wavelength
    ka = k * HERTZ.semi_axis_x * share ** (1 / 3)
    assert weights @ np.cos(k * table.offsets) == pytest.approx(np.sin(ka) / ka, abs=0.01)

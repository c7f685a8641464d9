"""Text with units against factors known by hand."""

from dataclasses import dataclass
from typing import Annotated, Literal

import pytest

from contactstudy.exceptions import InputError
from contactstudy.units import Limits, UnitError, to_si
from contactstudy.validation import Above, Parameters, Unit


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("300 km/h", "m/s", 300 / 3.6),
        ("65 MN/m", "N/m", 65e6),
        ("75 kN·s/m", "N*s/m", 75e3),
        ("75 kN s/m", "N*s/m", 75e3),
        ("75 kN*s/m", "N*s/m", 75e3),
        ("2 mm", "m", 2e-3),
        ("2mm", "m", 2e-3),
        ("5e-5 s", "s", 5e-5),
        ("50 µs", "s", 5e-5),
        ("50 μs", "s", 5e-5),  # Greek mu instead of the micro sign
        ("-3 kN", "N", -3e3),
        ("1e11 N/m", "N/m", 1e11),
        ("890 kg", "kg", 890.0),
        ("0.8e-7 m^2*rad/m", "m^2*rad/m", 0.8e-7),
        ("0.08 rad/m", "rad/m", 0.08),
        ("30 MN/m^2", "N/m^2", 30e6),
        ("210 GPa", "Pa", 210e9),
        ("1e16 Pa/m", "Pa/m", 1e16),
        ("42", "m", 42.0),
        (42, "m", 42.0),
        (0.43, "m", 0.43),
    ],
)
def test_known_factors(text, unit, value):
    assert to_si(text, unit) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("65 kg", r"wrong unit 'kg'; allowed: N/m"),
        ("65 furlong_per_blink", "must be a number in N/m"),
        ("65 blink", r"unknown unit 'blink'; allowed: N/m"),
        ("many", "must be a number in N/m"),
        ("", "must be a number in N/m"),
        ("__import__('os')", "must be a number in N/m"),
        ("1 N/m + 2 N/m", "must be a number in N/m"),
        (True, "must be a number in N/m"),
        ([1.0], "must be a number in N/m"),
        (float("nan"), "must be finite"),
        ("1e999 N/m", "must be finite"),
    ],
)
def test_what_is_no_stiffness(value, message):
    with pytest.raises(UnitError, match=message):
        to_si(value, "N/m")


def test_limits_say_what_is_allowed():
    with pytest.raises(UnitError, match=r"^must be above 0 N/m$"):
        Limits("N/m", above=0)("-65 MN/m")
    with pytest.raises(UnitError, match=r"^must be at least 0 and at most 0.5$"):
        Limits(at_least=0, at_most=0.5)(0.7)
    with pytest.raises(UnitError, match=r"^must be a whole number at least 1$"):
        Limits(at_least=1, whole=True)(2.5)
    assert Limits(at_least=1, whole=True)(4) == 4


@dataclass(frozen=True)
class Spring(Parameters):
    k_r: Annotated[float | Literal["tangent", "rigid"], Unit("N/m"), Above(0)]


def test_names_beside_a_quantity():
    assert Spring("tangent").k_r == "tangent" and Spring("1 GN/m").k_r == 1e9
    with pytest.raises(InputError, match='or "tangent" or "rigid"'):
        Spring("tangental")

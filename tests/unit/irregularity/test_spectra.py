import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.irregularity import Convention, fra, german, paper_spectrum, spectrum, tbt3352
from contactstudy.irregularity.spectra import NAMES


def test_printed_formulas_at_single_points():
    w = 0.7
    assert spectrum("paper")(w) == pytest.approx(0.8e-7 / (w**2 * (w**2 + 1.0)))
    assert german("high")(w) == pytest.approx(
        0.5 * 1.08e-6 * 0.8246**2 / ((w**2 + 0.0206**2) * (w**2 + 0.8246**2))
    )
    assert fra(4)(w) == pytest.approx(
        0.5 * 0.25 * 0.5376e-4 * 0.8245**2 / (w**2 * (w**2 + 0.8245**2))
    )
    # printed one-sided in mm^2/(1/m) over f = omega/2 pi
    printed = Convention("one", "1/m", 1e-6)
    assert tbt3352().density(0.1, printed) == pytest.approx(1.9784e-2 / 0.1**1.3643)
    assert tbt3352()(0.2 * np.pi) == pytest.approx(1.9784e-2 / 0.1**1.3643 * 1e-6 / 4 / np.pi)


def test_conventions_hold_the_same_variance():
    g = spectrum("tbt3352")
    w = np.geomspace(0.08, 20.0, 20001)
    two_sided = 2.0 * np.trapezoid(g(w), w)
    f = w / (2.0 * np.pi)
    one_sided_mm = np.trapezoid(g.density(f, Convention("one", "1/m", 1e-6)), f)
    assert one_sided_mm * 1e-6 == pytest.approx(two_sided, rel=1e-12)
    # the trapezoidal rule does not see where the standard's four branches jump
    assert g.variance(0.08, 20.0) == pytest.approx(two_sided, rel=2e-5)
    assert Convention("one", "1/m", 1e-6).unit == "mm^2/(1/m)"


def test_two_sided_reading_doubles_the_density():
    assert german("low", sides="two")(1.0) == pytest.approx(2.0 * german("low")(1.0))
    assert spectrum("fra6", sides="two")(1.0) == pytest.approx(2.0 * fra(6)(1.0))
    assert spectrum("paper").read("one")(1.0) == pytest.approx(0.5 * spectrum("paper")(1.0))
    assert german("low", "lateral")(1.0) / german("low")(1.0) == pytest.approx(2.119 / 4.032)


def test_tbt3352_branches_meet():
    g, eps = tbt3352(), 1e-9
    for f in (0.0187, 0.0474, 0.1533):
        below, above = g(2 * np.pi * f * (1 - eps)), g(2 * np.pi * f * (1 + eps))
        assert above == pytest.approx(below, rel=0.02)  # the standard's rounded coefficients


def test_paper_spectrum_with_its_other_parameter():
    g = paper_spectrum(roughness=1e-7, omega_1=0.3, omega_2=2.0)
    assert g(1.5) == pytest.approx(1e-7 * 4 * (2.25 + 0.09) / (1.5**4 * (2.25 + 4)))


@pytest.mark.parametrize("name", NAMES)
def test_every_name_is_found_in_any_spelling(name):
    assert spectrum(name)(1.0) == spectrum(name.upper().replace("_", " "))(1.0)


def test_misspelt_names_and_parameters_list_what_is_allowed():
    with pytest.raises(InputError, match=r"did you mean 'german_low'.*paper, german_low"):
        spectrum("germn low")
    with pytest.raises(InputError, match="allowed: roughness, omega_1, omega_2"):
        spectrum("paper", rougness=1e-7)
    with pytest.raises(InputError, match="above 0"):
        spectrum("paper", roughness=-1e-7)
    with pytest.raises(InputError, match="1, 2, 3, 4, 5, 6"):
        fra(7)
    with pytest.raises(InputError, match="wavenumbers must be above 0"):
        spectrum("paper")([0.0, 1.0])

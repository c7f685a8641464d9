"""Sections of rails: published values, what is meshed, what is refused."""

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.halfspace.hertz import contact_modulus, hertz_contact
from contactstudy.profiles.rail import NAMES
from contactstudy.solids.recipe import CellRecipe
from contactstudy.study.kinds.passage import contact
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.track.rail import RAILS
from contactstudy.track.solid import solid_rail


# EN 13674-1, GB 2585, JIS E 1101: kg/m, cm^2, cm^4, cm^4
@pytest.mark.parametrize(
    ("name", "mass", "area", "vertical", "lateral"),
    [
        ("60E1", 60.21, 76.70, 3038.3, 512.3),
        ("54E1", 54.77, 69.77, 2337.9, 419.2),
        ("49E1", 49.39, 62.92, 1816.0, 319.1),
        ("CHN60", 60.64, 77.45, 3217.0, 524.0),
        ("JIS60", 60.8, 77.5, 3090.0, 512.0),
    ],
)
def test_rails_have_their_published_section(name, mass, area, vertical, lateral):
    rail = RAILS.classes[name]()
    assert rail.mass_per_length == pytest.approx(mass, rel=1e-3)
    assert 1e4 * rail.section.area == pytest.approx(area)
    assert rail.bending_stiffness("Z") == pytest.approx(210e9 * vertical * 1e-8)
    assert rail.bending_stiffness("Y") == pytest.approx(210e9 * lateral * 1e-8)
    assert (rail.profile_name is not None) == (name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_meshed_sections_are_near_the_drawn_ones(name):
    drawn, meshed = RAILS.classes[name](), solid_rail(CellRecipe(profile=name))
    assert meshed.profile_name == name
    for part, within in (("area", 2e-3), ("second_moment_y", 5e-3), ("second_moment_z", 2e-2)):
        found = getattr(meshed.section, part)
        assert found == pytest.approx(getattr(drawn.section, part), rel=within), part
    assert meshed.section.shear_coefficient_z == pytest.approx(0.4, abs=0.04)
    np.testing.assert_allclose(meshed.section.centroid_z, drawn.section.centroid_z, atol=3e-4)


def passage(rail, **run):
    return parse_study("rail", {"track": {"rail": rail}, "runs": {"one": run}})


def test_rails_without_a_drawing_are_not_meshed():
    for run in ({"solver": "surface"}, {"solver": "point", "law": "press"}):
        with pytest.raises(InputError, match='rail = "JIS60": what is meshed needs a rail with a'):
            passage("JIS60", **run)
    study = passage("JIS60", solver="point", k_r="hertz_tangent")
    # the crown of the Japanese rail has 600 mm
    closed = hertz_contact(study.vehicle.static_load, contact_modulus(), 0.43, 0.6)
    law = contact.contact_law(study, "one")
    assert law.stiffness == pytest.approx(closed.tangent_stiffness)
    assert study.config()["track"]["rail"] == "JIS60"


def test_an_unknown_rail_names_those_that_there_are():
    with pytest.raises(InputError, match=r'track\.rail = "54E9": must be "60E1", "54E1"'):
        passage("54E9", solver="point")

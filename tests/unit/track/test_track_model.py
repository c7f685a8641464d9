import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.track.model import (
    Ballast,
    DiscreteSupports,
    GivenRail,
    Rail,
    Slab,
    Track,
    WinklerFoundation,
)


def test_nominal_rail_has_the_tabulated_values():
    rail = Rail()
    assert rail.mass_per_length == pytest.approx(60.2, rel=1e-3)
    assert rail.bending_stiffness("Z") == pytest.approx(6.38e6, rel=1e-3)
    assert rail.bending_stiffness("Y") == pytest.approx(210e9 * 512.3e-8)
    assert rail.shear_modulus == pytest.approx(80.77e9, rel=1e-4)


def test_a_given_rail_gives_them_back():
    rail = GivenRail(EI=2.1e7, mass=78.5, area=0.01, shear_coefficient=0.5)
    assert rail.bending_stiffness() == pytest.approx(2.1e7)
    assert rail.bending_stiffness("Y") == pytest.approx(2.1e7)
    assert rail.mass_per_length == pytest.approx(78.5)
    assert rail.shear_stiffness() == pytest.approx(0.5 * 0.01 * 210e9 / 2.6)
    assert rail.rotary_inertia() == pytest.approx(7850.0 * 2.1e7 / 210e9)


def test_footprints_are_cut_off_at_the_ends():
    track = Track(length=1.2)
    np.testing.assert_allclose(track.support_positions, [0.0, 0.6, 1.2])
    np.testing.assert_allclose(track.pad_footprints, [[0, 0.08], [0.52, 0.68], [1.12, 1.2]])
    assert Track(support=None, length=25.0, ends="pinned").support_positions.size == 0


def test_winkler_values_by_direction():
    assert WinklerFoundation(1e7, 2.0).values("Y") == (1e7, 2.0)
    assert WinklerFoundation(1e7, 2.0, 3e6, 1.0).values("Y") == (3e6, 1.0)


@pytest.mark.parametrize(
    ("make", "messages"),
    [
        (lambda: Track(length=36.1), ["whole number of support spacings"]),
        (lambda: Track(length=-1.0, ends="glued"), ["length = -1.0: must be above 0 m", '"glued"']),
        (lambda: Track(support=None, ends="free"), ["nothing holds a rail without support"]),
        (
            lambda: DiscreteSupports(pad_stiffness=-65e6, pad_damping=float("nan"), spacing=0.0),
            [
                "pad_stiffness = -65000000.0: must be above 0",
                "pad_damping = nan",
                "spacing = 0.0",
            ],
        ),
        (
            lambda: DiscreteSupports(pad_length=0.6),
            ["pad_length = 0.6: must be below the support spa"],
        ),
        (lambda: Ballast(stiffness=0.0, damping=-1.0), ["Ballast.stiffness", "Ballast.damping"]),
        (lambda: Slab(mass_per_length=0.0), ["Slab.mass_per_length = 0.0"]),
        (
            lambda: WinklerFoundation(-1.0, lateral_damping=-2.0),
            ["n.stiffness = -1", "lateral"],
        ),
        (lambda: Rail(youngs_modulus=0.0, poisson_ratio=0.7), ["youngs_modulus", "poisson_ratio"]),
    ],
)
def test_impossible_values_are_reported_all_at_once(make, messages):
    with pytest.raises(InputError) as caught:
        make()
    assert len(caught.value.problems) == len(messages)
    for message in messages:
        assert message in str(caught.value)

"""Decay of vibration along the rail: closed form, and rates measured at Niederwangen."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from contactstudy.solids.recipe import CellRecipe
from contactstudy.track.beam import BeamTrack
from contactstudy.track.model import (
    Ballast,
    DiscreteSupports,
    GivenRail,
    Track,
    WinklerFoundation,
)
from contactstudy.track.receptance import decay_rate
from contactstudy.track.solid import meshed_track

DATA = Path(__file__).parents[3] / "shared" / "data" / "sbb_track_decay.csv"
CENTRES = np.array(
    [100, 125, 160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000, 2500, 3150, 4000,
     5000], dtype=float
)  # fmt: skip
# B91 sleepers of concrete; the pads are called hard: their stiffness and damping are fitted, to the
# vertical rates from 160 to 1600 Hz and to the lateral ones up to 500 Hz
SUPPORTS = DiscreteSupports(
    pad_stiffness=650e6,
    pad_damping=35e3,
    lateral_pad_stiffness=50e6,
    lateral_pad_damping=6e3,
    sleeper_mass=150.0,
    layer=Ballast(),
)


@pytest.mark.parametrize("frequency", [400.0, 1000.0])
def test_decay_rate_of_the_infinite_rail_on_a_bed(frequency):
    """EI w'''' + kappa w = 0: A(x)/A(0) = (e^(-gx) + i e^(-igx))/(1 + i), g^4 = -kappa/EI."""
    bending, mass, bed, damping = 210e9 * 3038.3e-8, 60.2, 300e6, 3e4
    track = Track(GivenRail(EI=bending, mass=mass), WinklerFoundation(bed, damping), length=96.0)
    omega = 2.0 * math.pi * frequency
    kappa = bed + 1j * omega * damping - mass * omega**2
    # of the two decaying solutions one is the other's wave number times i
    first = (-kappa / bending) ** 0.25
    roots = [first * 1j**k for k in range(4)]
    p, q = (root for root in roots if root.real > 0.0)
    x = np.linspace(0.0, 40.0, 200001)
    # w''(0) of both cancels in w' = 0: a p + b q = 0
    response = np.exp(-p * x) - p / q * np.exp(-q * x)
    exact = 10.0 / math.log(10.0) / np.trapezoid(np.abs(response / response[0]) ** 2, x)
    (found,) = decay_rate(BeamTrack(track, elements_per_bay=8), 48.0, np.array([frequency]), 40.0)
    print(f"{frequency:g} Hz: exact {exact:.5f} dB/m, computed {found:.5f}")
    assert found == pytest.approx(exact, rel=2e-3)


def measured(direction):
    """Mean rate (18,) [dB/m] of all undamped sections; github mic-haf/SDWirkungNi, CC0."""
    if not DATA.exists():
        pytest.skip("the measured decay rates (sbb_track_decay.csv) are not shipped")
    with DATA.open() as file:
        rows = [
            row
            for row in csv.DictReader(file)
            if row["dir"] == direction and row["damp"] == "False" and row["tdr"]
        ]
    return np.array(
        [np.mean([float(r["tdr"]) for r in rows if float(r["freq"]) == f]) for f in CENTRES]
    )


def beam(theory, direction="Z", length=48.0):
    return BeamTrack(Track(length=length, support=SUPPORTS), theory, 8, direction=direction)


def rates(track, frequencies=CENTRES, length=48.0):
    """From the middle of a bay half way on nearly to the end."""
    return decay_rate(track, 0.5 * length + 0.3, frequencies, 0.45 * length)


def shown(name, values):
    print(f"{name:22}", *(f"{value:6.2f}" for value in values))


def off(found, known):
    """Root mean square of the logarithm of the ratio."""
    return float(np.sqrt(np.mean(np.log(found / known) ** 2)))


def test_measured_vertical_decay_rates_tell_the_beam_theories_apart():
    """Pinned-pinned resonance lies where Timoshenko has it; above 2.5 kHz neither is a rail."""
    known = measured("v")
    euler, timoshenko = rates(beam("euler")), rates(beam("timoshenko"))
    for name, values in (("Hz", CENTRES), ("measured", known), ("Euler", euler),
                         ("Timoshenko", timoshenko)):  # fmt: skip
        shown(name, values)
    fitted = (CENTRES >= 160.0) & (CENTRES <= 1600.0)
    errors = [off(one[fitted], known[fitted]) for one in (euler, timoshenko)]
    print("log of the ratio, rms: Euler {:.3f}, Timoshenko {:.3f}".format(*errors))
    assert errors[1] < 0.45
    k = list(CENTRES).index(1250.0)
    # a dip at 1000 Hz, a crest at 1250 Hz: the bay's resonance
    for one in (known, timoshenko):
        assert one[k] > 1.3 * one[k - 1] and one[k] > 1.3 * one[k + 1]
    assert euler[k] < euler[k + 1]  # Euler's lies a band higher
    # the measured rate rises again from 2.5 to 5 kHz, where section and foot deform
    assert known[-1] > 3.0 * known[-4]
    assert timoshenko[-1] < 1.5 * timoshenko[-4]
    assert known[-1] > 3.0 * timoshenko[-1]


def test_measured_lateral_decay_rates():
    """They fall to a fortieth from 100 Hz to 1250 Hz, but for the bay's resonance at 630 Hz."""
    known = measured("h")
    euler, timoshenko = rates(beam("euler", "Y")), rates(beam("timoshenko", "Y"))
    for name, values in (("measured", known), ("Euler", euler), ("Timoshenko", timoshenko)):
        shown(name, values)
    k = list(CENTRES).index(630.0)
    for one in (known, timoshenko):
        assert one[k] > 1.5 * one[k - 1] and one[k] > 1.5 * one[k + 1]
    assert known[-1] > 3.0 * timoshenko[-1]  # as vertically, the section deforms
    low = CENTRES <= 500.0
    assert off(timoshenko[low], known[low]) < 0.45


class LateralMotion:
    """A whole solid rail, driven and seen sideways at the middle of its section."""

    def __init__(self, solid):
        self.solid = solid
        self.mass, self.damping, self.stiffness = solid.mass, solid.damping, solid.stiffness
        self.dampers = None

    def rail_rows(self, x):
        stretches = [self.solid.stretch(one, 0.012) for one in x]
        return tuple(np.array(part) for part in zip(
            *((s.centre_dofs, s.centre_map[1]) for s in stretches), strict=True))  # fmt: skip

    def local_compliance(self, x):
        return np.zeros(len(x))


def solid_rail(symmetric):
    """Elements of 6 mm at the running surface; with 3 mm and more modes the rates move by 1 %."""
    recipe = CellRecipe(size=0.006, contact_half_width=0.012, symmetric=symmetric)
    return meshed_track(recipe, length=36.0, support=SUPPORTS)


def test_vertically_the_beam_stops_being_one_from_800_hz_on():
    solid, timoshenko = rates(solid_rail(True), length=36.0), rates(beam("timoshenko", length=36.0),
                                                                    length=36.0)  # fmt: skip
    for name, values in (("Hz", CENTRES), ("solid", solid), ("Timoshenko", timoshenko)):
        shown(name, values)
    assert off(timoshenko[CENTRES <= 250.0], solid[CENTRES <= 250.0]) < 0.04
    assert np.all(timoshenko[(CENTRES >= 800.0) & (CENTRES <= 2500.0)]
                  > 1.1 * solid[(CENTRES >= 800.0) & (CENTRES <= 2500.0)])  # fmt: skip
    # the section deforms: the rate rises again, as the measured one does
    fast = list(CENTRES).index(4000.0)
    assert solid[fast] > 1.5 * solid[fast - 2]
    assert timoshenko[fast] < 1.2 * timoshenko[fast - 2]


def test_laterally_the_solid_rail_rises_again_as_measured_and_the_beam_does_not():
    track = LateralMotion(solid_rail(False))
    solid = decay_rate(track, 18.3, CENTRES, 16.2, 0.1)
    timoshenko, known = rates(beam("timoshenko", "Y", 36.0), length=36.0), measured("h")
    for name, values in (("measured", known), ("solid", solid), ("Timoshenko", timoshenko)):
        shown(name, values)
    k = list(CENTRES).index(1250.0)
    for one in (known, solid):
        assert np.all(one[k + 1 : k + 6] > 2.0 * one[k])
    assert not np.any(timoshenko[k + 1 : k + 6] > 2.0 * timoshenko[k])
    # a rail on pads rolls, which the beam does not: it holds vibration back too well
    assert np.all(timoshenko[2:7] > 1.4 * solid[2:7])

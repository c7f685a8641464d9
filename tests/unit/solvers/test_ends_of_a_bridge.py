"""Irregularity and laws where wheels come onto the track of a bridge from ground, and leave it."""

import numpy as np
import pytest

from contactstudy.contact.filters import PatchMean
from contactstudy.contact.laws import HertzSpring
from contactstudy.contact.patch_laws import FollowingPatch, WinklerBedding
from contactstudy.exceptions import InputError
from contactstudy.irregularity import RailProfiles, paper_spectrum, sample_profile
from contactstudy.irregularity.profile import HarmonicProfile
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point import point_contact
from contactstudy.track.bridge import Bridge
from contactstudy.track.model import Track
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import AxleLoads, Train

BRIDGE = Bridge(spans=(12.0,), approach_before=12.0, approach_behind=12.0, entry_length=1.2)
LENGTH = BRIDGE.length
HALF, APPROACH, LOAD = 6e-3, 80e-6, 70e3
HERTZ = HertzSpring(LOAD / APPROACH**1.5)
LAWS = (
    FollowingPatch.on_ellipse(HERTZ, HALF, APPROACH),
    WinklerBedding(HALF, APPROACH, LOAD),
)


class OnTrackOnly(HarmonicProfile):
    """Waves of 3 m that are known on the track only, as a measured level is."""

    def __call__(self, x, derivative=0):
        assert np.all((x >= 0.0) & (x <= LENGTH))
        return super().__call__(x, derivative)


WAVES = OnTrackOnly(np.array([2e-4]), np.array([2 * np.pi / 3.0]), np.array([0.3]))


@pytest.fixture(scope="module")
def forces():
    """Contact force of two axles by law, over X of the first and of the second."""
    vehicle = AxleLoads(axle_loads=(2 * LOAD, 2 * LOAD), axle_distances=(2.4,)).vehicle()
    journey = Journey(speed=60.0, start=0.0, end=LENGTH + 2.4, time_step=2e-4, fade_in=3.0)
    track = StructureTrack(Track(structure=BRIDGE))
    found = {law: point_contact(track, vehicle, WAVES, journey, law=law) for law in (HERTZ, *LAWS)}
    return {law: (data.contact_force.values, data.position.values) for law, data in found.items()}


@pytest.mark.parametrize("law", LAWS)
def test_a_patch_law_over_long_waves_is_hertz_s(forces, law):
    # the mean over a patch of half length a is 1 - (k a)^2/6 of a wave: 3e-5 less at 3 m
    (force, _), (hertz, x) = forces[law], forces[HERTZ]
    on = (x > 0.0) & (x < LENGTH)
    assert np.ptp(hertz[on]) > 0.05 * LOAD
    np.testing.assert_allclose(force[on], hertz[on], atol=2e-3 * np.ptp(hertz[on]))


@pytest.mark.parametrize("backward", [False, True])
def test_there_is_no_irregularity_on_ground(backward):
    vehicle = AxleLoads(axle_loads=(2 * LOAD,)).vehicle()
    travel = "backward" if backward else "forward"
    journey = Journey(speed=60.0, start=0.0, end=LENGTH, time_step=1e-3, fade_in=3.0, travel=travel)
    passage = Passage(StructureTrack(Track(structure=BRIDGE)), vehicle, WAVES, journey)
    x = passage.positions
    share = np.clip(np.minimum(x, LENGTH - x) / 1.2, 0.0, 1.0)
    share = share**3 * (10 - 15 * share + 6 * share**2)
    faded = np.clip(passage.way / 3.0, 0.0, 1.0)
    faded = faded**3 * (10 - 15 * faded + 6 * faded**2)
    expected = share * faded * 2e-4 * np.cos(2 * np.pi / 3.0 * np.clip(x, 0, LENGTH) + 0.3)
    np.testing.assert_allclose(passage.roughness, expected, atol=1e-12)
    np.testing.assert_array_equal(passage.felt(), passage.roughness)
    felt = passage.felt(PatchMean.uniform(HALF))
    np.testing.assert_allclose(felt, expected, atol=1e-8)
    with pytest.raises(InputError, match="derivatives"):
        passage.faded(0)(np.zeros(1), 1)


def test_contacts_beside_the_rail_feel_no_patch():
    track = StructureTrack(Track(structure=Bridge(spans=(32.0,))), planar=False)
    vertical, lateral = (sample_profile(paper_spectrum(), seed) for seed in (1, 2))
    rough = RailProfiles(vertical, vertical, lateral, lateral)
    journey = Journey(speed=60.0, start=40.0, end=42.0, time_step=1e-3, fade_in=0.5)
    vehicle = Train(cars=("high_speed_trailer",), model="three_dimensional").vehicle()
    passage = Passage(track, vehicle, rough, journey)
    felt, _ = passage.seen(LAWS[1])
    assert passage.lateral.any() and not passage.lateral.all()
    same = np.all(felt == passage.roughness, axis=0)
    # others rest beside their centre somewhere, at least under three of four axles
    assert same[passage.lateral].all() and np.count_nonzero(same[~passage.lateral]) <= 2


@pytest.mark.parametrize("motion", [None, "planar", "space"])
def test_motion_of_a_bridge_is_stated_or_the_vehicle_s(motion):
    bridge = Bridge(motion=motion)
    assert bridge.planar_under(("Z",)) is (motion != "space")
    assert bridge.planar_under(("Z", "Y")) is (motion == "planar")

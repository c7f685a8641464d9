"""Loads, masses and vehicles on bridges against closed forms and published numbers."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse.linalg as spla

from contactstudy.contact.laws import HertzSpring, LinearSpring, MovingForce
from contactstudy.dynamics.energy import energy_balance
from contactstudy.irregularity import SmoothRail, paper_spectrum, sample_profile
from contactstudy.irregularity.rails import RailProfiles
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.observers import EachState
from contactstudy.solvers.passage import Passage
from contactstudy.solvers.point import point_contact
from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import GivenDeck
from contactstudy.track.model import Ballast, DiscreteSupports, GivenRail, Track
from contactstudy.track.pier import Pier
from contactstudy.track.space_beam import displacement
from contactstudy.track.structure import StructureTrack
from contactstudy.vehicle import AxleLoads, Train, Vehicle, bare_wheel

STIFF_LAYER = Ballast(stiffness=1e10, damping=0.0, lateral_stiffness=1e10, lateral_damping=0.0)
STIFF = DiscreteSupports(
    pad_stiffness=1e10, pad_damping=0.0, pad_length=0.0, sleeper_mass=0.0, layer=STIFF_LAYER
)


def beam_bridge(EI, mass, spans, rail_EI=1e1, spacing=0.6, **bridge):
    """Spans of a beam below a track without mass, hard on the deck; undamped.

    A stiff rail would hold the decks' ends against turning.
    """
    deck = GivenDeck(
        youngs_modulus=1e10,
        area=1.0,
        second_moment=EI / 1e10,
        mass_per_length=mass,
        damping_ratio=0.0,
    )
    given = {"approach_before": 12.0, "approach_behind": 12.0, "bearing_stiffness": 1e14} | bridge
    rail = GivenRail(EI=rail_EI, mass=1e-3)
    return StructureTrack(
        Track(
            rail=rail,
            support=replace(STIFF, spacing=spacing),
            structure=Bridge(spans=spans, deck=deck, **given),
        )
    )


def deck_at(structure, x, deck=0):
    row = structure.rows_of(
        structure.nodes.decks[deck], np.array([x]), displacement("Z", (0, 0, 0))
    )
    return lambda state: float(row[1][0] @ state.u[row[0][0]])


def run(structure, vehicle, speed, law, dt, at=None, profile=None, **journey):
    seen = []
    length = structure.track.length
    journey = {"start": 0.0, "end": length - float(np.min(vehicle.wheel_offsets))} | journey
    watch = (EachState(lambda state: seen.append(at(state))),) if at else ()
    data = point_contact(
        structure,
        vehicle,
        profile or SmoothRail(),
        Journey(speed=speed, time_step=dt, fade_in=0.0, **journey),
        law=law,
        observers=watch,
    )
    return data, np.array(seen)


def test_moving_force_on_a_simply_supported_beam():
    """L = 25 m, EI = 2.1e7 N m^2, 78.5 kg/m, 1 kN at 10 m/s: 18.1595 mm at 1.3268 s (Olsson)."""
    structure = beam_bridge(2.1e7, 78.5, (25.0,), spacing=0.15)
    before = structure.bridge.approach_before
    data, deflection = run(
        structure,
        bare_wheel(1.0, 1e3),
        10.0,
        MovingForce(),
        1e-3,
        deck_at(structure, before + 12.5),
    )
    assert (data.attrs["rail"], data.attrs["elements_per_bay"]) == ("euler", 4)
    time = data.time.values - before / 10.0
    on_bridge = (time > 0.0) & (time < 2.5)
    deepest = np.argmin(np.where(on_bridge, deflection, 0.0))
    assert -deflection[deepest] == pytest.approx(18.1595e-3, rel=5e-4)
    assert time[deepest] == pytest.approx(1.3268, abs=5e-3)


@pytest.mark.parametrize(("alpha", "amplification"), [(0.1, 1.0965), (0.5, 1.7055), (0.75, 1.7016)])
def test_amplification_under_a_moving_force(alpha, amplification):
    """Fryba 1972: largest midspan deflection over P L^3/48EI while the force is on the beam."""
    L, EI, m = 25.0, 8.3e9, 2303.0
    structure = beam_bridge(EI, m, (L,), rail_EI=1e4)
    before, speed = structure.bridge.approach_before, alpha * math.pi / L * math.sqrt(EI / m)
    data, deflection = run(
        structure,
        bare_wheel(1.0, 1e5),
        speed,
        MovingForce(),
        0.2 / speed,
        deck_at(structure, before + L / 2),
    )
    x = data.position.values
    on_bridge = (x >= before) & (x <= before + L)
    static = 1e5 * L**3 / (48 * EI)
    # the 0.4 % are what a midspan force lacks that the first mode alone has not: 96/pi^4
    assert -deflection[on_bridge].min() / static == pytest.approx(amplification, rel=1.5e-2)


def sprung_mass():
    k = 1595e3
    stiffness = k * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return Vehicle(
        mass=np.diag([1.0, 5750.0]),
        damping=np.zeros((2, 2)),
        stiffness=stiffness,
        wheel_dofs=np.array([0]),
        wheel_offsets=np.zeros(1),
        static_loads=np.array([5751.0 * 9.81]),
        dof_names=("wheel", "body"),
    )


def test_sprung_mass_on_a_simply_supported_beam():
    """Parameters of Yang and Yau, J. Struct. Eng. 123 (1997) 1512; converged modal solution."""
    structure = beam_bridge(2.87e9 * 2.90, 2303.0, (25.0,), rail_EI=2e4, spacing=0.1)
    before = structure.bridge.approach_before
    data, deflection = run(
        structure,
        sprung_mass(),
        100 / 3.6,
        LinearSpring(1e11),
        2e-4,
        deck_at(structure, before + 12.5),
    )
    x = data.position.values
    on_bridge = (x >= before) & (x <= before + 25.0)
    deepest = np.argmin(np.where(on_bridge, deflection, 0.0))
    assert -deflection[deepest] == pytest.approx(2.40732e-3, rel=2e-3)
    assert data.time.values[deepest] - before * 3.6 / 100 == pytest.approx(0.3710, abs=4e-3)


@pytest.mark.parametrize("n", [2, 3])
def test_a_load_at_a_cancellation_speed_leaves_a_beam_at_rest(n):
    """Free vibration of the first mode after one load is in proportion to |cos(omega L/2v)|.

    It vanishes at v = 2 f1 L/(2n - 1), and is largest in between.
    """
    L, EI, m = 25.0, 8.3e9, 2303.0
    structure = beam_bridge(EI, m, (L,), rail_EI=1e4, approach_behind=80.0)
    before, f1 = structure.bridge.approach_before, math.pi / (2 * L**2) * math.sqrt(EI / m)
    left = {}
    for name, count in (("cancelled", n), ("between", n - 0.5)):
        speed = 2 * f1 * L / (2 * count - 1)
        data, deflection = run(
            structure,
            bare_wheel(1.0, 1e5),
            speed,
            MovingForce(),
            0.1 / speed,
            deck_at(structure, before + L / 2),
        )
        left[name] = np.abs(deflection[data.position.values > before + L + 1.0]).max()
    assert left["cancelled"] < 0.06 * left["between"]


def test_loads_at_their_passing_frequency_are_in_resonance():
    """v = f1 d: the free vibrations of all loads add up, midway between two such speeds not."""
    L, EI, m, d = 20.0, 8.3e9, 2303.0, 28.0
    structure = beam_bridge(EI, m, (L,), rail_EI=1e4)
    f1 = math.pi / (2 * L**2) * math.sqrt(EI / m)
    largest = {}
    middle = deck_at(structure, structure.bridge.approach_before + L / 2)
    for count in (1, 6):
        loads = AxleLoads(axle_loads=(1e5,) * count, axle_distances=(d,) * (count - 1)).vehicle(2)
        for n in (1.0, 1.5):
            speed = f1 * d / n
            _, deflection = run(structure, loads, speed, MovingForce(), 0.3 / speed, middle)
            largest[count, n] = np.abs(deflection).max()
    assert largest[6, 1.0] > 3.0 * largest[1, 1.0]
    assert largest[6, 1.5] < 1.6 * largest[1, 1.5]


def small_bridge(planar, **bridge):
    given = {
        "spans": (9.0, 7.0),
        "approach_before": 12.0,
        "approach_behind": 10.0,
        "piers": Pier(),
    } | bridge
    return StructureTrack(Track(structure=Bridge(**given)), planar=planar)


def one_car(planar):
    if planar:
        return Train(cars=("s300",)).vehicle(2)
    return Train(cars=("high_speed_trailer",), model="three_dimensional").vehicle()


@pytest.mark.parametrize("planar", [True, False])
def test_weight_is_balanced_over_a_whole_passage(planar):
    """Impulse of the wheels on the rails = weight x time + change of the car's momentum."""
    structure, car = small_bridge(planar), one_car(planar)
    momentum = []
    up = np.array([" z" in name for name in car.dof_names])

    def heave(state):
        v = state.v[structure.n_dofs :]
        return float(np.where(up, car.mass @ v, 0.0).sum())

    data, momentum = run(
        structure,
        car,
        60.0,
        LinearSpring(1e9),
        5e-4,
        heave,
        sample_profile(paper_spectrum(), seed=2),
    )
    force, weight = data.contact_force.values, float(np.sum(car.static_loads))
    impulse = np.cumsum(0.5 * (force[:, 1:] + force[:, :-1]).sum(axis=0)) * 5e-4
    time = data.time.values[1:]
    np.testing.assert_allclose(
        impulse, weight * time + momentum[1:] - momentum[0], rtol=0.0, atol=1e-6 * weight * time[-1]
    )
    assert np.abs(force[:, 0] / np.asarray(data.attrs["static_load"]) - 1.0).max() < 1e-6
    assert force.std() > 1e3


@pytest.mark.parametrize("deck_damping", ["rayleigh", "modal"])
@pytest.mark.parametrize("planar", [True, False])
def test_energy_is_balanced_over_a_whole_passage(planar, deck_damping):
    structure, car = small_bridge(planar, deck_damping=deck_damping), one_car(planar)
    states = []
    run(
        structure,
        car,
        60.0,
        LinearSpring(1e9),
        1e-3,
        states.append,
        sample_profile(paper_spectrum(), seed=2),
    )
    system = Passage(structure, car, SmoothRail(), Journey()).system
    energy = energy_balance(system, states)
    assert abs(energy.residual) < 1e-9 * max(abs(energy.work), energy.dissipated)
    assert energy.dissipated > 1.0


@pytest.mark.parametrize("planar", [True, False])
@pytest.mark.parametrize("law", [LinearSpring(1e9), HertzSpring(9.2e10)], ids=["linear", "hertz"])
def test_mirrored_travel_on_the_mirrored_track_gives_the_mirrored_results(planar, law):
    """A train to -X is that to +X on the mirrored bridge and level; its left is then the right."""
    there, back = sample_profile(paper_spectrum(), seed=3), sample_profile(paper_spectrum(), seed=4)
    one = small_bridge(planar, track_offset=2.0)
    other = small_bridge(
        planar,
        spans=(7.0, 9.0),
        approach_before=10.0,
        approach_behind=12.0,
        track_offset=-2.0,
        fixed_support="last",
    )
    length = one.track.length

    def level(profile):
        return lambda x, derivative=0: (
            (-1.0) ** derivative * profile(length - np.asarray(x), derivative)
        )

    class Mirrored:
        domain, repeat_length = (-np.inf, np.inf), np.inf

        def __init__(self, profile):
            self._call = level(profile)

        def __call__(self, x, derivative=0):
            return self._call(x, derivative)

    forward, _ = run(
        one,
        one_car(planar),
        60.0,
        law,
        5e-4,
        profile=RailProfiles(there, back, lateral_right=back, lateral_left=there),
    )
    # turned by half a turn about Z: right and left change, and lateral displacements their sign
    backward, _ = run(
        other,
        one_car(planar),
        60.0,
        law,
        5e-4,
        travel="backward",
        profile=RailProfiles(
            Mirrored(back),
            Mirrored(there),
            lateral_right=Negative(Mirrored(there)),
            lateral_left=Negative(Mirrored(back)),
        ),
    )
    np.testing.assert_allclose(backward.position, length - forward.position, atol=1e-9)
    np.testing.assert_allclose(backward.contact_force, forward.contact_force, rtol=1e-6)
    if not planar:
        scale = np.abs(forward.lateral_force).max()
        np.testing.assert_allclose(
            -backward.lateral_force, forward.lateral_force, atol=1e-6 * scale
        )
        assert scale > 100.0


class Negative:
    domain, repeat_length = (-np.inf, np.inf), np.inf

    def __init__(self, profile):
        self._profile = profile

    def __call__(self, x, derivative=0):
        return -self._profile(x, derivative)


def test_the_left_rail_is_the_left_one():
    """A bump on the left rail only is felt by the left wheels, which stand at +Y."""
    structure, car = small_bridge(False), one_car(False)
    bump = sample_profile(paper_spectrum(), seed=3)
    data, _ = run(
        structure, car, 60.0, LinearSpring(1e9), 1e-3, profile=RailProfiles(SmoothRail(), bump)
    )
    on_left = np.array(car.contact_rails)[np.array(car.contact_directions) == "Z"] == 1
    assert np.all(np.ptp(data.irregularity.values, axis=1)[on_left] > 1e-5)
    assert np.all(data.irregularity.values[~on_left] == 0.0)


@pytest.mark.parametrize("planar", [True, False])
def test_the_static_deflection_beside_a_run_is_that_of_its_loads_at_rest(planar):
    structure, car = small_bridge(planar), one_car(planar)
    data, _ = run(structure, car, 60.0, MovingForce(), 1e-3, stations=(16.5, 24.0), end=44.0)
    loads = [load for load in car.static_loads if load > 0.0]
    rails = [r for r, d in zip(car.contact_rails, car.contact_directions, strict=True) if d == "Z"]
    for step in (300, 550, 700):
        force = np.zeros(structure.n_dofs)
        for load, rail, x in zip(loads, rails, data.position.values[:, step], strict=True):
            dofs, weights = structure.contact_rows(np.array([x]), int(rail), "Z")
            np.add.at(force, dofs[0], -load * weights[0])
        u = spla.spsolve(structure.stiffness.tocsc(), force)
        for k, x in enumerate((16.5, 24.0)):
            deck = structure.deck_at(x)
            row = structure.rows_of(
                structure.nodes.decks[deck], np.array([x]), displacement("Z", (0, 0, 0))
            )
            still = row[1][0] @ u[row[0][0]]
            assert data.deck_static.values[k, step] == pytest.approx(still, rel=1e-6, abs=1e-12)
    assert np.abs(data.deck_static).max() > 1e-5


def test_two_wheels_in_one_element_add_up():
    structure = small_bridge(True)
    one, two = (
        bare_wheel(900.0, 60e3),
        AxleLoads(axle_loads=(60e3,) * 2, axle_distances=(0.05,), wheel_mass=450.0).vehicle(1),
    )
    at = deck_at(structure, 16.5)
    _, single = run(structure, one, 60.0, MovingForce(), 1e-3, at, end=38.0)
    _, double = run(structure, two, 60.0, MovingForce(), 1e-3, at, end=38.0)
    # two halves 50 mm apart are one load in their middle
    np.testing.assert_allclose(double, single, atol=0.02 * np.abs(single).max())


def test_a_bridge_hardly_reflects_at_the_ends_of_its_track():
    """The same passage with approaches twice as long: the deck feels nothing of their ends."""
    found = []
    for approach in (25.0, 50.0):
        structure = small_bridge(True, approach_before=approach, approach_behind=approach)
        _, deflection = run(
            structure,
            one_car(True),
            60.0,
            LinearSpring(1e9),
            5e-4,
            deck_at(structure, approach + 4.5),
            sample_profile_at(approach),
            start=approach - 15.0,
            end=approach + 16.0 + 14.0,
        )
        found.append(deflection)
    assert np.abs(found[0] - found[1]).max() < 2e-3 * np.abs(found[1]).max()


def sample_profile_at(shift):
    """The same level relative to the bridge."""

    class Shifted:
        domain, repeat_length = (-np.inf, np.inf), np.inf

        def __call__(self, x, derivative=0):
            return sample_profile(paper_spectrum(), seed=5)(np.asarray(x) - shift, derivative)

    return Shifted()

"""Accelerations of car bodies against the frequency response of the car's own matrices."""

import numpy as np
import pytest

from contactstudy.contact.laws import LinearSpring
from contactstudy.irregularity import HarmonicProfile, SmoothRail
from contactstudy.solvers.car_bodies import CarBodies, bodies
from contactstudy.solvers.journey import Journey
from contactstudy.solvers.point import point_contact
from contactstudy.study.kinds.passage.comfort import comfort_of
from contactstudy.track.model import GivenRail, Track, WinklerFoundation
from contactstudy.vehicle import Train, wheel_column

SPEED, WAVELENGTH, AMPLITUDE = 20.0, 12.0, 1e-3
STIFF = Track(GivenRail(EI=6e6, mass=60.0), WinklerFoundation(1e11, 1e7), length=150.0)


def run_over(profile, cars=("s300",), end=145.0):
    journey = Journey(50.0, end, SPEED, 1e-3, fade_in=5.0)
    return point_contact(
        STIFF, Train(cars=cars).vehicle(), profile, journey, law=LinearSpring(1e9),
        observers=(CarBodies(),),
    )  # fmt: skip


def test_a_wave_moves_the_body_as_its_frequency_response_says():
    data = run_over(HarmonicProfile.wave(AMPLITUDE, WAVELENGTH))
    assert data.car_acceleration.dims == ("car", "time") and list(data.car) == [1]
    vehicle, omega = Train(cars=("s300",)).vehicle(), 2 * np.pi * SPEED / WAVELENGTH
    # wheels held to the wave: r_j = A exp(i w (t + x_j/v)); the bodies follow
    free = [k for k in range(vehicle.n_dofs) if k not in vehicle.wheel_dofs]
    dynamic = -(omega**2) * vehicle.mass + 1j * omega * vehicle.damping + vehicle.stiffness
    wheels = AMPLITUDE * np.exp(1j * omega * vehicle.wheel_offsets / SPEED)
    right = -dynamic[np.ix_(free, vehicle.wheel_dofs)] @ wheels
    bodies_move = np.linalg.solve(dynamic[np.ix_(free, free)], right)
    expected = omega**2 * abs(bodies_move[free.index(vehicle.dof_names.index("car z 1"))])
    last = data.car_acceleration.isel(car=0).values[-2 * round(WAVELENGTH / SPEED / 1e-3) :]
    found = np.abs(2 * np.mean(last * np.exp(-1j * omega * np.arange(len(last)) * 1e-3)))
    assert found == pytest.approx(expected, rel=5e-3)


def test_bodies_of_trains_by_their_numbers():
    planar = bodies(Train(cars=("2 x s300",)).vehicle())
    assert list(planar) == ["z"] and len(planar["z"]) == 2
    space = bodies(Train(cars=("3 x high_speed_motor",), model="three_dimensional").vehicle())
    assert list(space) == ["z", "y"] and len(space["y"]) == 3
    assert bodies(wheel_column()) == {}


def test_comfort_of_the_cars_and_of_too_short_a_run():
    rough = HarmonicProfile(
        np.array([2e-3, 1e-3]), 2 * np.pi / np.array([25.0, 9.0]), np.array([0.0, 1.0])
    )
    data = run_over(rough, ("2 x s300",))
    found = comfort_of({"one": data, "none": data.drop_vars("car_acceleration")})
    still = data.assign_attrs(law="moving force")  # which no rail moves
    assert comfort_of({"one": still}) == {}
    assert list(found) == ["one"] and len(found["one"]["cars"]) == 2
    for k, car in enumerate(found["one"]["cars"]):
        assert 0.5 < car["sperling"]["Z"] < 4.0 and set(car["sperling"]) == {"Z"}
        assert car["n_mv"] > 0.0
        assert car["largest"] == pytest.approx(
            float(np.abs(data.car_acceleration[k, 250:]).max()), rel=1e-9
        )
    smooth = comfort_of({"one": run_over(SmoothRail(), end=60.0)})["one"]["cars"][0]
    assert smooth["sperling"]["Z"] is None and smooth["n_mv"] is None

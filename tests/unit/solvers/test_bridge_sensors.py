"""Histories of rails, decks, piers and supports against closed forms and mirror symmetry."""

import numpy as np
import pytest

from contactstudy.solvers.bridge_sensors import VARIABLES, motion_name
from contactstudy.study.kinds.passage.execution import execute_run
from contactstudy.study.kinds.passage.reading import parse_study
from contactstudy.track.pier import Pier
from contactstudy.track.structure_springs import FOOT_DEPTH

TRACK = {
    "structure": "bridge", "spans": ["2 x 9 m"], "approach_before": 12.0, "approach_behind": 12.0,
    "piers": "column",
}  # fmt: skip
AXLES = {"type": "axle_loads", "axle_loads": [200e3, 150e3], "axle_distances": [2.5]}


def run(track=None, vehicle=None, journey=None, **keys):
    one = {"solver": "point", "law": "moving_force", **keys}
    made = parse_study(
        "sensors",
        {
            "track": TRACK | (track or {}),
            "vehicle": vehicle or AXLES,
            "journey": {
                "speed": 20.0, "time_step": 4e-3, "stations": [16.3, 25.1, 4.0], "fade_in": 0.1,
                **(journey or {}),
            },
            "irregularity": {"spectrum": "smooth"},
            "runs": {"one": one},
        },
    )  # fmt: skip
    return execute_run(made, "one")


@pytest.fixture(scope="module")
def in_space():
    return run({"motion": "space"})


def test_every_history_is_described_and_there(in_space):
    recorded = {str(name) for name in in_space.data_vars}
    assert set(VARIABLES) <= recorded
    assert all(in_space[name].attrs["units"] == unit for name, (unit, _) in VARIABLES.items())
    planar = run()
    assert {"pier_acceleration", "station_strain", "deck_velocity"} <= set(planar.data_vars)
    assert not {name for name in planar.data_vars if "lateral" in name or "longitud" in name}


def test_velocities_and_accelerations_are_those_of_the_displacements():
    """Average acceleration is the trapezoidal rule: x_2 - x_1 = h (v_1 + v_2)/2."""
    in_space = run({"motion": "space"}, integrator="average_acceleration")
    h = in_space.attrs["dt"]
    for body in ("station", "station_left", "deck", "pier"):
        for axis in "XYZ":
            u, v, a = (in_space[motion_name(body, axis, k)].values for k in range(3))
            there = np.isfinite(u[:, 0])
            assert there.any() and np.abs(v[there]).max() > 0.0
            for x, rate in ((u[there], v[there]), (v[there], a[there])):
                mean = 0.5 * h * (rate[:, 1:] + rate[:, :-1])
                np.testing.assert_allclose(np.diff(x), mean, atol=1e-9 * np.abs(mean).max())


def test_stations_and_supports_without_a_deck_or_a_pier(in_space):
    assert np.isnan(in_space.deck_lateral.sel(station=4.0)).all()
    assert np.isfinite(in_space.station_lateral).all()
    np.testing.assert_array_equal(
        np.isfinite(in_space.pier_displacement[:, 0]), [False, True, False]
    )


def test_rails_do_not_ring_under_moving_forces():
    """Free of ringing, the acceleration of a rail does not depend on the time step."""
    found = {}
    for integrator in ("", "average_acceleration"):
        keys = {"integrator": integrator} if integrator else {}
        rates = [
            float(np.abs(run(journey={"time_step": step}, **keys).station_acceleration[0]).max())
            for step in (2e-3, 1e-3)
        ]
        found[integrator] = rates[1] / rates[0]
    assert found[""] == pytest.approx(1.0, abs=0.05)
    assert abs(found["average_acceleration"] - 1.0) > 0.2


def test_a_pier_gives_way_as_a_column_on_springs():
    """Slowly, u_z = -F_z (h/EA + 1/k_z) and u_x = F_x (h^3/3EI + h^2/k_r + 1/k_x)."""
    data = run({"motion": "space"}, journey={"speed": 2.0, "time_step": 0.05})
    pier = Pier()
    h, E = pier.height, pier.youngs_modulus
    down = h / (E * pier.area) + 1 / pier.vertical_stiffness
    along = h**3 / (3 * E * pier.second_moment)
    along += h**2 / pier.rocking_stiffness + 1 / pier.horizontal_stiffness
    middle = data.isel(support=1)
    for u, force, softness in (
        (middle.pier_displacement, -middle.bearing_force, down),
        (middle.pier_longitudinal, middle.bearing_longitudinal_force, along),
    ):
        assert np.abs(force).max() > 1e3
        np.testing.assert_allclose(u, softness * force, atol=0.02 * softness * np.abs(force).max())


def test_a_mirrored_track_gives_mirrored_histories(in_space):
    other = run({"motion": "space", "track_offset": -2.5})
    for name in VARIABLES:
        mirrored = name.replace("station_", "station_left_")
        if "left" in name:
            mirrored = name.replace("station_left_", "station_")
        sign = -1.0 if "lateral" in name or "roll" in name else 1.0
        expected = in_space[mirrored].values
        size = np.nanmax(np.abs(expected))
        np.testing.assert_allclose(sign * other[name], expected, atol=1e-6 * size, err_msg=name)


def test_mirrored_travel_turns_what_is_along_the_track():
    # the track is as long before the bridge as behind it, and held at its other end
    keys = {"motion": "space"}
    there = run({**keys, "fixed_support": "first"}, journey={"stations": [16.5]})
    back = run({**keys, "fixed_support": "last"}, journey={"stations": [25.5]}, travel="backward")
    for name, sign in {"deck_longitudinal": -1, "deck_strain": 1, "station_strain": 1,
                       "deck_lateral": 1, "pier_longitudinal": -1, "bearing_force": 1,
                       "bearing_longitudinal_force": -1}.items():  # fmt: skip
        a, b = there[name].values, sign * back[name].values[::-1]
        np.testing.assert_allclose(a, b, atol=1e-6 * np.nanmax(np.abs(a)), err_msg=name)


def test_strain_of_a_rail_is_that_of_a_beam_on_a_foundation():
    """Winkler: M(x) = P/(4 b) exp(-b x) (cos bx - sin bx), b^4 = k/(4 EI), under a slow wheel."""
    pad, spacing, load = 4e6, 0.3, 100e3
    data = run(
        {
            "spacing": spacing, "pad_stiffness": pad, "pad_length": 0.0,
            "ballast_stiffness": 1e12, "sleeper_mass": 1.0, "bearing_stiffness": 1e14,
            "spans": [9.0], "approach_before": 20.0, "piers": "rigid",
        },
        {"type": "axle_loads", "axle_loads": [2 * load]},
        {"speed": 2.0, "time_step": 0.02, "stations": [10.5]},
    )  # fmt: skip
    EI = 210e9 * 30.38e-6
    b = (pad / spacing / (4 * EI)) ** 0.25
    x = np.abs(data.position.values[0] - 10.5)
    moment = load / (4 * b) * np.exp(-b * x) * (np.cos(b * x) - np.sin(b * x))
    strain = data.station_strain.values[0]
    far = x > spacing  # nearer, the cusp under the wheel is rounded within an element
    expected = FOOT_DEPTH * moment / EI
    np.testing.assert_allclose(strain[far], expected[far], atol=0.03 * expected.max())
    assert strain.max() == pytest.approx(expected.max(), rel=0.04)

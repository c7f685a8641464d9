"""Trains of cars and of axle loads."""

from pathlib import Path

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.vehicle import AxleLoads, Bogie, FreightWagons, HighSpeedLoadModel, Train
from contactstudy.vehicle.suspended import car_vehicle
from contactstudy.vehicle.vehicle_file import read_car

G = 9.81


def test_the_default_train_has_the_lengths_of_700t():
    train = Train()
    made = train.vehicle()
    assert train.length == pytest.approx(304.0)
    assert made.n_wheels == 48 and made.n_dofs == 120
    # bogies stand every 25 m throughout: the longer end cars have the rest as their noses
    expected = [-25.0 * car + x for car in range(12) for x in (0.0, -2.5, -17.5, -20.0)]
    np.testing.assert_allclose(made.wheel_offsets, expected, atol=1e-9)
    assert made.static_loads.sum() == pytest.approx(12 * 4 * 13.7375e3 * G / 2)


def test_a_train_is_its_cars_behind_each_other():
    train = Train(cars=("ice3", "2 x manchester"), gaps=(0.5, 1.0))
    made = train.vehicle()
    blocks = [car_vehicle(read_car(name)) for name in ("ice3", "manchester", "manchester")]
    np.testing.assert_array_equal(made.stiffness[:10, :10], blocks[0].stiffness)
    np.testing.assert_array_equal(made.stiffness[20:, 20:], blocks[2].stiffness)
    assert not made.stiffness[:10, 10:].any()
    # middles of the cars: half lengths and gaps between them
    middles = np.array([0.0, -(24.775 / 2 + 0.5 + 12.5), -(24.775 / 2 + 0.5 + 25.0 + 1.0 + 12.5)])
    expected = [m + s * (p / 2) + e * w / 2
                for m, p, w in zip(middles, (17.375, 19, 19), (2.5, 2.56, 2.56), strict=True)
                for s in (1, -1) for e in (1, -1)]  # fmt: skip
    np.testing.assert_allclose(made.wheel_offsets, np.array(expected) - expected[0], atol=1e-9)
    assert train.length == pytest.approx(24.775 + 0.5 + 25 + 1 + 25)


def test_a_reversed_train_runs_the_other_way_round():
    forward = Train(cars=("ice3_end", "manchester"), gaps=(0.7,)).vehicle()
    back = Train(cars=("manchester reversed", "ice3_end reversed"), gaps=(0.7,)).vehicle()
    x, mirrored = forward.wheel_offsets, back.wheel_offsets
    np.testing.assert_allclose(np.sort(-x), np.sort(mirrored - mirrored.min()), atol=1e-9)
    np.testing.assert_allclose(forward.static_loads[::-1], back.static_loads)


def test_a_train_in_three_dimensions_runs_on_two_rails():
    made = Train(cars=("2 x high_speed_trailer",), model="three_dimensional").vehicle()
    assert made.n_contacts == 32 and made.n_wheels == 16 and set(made.contact_rails) == {0, 1}
    assert made.static_loads.sum() == pytest.approx(2 * 58.4e3 * G)
    planar = Train(cars=("2 x high_speed_trailer",)).vehicle(rails=2)
    assert planar.n_contacts == 16
    assert planar.static_loads.sum() == pytest.approx(2 * 58.4e3 * G)


def test_impossible_trains():
    with pytest.raises(InputError) as caught:
        Train(cars=("s300", "ice4", "none.toml"))
    text = "\n".join(caught.value.problems)
    assert "did you mean 'ice3'" in text and "none.toml: there is no such file" in text
    with pytest.raises(InputError, match=r"cars 1 and 2 overlap by 0\.5 m"):
        Train(cars=("3 x s300",), gaps=(-0.5, 0.0))
    with pytest.raises(InputError, match="has 3 values; must have 1, or 2 for 3 cars"):
        Train(cars=("3 x s300",), gaps=(0.0, 0.0, 0.0))
    with pytest.raises(InputError, match="car s300 lacks lateral data: car_roll_inertia"):
        Train(cars=("high_speed_motor", "s300"), model="three_dimensional")
    with pytest.raises(InputError, match="must name at least one car"):
        Train(cars=())
    with pytest.raises(InputError, match='"0 x s300": must be 1 to 999 of a car'):
        Train(cars=("0 x s300",))
    with pytest.raises(InputError, match="is unknown"):
        Bogie(car="express")


def test_trains_too_long_for_dense_matrices_are_refused_before_any_is_made():
    for given in (
        lambda: Train(cars=("999 x s300",)),
        lambda: Train(cars=("200 x s300", "51 x s300")),
        lambda: AxleLoads(axle_loads=(1e5,) * 1001, axle_distances=(3.0,) * 1000),
        lambda: FreightWagons(wagons=251),
    ):
        with pytest.raises(InputError, match=r"at most (250|1000)"):
            given()
    assert FreightWagons(wagons=250).vehicle(2).n_dofs == 2000


@pytest.mark.parametrize(
    "name, coaches, length, spacing, force",
    [("A1", 18, 18, 2.0, 170), ("A2", 17, 19, 3.5, 200), ("A3", 16, 20, 2.0, 180),
     ("A4", 15, 21, 3.0, 190), ("A5", 14, 22, 2.0, 170), ("A6", 13, 23, 2.0, 180),
     ("A7", 13, 24, 2.0, 190), ("A8", 12, 25, 2.5, 190), ("A9", 11, 26, 2.0, 210),
     ("A10", 11, 27, 2.0, 210)],
)  # fmt: skip
def test_hslm_trains_of_en_1991_2(name, coaches, length, spacing, force):
    x, loads = (np.array(part) for part in HighSpeedLoadModel(hslm=name).axles)
    # two power cars of 4, two end coaches of 3, N coaches of 2 axles
    assert len(x) == 2 * 4 + 2 * 3 + 2 * coaches
    assert set(loads) == {force * 1e3}
    np.testing.assert_allclose(x[:6], [0, 3, 14, 17, 20.525, 20.525 + spacing])
    np.testing.assert_allclose(x + x[::-1], x[-1])  # the same from both ends
    # within the coaches the bogies repeat with the coach length
    shared = x[6:-6].reshape(-1, 2)
    assert len(shared) == coaches + 1
    np.testing.assert_allclose(np.diff(shared, axis=1), spacing)
    np.testing.assert_allclose(np.diff(shared.mean(axis=1)), length)
    # an end coach reaches from the coupling, 3.525 / 2 before its first axle, to a shared bogie
    assert shared[0].mean() - (17 + 3.525 / 2) == pytest.approx(length)


def test_axle_loads_on_one_rail_and_on_two():
    table = AxleLoads(axle_loads=("9.5 t", 93195.0, "186.39 kN"), axle_distances=("2.5 m", 14.0))
    one, two = table.vehicle(), table.vehicle(rails=2)
    np.testing.assert_allclose(one.wheel_offsets, [0.0, -2.5, -16.5])
    np.testing.assert_allclose(one.static_loads, np.array([93195.0, 93195.0, 186390.0]) / 2)
    np.testing.assert_allclose(two.static_loads, np.repeat(one.static_loads, 2))
    np.testing.assert_array_equal(two.contact_rails, [0, 1] * 3)
    assert table.static_load == pytest.approx(93195.0 / 2)
    with pytest.raises(InputError, match="has 1 values; must have 2 for 3 axles"):
        AxleLoads(axle_loads=(1e5, 1e5, 1e5), axle_distances=(2.0,))
    with pytest.raises(InputError, match="has the wrong unit 'm'; allowed: N"):
        AxleLoads(axle_loads=("9.5 m",))


def test_freight_wagons_carry_eight_tonnes_a_metre():
    behind, loads = FreightWagons(wagons=20).axles
    assert sum(loads) / G / (20 * 11.25) == pytest.approx(8000.0)
    assert behind[4] - behind[3] == pytest.approx(2 * 1.5)


def test_the_documented_car_is_one(tmp_path):
    page = (Path(__file__).parents[3] / "docs" / "studies.md").read_text("utf-8")
    file = tmp_path / "mine.toml"
    file.write_text(page.split("# my_car.toml\n")[1].split("```")[0], "utf-8")
    assert read_car(str(file)).static_axle_load == pytest.approx(14e3 * G)

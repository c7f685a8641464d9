import dataclasses

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.vehicle import Vehicle, bare_wheel, train, wheel_column


def test_wheel_column_defaults_are_the_s300_per_wheel():
    vehicle = wheel_column()
    assert vehicle.static_loads[0] == pytest.approx(67.4e3, rel=1e-3)
    np.testing.assert_array_equal(np.diag(vehicle.mass), [890.0, 760.0, 5219.0])
    np.testing.assert_allclose(vehicle.stiffness.sum(axis=1), 0.0)
    np.testing.assert_allclose(vehicle.damping.sum(axis=1), 0.0)
    # free of the rail it has one rigid motion and two vibrations
    assert np.linalg.matrix_rank(vehicle.stiffness) == 2


def test_train_puts_vehicles_behind_each_other():
    both = train([wheel_column(), bare_wheel(900.0, 5e4)], [0.0, -2.5])
    assert both.n_dofs == 4 and both.n_wheels == 2
    np.testing.assert_array_equal(both.wheel_dofs, [0, 3])
    np.testing.assert_array_equal(both.wheel_offsets, [0.0, -2.5])
    assert both.dof_names == ("wheel 1", "bogie 1", "car 1", "wheel 2")
    assert both.stiffness[3, 3] == 0.0


def test_impossible_vehicles():
    with pytest.raises(InputError) as caught:
        wheel_column(wheel_mass=-1.0, primary_stiffness=0.0, secondary_damping=-1.0)
    assert len(caught.value.problems) == 3
    with pytest.raises(InputError, match="wheel_mass = 0"):
        bare_wheel(0.0, 1.0)
    with pytest.raises(InputError, match="negative behind"):
        train([bare_wheel(1.0, 1.0)], [1.0])
    good = wheel_column()
    with pytest.raises(InputError, match="semi-definite"):
        dataclasses.replace(good, stiffness=-good.stiffness)
    two = train([good, good], [0.0, -20.0])  # two parts that nothing couples
    stiffness = two.stiffness.copy()
    stiffness[3:, 3:] *= -1.0
    with pytest.raises(InputError, match="stiffness: must be positive semi-definite"):
        dataclasses.replace(two, stiffness=stiffness)
    with pytest.raises(InputError, match="shape"):
        dataclasses.replace(good, mass=np.eye(2))
    with pytest.raises(InputError, match="symmetric"):
        dataclasses.replace(good, damping=np.triu(np.ones((3, 3))))


def wheelset(half_gauge=0.75):
    """Heave, roll and lateral motion of one wheelset on two rails."""
    rows = [[1.0, -half_gauge, 0.0], [1.0, half_gauge, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    return Vehicle(
        mass=np.diag([1800.0, 800.0, 1800.0]),
        damping=np.zeros((3, 3)),
        stiffness=np.zeros((3, 3)),
        wheel_dofs=np.zeros(0, dtype=int),
        wheel_offsets=np.zeros(4),
        static_loads=np.array([7e4, 7e4, 0.0, 0.0]),
        dof_names=("heave", "roll", "lateral"),
        contact_rows=np.array(rows),
        contact_rails=np.array([0, 1, 0, 1]),
        contact_directions=("Z", "Z", "Y", "Y"),
    )


def test_contacts_of_a_planar_vehicle_are_its_wheel_dofs():
    both = train([wheel_column(), bare_wheel(900.0, 5e4)], [0.0, -2.5])
    np.testing.assert_array_equal(both.contact_rows, np.eye(4)[[0, 3]])
    np.testing.assert_array_equal(both.contact_rails, [0, 0])
    assert both.contact_directions == ("Z", "Z") and both.planar
    np.testing.assert_array_equal(both.contact_offsets, both.wheel_offsets)


def test_train_of_wheelsets_keeps_rails_and_directions():
    both = train([wheelset(), wheelset()], [0.0, -2.5])
    assert (both.n_dofs, both.n_contacts, both.n_wheels) == (6, 8, 4)
    np.testing.assert_array_equal(both.contact_rails, [0, 1] * 4)
    assert both.contact_directions == ("Z", "Z", "Y", "Y") * 2
    # a roll of the second wheelset alone lifts its left tread and lowers its right one
    np.testing.assert_array_equal(both.contact_rows @ np.eye(6)[4], [0] * 4 + [-0.75, 0.75, 0, 0])
    with pytest.raises(InputError, match="all vehicles must be planar, or none"):
        train([wheelset(), wheel_column()], [0.0, -2.5])


def test_impossible_contacts():
    good = wheelset()
    for change, message in (
        ({"contact_rows": np.eye(3)}, r"contact_rows: shape \(3, 3\), must be \(4, 3\)"),
        ({"contact_rails": np.array([0, 1, 2, 0])}, "contact_rails: 0 or 1"),
        ({"contact_directions": ("Z", "Z", "Y", "X")}, 'contact_directions: "Z" or "Y"'),
        ({"contact_directions": ("Z",)}, 'contact_directions: "Z" or "Y"'),
        ({"wheel_offsets": np.zeros(3)}, "one value a wheel"),
    ):
        with pytest.raises(InputError, match=message):
            dataclasses.replace(good, **change)
    with pytest.raises(InputError, match="wheel_dofs: must be dofs of the vehicle, 0 to 2"):
        dataclasses.replace(wheel_column(), wheel_dofs=np.array([3]), contact_rows=np.zeros((0, 0)))

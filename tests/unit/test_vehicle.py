import dataclasses

import numpy as np
import pytest

from contactstudy.exceptions import InputError
from contactstudy.vehicle import bare_wheel, train, wheel_column


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
    with pytest.raises(InputError, match="shape"):
        dataclasses.replace(good, mass=np.eye(2))
    with pytest.raises(InputError, match="symmetric"):
        dataclasses.replace(good, damping=np.triu(np.ones((3, 3))))

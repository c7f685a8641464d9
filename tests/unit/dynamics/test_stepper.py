import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.stepper import (
    State,
    Steps,
    average_acceleration,
    generalised_alpha,
    march,
    newmark,
)
from contactstudy.exceptions import InputError, NumericalError

ONE = LinearSystem(*(sp.csr_array(np.eye(1) * k) for k in (1.0, 0.0, 4.0)))
REST = State(0, 0.0, np.zeros(1), np.zeros(1), np.zeros(1), np.zeros(1))


def test_average_acceleration_keeps_the_energy_of_free_vibration():
    start = State(0, 0.0, np.ones(1), np.zeros(1), -4.0 * np.ones(1), np.zeros(1))
    *_, last = march(ONE, None, start, Steps(0.3, 1000), average_acceleration(), np.zeros(1))
    energy = 0.5 * last.v[0] ** 2 + 2.0 * last.u[0] ** 2
    assert energy == pytest.approx(2.0, rel=1e-12)


@pytest.mark.parametrize("radius", [0.5, 0.8, 0.95])
def test_generalised_alpha_damps_by_its_spectral_radius(radius):
    # far beyond resolution, w dt = 2e4, the amplitude shrinks by the radius each step
    integrator = generalised_alpha(radius)
    assert integrator.constraint_radius == pytest.approx(radius, abs=1e-6)
    start = State(0, 0.0, np.ones(1), np.zeros(1), -4.0 * np.ones(1), np.zeros(1))
    u = [abs(s.u[0]) for s in march(ONE, None, start, Steps(1e4, 400), integrator, np.zeros(1))]
    # a threefold root: n^2 radius^n, so doubling n leaves a factor 4
    assert (u[399] / u[199] / 4.0) ** (1 / 200) == pytest.approx(radius, rel=2e-3)


def test_constraint_radius_of_methods_without_damping_is_one():
    assert average_acceleration().constraint_radius == pytest.approx(1.0)
    assert generalised_alpha(1.0).constraint_radius == pytest.approx(1.0, abs=1e-6)
    assert newmark(0.36, 0.7).constraint_radius < 1.0


def test_states_that_are_not_finite_name_step_time_and_position():
    def load(step):
        return np.array([np.inf if step == 3 else 1.0])

    with pytest.raises(NumericalError, match=r"step 3 of 5, t = 0\.3 s \(wheel at X = 7\.500 m"):
        list(march(ONE, None, REST, Steps(0.1, 5, lambda k: 2.5 * k), average_acceleration(), load))


def test_impossible_arguments():
    with pytest.raises(InputError, match="time step = 0"):
        list(march(ONE, None, REST, Steps(0.0, 5), average_acceleration(), np.zeros(1)))
    with pytest.raises(InputError, match="2 beta >= gamma"):
        newmark(0.1, 0.5)
    with pytest.raises(InputError, match="between 0 and 1"):
        generalised_alpha(1.2)

"""Static start of a wheel that first has to come down to what carries it."""

import numpy as np
import pytest
import scipy.sparse as sp

from contactstudy.dynamics.banded import LinearSystem
from contactstudy.dynamics.statics import static_start
from contactstudy.dynamics.stepper import ContactStep
from contactstudy.exceptions import NumericalError

STIFFNESS, LOAD = 1e9, 70e3
WHEEL = np.array([[0]]), np.ones((1, 1))


class Ground:
    """A spring under the wheel, an open gap below it."""

    def __init__(self, gap):
        self.gap = gap

    accuracy = 1e-11

    def start(self):
        return "before any contact"

    def attached(self, factor, scale):
        compliance = float(scale * factor.solve(np.ones((1, 1)))[0, 0])

        def contact(step, u_free, state):
            # step 0 may be asked as often as needed, always from the same state
            assert (step, state) == (0, "before any contact")
            # k (gap + u_free + W f) = -f
            force = max(0.0, -(self.gap + u_free[0]) / (1 / STIFFNESS + compliance))
            load = np.array([force])
            return ContactStep(load, compliance * load, {"contact_force": load}, "in contact")

        return contact


def free_wheel():
    nothing = sp.csr_array((1, 1))
    return LinearSystem(sp.csr_array([[1200.0]]), nothing, nothing)


@pytest.mark.parametrize("gap", [0.0, 0.05e-3, 0.7e-3, 4e-3])
def test_the_wheel_stands_on_the_ground_however_far_below(gap):
    state = static_start(
        free_wheel(), Ground(gap), np.array([-LOAD]), (np.array([[0]]), np.ones((1, 1)))
    )
    assert state.contact.state == "in contact"
    assert state.contact.record["contact_force"][0] == pytest.approx(LOAD, rel=1e-9)
    assert state.u[0] == pytest.approx(-gap - LOAD / STIFFNESS, rel=1e-9)


def test_a_wheel_over_nothing_is_an_error_not_a_fall():
    with pytest.raises(NumericalError, match=r"5 mm below its place .* still carries nothing"):
        static_start(
            free_wheel(), Ground(1.0), np.array([-LOAD]), (np.array([[0]]), np.ones((1, 1)))
        )

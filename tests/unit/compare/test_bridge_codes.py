import numpy as np
import pytest

from contactstudy.compare.bridge_codes import (
    amplification,
    cancellation_speeds,
    dynamic_factor,
    dynamic_increment,
    frequency_limits,
    irregularity_increment,
    limits,
    load_factor,
    resonance_speeds,
    track_twist,
)
from contactstudy.exceptions import InputError


def test_increments_worked_out_by_hand():
    # 20 m, 6 Hz, 60 m/s: K = 0.25, phi' = 0.25/(0.75 + 0.00390625)
    assert dynamic_increment(60.0, 6.0, 20.0) == pytest.approx(0.331606, abs=1e-6)
    assert dynamic_increment(182.4, 6.0, 20.0) == 1.325  # K = 0.76
    assert dynamic_increment(0.0, 6.0, 20.0) == 0.0
    # phi'' = (56 e^-4 + 50 (120/80 - 1) e^-1)/100
    assert irregularity_increment(60.0, 6.0, 20.0) == pytest.approx(0.102227, abs=1e-6)
    assert irregularity_increment(11.0, 6.0, 20.0) == pytest.approx(0.102227 / 2, abs=1e-6)
    assert irregularity_increment(60.0, 1.0, 20.0) == 0.0  # soft: the formula turns negative
    assert dynamic_factor(60.0, 6.0, 20.0) == pytest.approx(1.433833, abs=2e-6)
    assert dynamic_factor(60.0, 6.0, 20.0, True) == pytest.approx(1.382720, abs=2e-6)


def test_phi_one_is_continuous_where_it_becomes_constant():
    below = dynamic_increment(2 * 20 * 6 * 0.76 * (1 - 1e-9), 6.0, 20.0)
    assert below == pytest.approx(1.325, abs=2e-3)


def test_load_factors_have_the_printed_values_and_bounds():
    # tables of Phi_2 and Phi_3 over the determinant length
    assert load_factor(3.61, True) == pytest.approx(1.67, abs=5e-3)
    assert load_factor(20.0, True) == pytest.approx(1.16, abs=5e-3)
    assert load_factor(20.0) == pytest.approx(1.24, abs=5e-3)
    assert load_factor(67.24, True) == pytest.approx(1.00, abs=5e-3)
    assert load_factor(1.0) == 2.0 and load_factor(200.0) == 1.0
    assert load_factor(0.01) == 2.0


def test_frequency_limits_of_the_figure():
    assert frequency_limits(20.0) == pytest.approx((4.0, 94.76 * 20**-0.748))
    # both branches of the lower limit meet at 20 m
    assert frequency_limits(20.0 + 1e-9)[0] == pytest.approx(4.0, rel=2e-3)
    for length in (4.0, 30.0, 100.0):
        low, high = frequency_limits(length)
        assert low < high
    with pytest.raises(InputError, match="4 to 100 m"):
        frequency_limits(120.0)


def free_vibration(speed, frequency, span):
    """Amplitude of the first mode behind one load, by integrating its equation of motion."""
    w, duration = 2 * np.pi * frequency, span / speed
    t = np.linspace(0.0, duration, 20001)
    # q'' + w^2 q = sin(pi v t/L); Duhamel at the end, as a complex amplitude
    force = np.sin(np.pi * t / duration)
    return abs(np.trapezoid(force * np.exp(1j * w * t), t))


def test_loads_leave_a_span_at_rest_at_cancellation_speeds():
    f, span = 4.0, 20.0
    speeds = cancellation_speeds(f, span, 3)
    np.testing.assert_allclose(speeds, [2 * f * span / k for k in (3, 5, 7)])
    between = np.sqrt(speeds[1:] * speeds[:-1])
    for v in speeds:
        assert free_vibration(v, f, span) < 1e-6 * free_vibration(between[0], f, span)


def test_trains_resonate_where_their_loads_add_up():
    f, distance = 4.0, 25.0
    speeds = resonance_speeds(f, distance, 3)
    np.testing.assert_allclose(speeds, [100.0, 50.0, 100.0 / 3])
    # free vibrations behind 10 equal loads add up in phase
    for v in speeds:
        arrivals = np.arange(10) * distance / v
        assert abs(np.sum(np.exp(2j * np.pi * f * arrivals))) == pytest.approx(10.0)


def test_twist_of_a_track_that_rolls_evenly():
    x = np.linspace(0.0, 30.0, 51)
    roll = np.array([[1e-4], [-3e-4]]) * x  # rad, in two instants
    assert track_twist(x, -0.75 * roll, 0.75 * roll) == pytest.approx(1.5 * 3e-4 * 3.0)
    assert track_twist(x, x, x) == 0.0
    # a step of the cross level within the length counts in full
    step = np.where(x > 15.0, 2e-3, 0.0)
    assert track_twist(x, np.zeros(51), step) == pytest.approx(2e-3)


def test_amplification():
    assert amplification([0.0, -1.3, 1.1], [0.0, -1.0, 0.2]) == pytest.approx(1.3)
    with pytest.raises(InputError, match="zero"):
        amplification([1.0], [0.0])


def test_limits_by_speed_and_kind_of_track():
    slow, fast = (
        {one.name: one for one in limits(v / 3.6, b, 30.0)} for v, b in ((120, True), (300, False))
    )
    deck = "vertical acceleration of the deck"
    assert (slow[deck].value, fast[deck].value) == (3.5, 5.0)
    assert slow["twist over 3 m"].value == 4.5e-3 and fast["twist over 3 m"].value == 1.5e-3
    assert fast["vertical deflection"].value == pytest.approx(0.05)
    assert all(one.source and one.unit for one in slow.values())
    with pytest.raises(InputError, match="speed"):
        limits(0.0, True, 30.0)


@pytest.mark.parametrize("function", [dynamic_increment, irregularity_increment])
def test_impossible_arguments_are_listed_at_once(function):
    with pytest.raises(InputError) as caught:
        function(-1.0, 0.0, -2.0)
    assert len(caught.value.problems) == 3

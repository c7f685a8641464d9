"""Formulas and limits of EN 1991-2 and EN 1990, annex A2, beside which a bridge's response stands.

Closed forms of beams under trains: resonance and cancellation speeds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.compare.low_pass import low_pass, passes
from contactstudy.exceptions import InputError
from contactstudy.validation import not_negative, positive, raise_if


def dynamic_increment(speed: float, frequency: float, length: float) -> float:
    """phi' of EN 1991-2, annex C: increment of a real train on a smooth track.

    ``phi' = K/(1 - K + K^4)``, K = v/(2 L n_0); 1.325 from K = 0.76 on.

    Parameters
    ----------
    speed : float
        v [m/s].
    frequency : float
        First bending frequency n_0 of the bridge under permanent loads [Hz].
    length : float
        Determinant length L_Phi [m].
    """
    raise_if(
        not_negative("speed", speed, "m/s")
        + positive("frequency", frequency, "Hz")
        + positive("length", length, "m")
    )
    k = speed / (2.0 * length * frequency)
    return 1.325 if k >= 0.76 else k / (1.0 - k + k**4)


def irregularity_increment(speed: float, frequency: float, length: float) -> float:
    """phi'' of EN 1991-2, annex C: increment by irregularities of the track, at least 0.

    ``alpha/100 (56 exp(-(L/10)^2) + 50 (L n_0/80 - 1) exp(-(L/20)^2))``, alpha = v/22, at most 1.
    Arguments as in `dynamic_increment`.
    """
    raise_if(
        not_negative("speed", speed, "m/s")
        + positive("frequency", frequency, "Hz")
        + positive("length", length, "m")
    )
    alpha = min(speed / 22.0, 1.0)
    short = 56.0 * math.exp(-((length / 10.0) ** 2))
    long = 50.0 * (length * frequency / 80.0 - 1.0) * math.exp(-((length / 20.0) ** 2))
    return max(0.0, alpha / 100.0 * (short + long))


def dynamic_factor(
    speed: float, frequency: float, length: float, careful_maintenance: bool = False
) -> float:
    """1 + phi' + phi'', with half of phi'' for carefully maintained track; EN 1991-2, annex C."""
    share = 0.5 if careful_maintenance else 1.0
    increments = dynamic_increment(speed, frequency, length)
    return 1.0 + increments + share * irregularity_increment(speed, frequency, length)


def frequency_limits(length: float) -> tuple[float, float]:
    """Lower and upper limit of n_0 [Hz] for a span [m], figure 6.10 of EN 1991-2.

    Between them the factors of load model 71 cover the dynamics up to 200 km/h.

    Raises
    ------
    InputError
        For spans outside 4 to 100 m, where the figure ends.
    """
    if not 4.0 <= length <= 100.0:
        raise InputError(f"length = {length:g} m: must be 4 to 100 m, as in figure 6.10")
    lower = 80.0 / length if length <= 20.0 else 23.58 * length**-0.592
    return lower, 94.76 * length**-0.748


def load_factor(length: float, careful_maintenance: bool = False) -> float:
    """Phi_2 (carefully maintained track) or Phi_3 of load model 71; EN 1991-2, 6.4.5.2."""
    raise_if(positive("length", length, "m"))
    root = max(math.sqrt(length) - 0.2, 1e-9)
    if careful_maintenance:
        return min(max(1.44 / root + 0.82, 1.0), 1.67)
    return min(max(2.16 / root + 0.73, 1.0), 2.0)


_LOWEST_CUT = 30.0  # Hz


def cut_off(frequency: float) -> float:
    """Up to which frequency the deck's acceleration counts for EN 1990, A2.4.4.2.1(4) [Hz].

    The largest of 30 Hz, 1.5 times the first frequency and the third, 9 times the first of a beam.
    """
    return max(_LOWEST_CUT, 9.0 * frequency)


def counted_acceleration(values: ArrayLike, time_step: float, frequency: float) -> float | None:
    """Largest acceleration (n,) up to the `cut_off` of a first frequency [Hz], in size.

    None where samples are too far apart for the filter.
    """
    cut = cut_off(frequency)
    if not passes(time_step, cut):
        return None
    return float(np.max(np.abs(low_pass(values, time_step, cut))))


def amplification(dynamic: ArrayLike, static: ArrayLike) -> float:
    """DAF: largest dynamic over largest static response, in size."""
    largest = float(np.max(np.abs(np.asarray(static))))
    if not largest > 0.0:
        raise InputError("the static response is zero: there is no amplification of it")
    return float(np.max(np.abs(np.asarray(dynamic)))) / largest


def track_twist(x: ArrayLike, right: ArrayLike, left: ArrayLike, length: float = 3.0) -> float:
    """Largest change over a length [m] of the left rail's height above the right one's [m].

    Parameters
    ----------
    x : array_like
        (n,) X [m], which increases.
    right, left : array_like
        (..., n) heights of the rails there [m].
    """
    place = np.asarray(x, dtype=float)
    cross = np.asarray(left, dtype=float) - np.asarray(right, dtype=float)
    there = place[place + length <= place[-1] + 1e-9]
    rows = cross.reshape(-1, len(place))
    ends = [np.interp(there + length, place, row) - np.interp(there, place, row) for row in rows]
    return float(np.max(np.abs(ends), initial=0.0))


def resonance_speeds(frequency: float, distance: float, n: int = 4) -> Array:
    """v = f L_c/i, i = 1 ... n: loads at a distance L_c [m] come once in i periods [m/s]."""
    raise_if(positive("frequency", frequency, "Hz") + positive("distance", distance, "m"))
    return np.asarray(frequency * distance / np.arange(1, n + 1))


def cancellation_speeds(frequency: float, span: float, n: int = 4) -> Array:
    """v = 2 f L/(2 i + 1), i = 1 ... n: a load leaves a simply supported span at rest [m/s].

    The free vibration of its first mode behind a constant load is proportional to
    ``K/(1 - K^2) cos(pi/(2 K))``, K = v/(2 f L), without damping.
    """
    raise_if(positive("frequency", frequency, "Hz") + positive("span", span, "m"))
    return np.asarray(2.0 * frequency * span / (2.0 * np.arange(1, n + 1) + 1.0))


@dataclass(frozen=True)
class Limit:
    """A limit, its unit and where it stands."""

    name: str
    value: float
    unit: str
    source: str


def limits(speed: float, ballasted: bool, span: float) -> tuple[Limit, ...]:
    """Limits of EN 1990, annex A2.4.4, for a line speed [m/s] and a span [m]."""
    raise_if(positive("speed", speed, "m/s") + positive("span", span, "m"))
    kmh = 3.6 * speed
    step = sum(kmh > limit + 1e-6 for limit in (120.0, 200.0))
    deck = 3.5 if ballasted else 5.0
    return (
        Limit("vertical acceleration of the deck", deck, "m/s^2", "A2.4.4.2.1(4)"),
        Limit("twist over 3 m", (4.5e-3, 3.0e-3, 1.5e-3)[step], "m", "table A2.7"),
        Limit("total twist over 3 m", 7.5e-3, "m", "A2.4.4.2.2(3)"),
        Limit("vertical deflection", span / 600.0, "m", "A2.4.4.2.3(1)"),
        Limit("horizontal angle", (3.5e-3, 2.0e-3, 1.5e-3)[step], "rad", "table A2.8"),
        Limit("first lateral frequency, at least", 1.2, "Hz", "A2.4.4.2.4(3)"),
        Limit("vertical acceleration in the coach, very good", 1.0, "m/s^2", "table A2.9"),
        Limit("vertical acceleration in the coach, good", 1.3, "m/s^2", "table A2.9"),
        Limit("vertical acceleration in the coach, acceptable", 2.0, "m/s^2", "table A2.9"),
    )

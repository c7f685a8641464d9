"""Third-octave levels of a signal against those of another."""

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.estimate import third_octave_levels

CONTENT = 40.0
"""dB below the reference's highest band: what is lower holds nothing that could be compared."""
SHORTEST_RECORD = 8
"""Samples that a spectral estimate needs."""


def level_differences(a: Array, b: Array, x: Array, speed: float) -> dict[str, float]:
    """Third-octave levels of `a` less those of `b`: nominal centre in Hz -> dB.

    Bands as in `contactstudy.irregularity.third_octave_levels`, of the whole record in time;
    signals of several wheels (nw, n) are averaged in mean square. Bands in which one of the two
    is empty are left out, and those in which `b`, the reference, has no content: `CONTENT` below
    its highest band or lower.
    """
    spacing = float(x[-1] - x[0]) / (len(x) - 1) / speed
    if len(x) < SHORTEST_RECORD:
        return {}
    pair = []
    for signal in (np.atleast_2d(a), np.atleast_2d(b)):
        levels = [third_octave_levels(one, spacing, reference=1.0) for one in signal]
        pair.append(np.mean([level.mean_square for level in levels], axis=0))
    nominal, least = levels[0].nominal, least_content(pair[1])
    return {
        f"{centre:g}": float(10.0 * np.log10(one / other))
        for centre, one, other in zip(nominal, *pair, strict=True)
        if one > 0.0 and other > least
    }


def share_above(signal: Array, time_step: float, frequency: float) -> float:
    """Share of the variance of a signal (n,) above a frequency [Hz]; 0 of a constant one."""
    power = np.abs(np.fft.rfft(signal - np.mean(signal))) ** 2
    if len(signal) % 2 == 0:
        power[-1] *= 0.5  # the last line has no twin at its negative frequency
    fast = np.fft.rfftfreq(len(signal), time_step) > frequency
    return float(power[fast].sum() / power.sum()) if np.any(power > 0.0) else 0.0


def least_content(mean_square: Array) -> float:
    """Mean square above which a band of the reference has content; all its bands are given."""
    return float(np.max(mean_square, initial=0.0)) * 10.0 ** (-CONTENT / 10.0)

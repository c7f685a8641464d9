"""Ride comfort from accelerations of a car body: Sperling's index and EN 12299."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.validation import positive, raise_if

Direction = Literal["Z", "Y"]

# Sperling's F(f), GB/T 5599: upper end of each range [Hz], factor, power of f
_SPERLING = {
    "Z": ((5.9, 0.325, 2.0), (20.0, 400.0, -2.0), (np.inf, 1.0, 0.0)),
    "Y": ((5.4, 0.8, 2.0), (26.0, 650.0, -2.0), (np.inf, 1.0, 0.0)),
}
_SPERLING_BAND = (0.5, 40.0)  # Hz
_BLOCK = 5.0  # s, EN 12299 and GB/T 5599
# EN 12299, annex C: f1, f2 of the band
_BAND = (0.4, 100.0)
# f3, f4 [Hz], Q2 and the gain of the a-v transition; f5 [Hz], Q3, f6 [Hz], Q4 of W_b's upward step
_TRANSITION = {"Z": (16.0, 16.0, 0.63, 0.4), "Y": (2.0, 2.0, 0.63, 1.0)}
_STEP = (2.5, 0.8, 4.0, 0.8)


def sperling_weight(frequency: ArrayLike, direction: Direction) -> Array:
    """F(f) of Sperling's comfort index in GB/T 5599, at frequencies [Hz]."""
    f = np.asarray(frequency, dtype=float)
    ends = [end for end, _, _ in _SPERLING[direction]]
    part = np.searchsorted(ends, f, side="left")
    factor, power = (np.array(c)[part] for c in list(zip(*_SPERLING[direction], strict=True))[1:])
    return np.asarray(factor * f**power)


def sperling(acceleration: ArrayLike, time_step: float, direction: Direction = "Z") -> float:
    """Sperling's comfort index Wz.

    Of each spectral line between 0.5 and 40 Hz with the amplitude a [m/s^2]
    ``W_i = 3.57 (a^3 F(f)/f)^(1/10)``, and ``Wz = (sum W_i^10)^(1/10)`` (GB/T 5599; with a in
    cm/s^2 the factor is Sperling's 0.896). The lines are those of blocks of 5 s, whose mean index
    is given; a shorter record is one block.

    Raises
    ------
    InputError
        For a time step that is not positive, or a record shorter than 2 s.
    """
    blocks = _blocks(acceleration, time_step)
    n = blocks.shape[-1]
    amplitude = 2.0 / n * np.abs(np.fft.rfft(blocks - blocks.mean(axis=-1, keepdims=True)))
    f = np.fft.rfftfreq(n, time_step)
    inside = (f >= _SPERLING_BAND[0]) & (f <= _SPERLING_BAND[1])
    f, amplitude = f[inside], amplitude[..., inside]
    tenth = 3.57**10 * amplitude**3 * sperling_weight(f, direction) / f
    return float(np.mean(np.sum(tenth, axis=-1) ** 0.1))


def weighting(frequency: ArrayLike, direction: Direction) -> Array:
    """|H(f)| of the weightings of EN 12299, W_b of vertical and W_d of lateral accelerations."""
    s = 2j * np.pi * np.asarray(frequency, dtype=float)
    w1, w2 = (2.0 * np.pi * f for f in _BAND)
    band = s**2 / (s**2 + s * w1 * np.sqrt(2.0) + w1**2)
    band = band * w2**2 / (s**2 + s * w2 * np.sqrt(2.0) + w2**2)
    f3, f4, q2, gain = _TRANSITION[direction]
    w3, w4 = 2.0 * np.pi * f3, 2.0 * np.pi * f4
    made = gain * band * (s + w3) / (s**2 + s * w4 / q2 + w4**2) * w4**2 / w3
    if direction == "Z":
        f5, q3, f6, q4 = _STEP
        w5, w6 = 2.0 * np.pi * f5, 2.0 * np.pi * f6
        step = (s**2 + s * w5 / q3 + w5**2) / (s**2 + s * w6 / q4 + w6**2)
        made = made * step * w6**2 / w5**2
    return np.abs(made)


def weighted_rms(acceleration: ArrayLike, time_step: float, direction: Direction = "Z") -> Array:
    """Root mean square of the weighted acceleration in each block of 5 s, EN 12299 [m/s^2].

    Weighted line by line of a block's spectrum (Parseval). Errors as in `sperling`.
    """
    blocks = _blocks(acceleration, time_step)
    n = blocks.shape[-1]
    lines = np.fft.rfft(blocks) * weighting(np.fft.rfftfreq(n, time_step), direction)
    twice = np.full(lines.shape[-1], 2.0)
    twice[0] = 1.0
    if n % 2 == 0:
        twice[-1] = 1.0
    return np.asarray(np.sqrt(np.sum(twice * np.abs(lines) ** 2, axis=-1)) / n)


def mean_comfort(vertical: ArrayLike, lateral: ArrayLike, time_step: float) -> float:
    """N_MV of EN 12299 without accelerations along the track, which the model does not have.

    ``N_MV = 6 sqrt(a_Y^2 + a_Z^2)`` of the 95th percentiles of weighted values of 5 s. The standard
    takes them over 5 minutes; of a shorter record it is an estimate.
    """
    across = np.percentile(weighted_rms(lateral, time_step, "Y"), 95.0)
    up = np.percentile(weighted_rms(vertical, time_step, "Z"), 95.0)
    return float(6.0 * np.hypot(across, up))


def _blocks(acceleration: ArrayLike, time_step: float) -> Array:
    """(blocks, samples) of 5 s each; all of it as one block if it is shorter."""
    a = np.asarray(acceleration, dtype=float)
    raise_if(positive("time_step", time_step, "s"))
    if a.ndim != 1 or not np.all(np.isfinite(a)) or a.size * time_step < 2.0 * (1.0 - 1e-9):
        raise InputError(
            "comfort: the acceleration must be finite, of one dimension and at least 2 s long "
            f"(here {a.size * time_step:.3g} s); below 0.5 Hz nothing counts"
        )
    n = round(_BLOCK / time_step)
    if a.size < n:
        return a[None]
    return a[: a.size // n * n].reshape(-1, n)

"""Low-pass filter of signals in time, as standards ask for it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.validation import positive, raise_if


def low_pass(values: ArrayLike, time_step: float, frequency: float) -> Array:
    """Signals (..., n) behind a low-pass filter with 24 dB an octave above a frequency [Hz].

    Butterworth's of order four, which is in the steady state of the first value in the beginning.

    Raises
    ------
    InputError
        For a time step or frequency that is not positive, or samples too far apart for it.
    """
    from scipy.signal import butter, sosfilt, sosfilt_zi

    raise_if(positive("time_step", time_step, "s") + positive("frequency", frequency, "Hz"))
    if not passes(time_step, frequency):
        raise InputError(
            f"time_step = {time_step:g} s: must be below {0.5 / frequency:g} s for a low-pass "
            f"filter of {frequency:g} Hz"
        )
    signal = np.asarray(values, dtype=float)
    sos = butter(4, frequency, fs=1.0 / time_step, output="sos")
    # (sections, ..., 2) states that a constant signal leaves as they are
    still = sosfilt_zi(sos).reshape(len(sos), *[1] * (signal.ndim - 1), 2) * signal[..., :1]
    return np.asarray(sosfilt(sos, signal, axis=-1, zi=still)[0])


def passes(time_step: float, frequency: float) -> bool:
    """Whether samples are close enough for a filter of a frequency [Hz]."""
    return time_step < 0.5 / frequency

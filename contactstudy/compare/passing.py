"""Periodic components of a signal along the rail: sleeper, element and cell passing."""

import math

import numpy as np

from contactstudy.exceptions import InputError


def passing_amplitude(
    position: np.ndarray,
    signal: np.ndarray,
    wavelength: float,
    harmonics: int = 1,
    fundamental: float | None = None,
) -> np.ndarray:
    """Amplitudes of the components with wavelengths wavelength/1, /2, ... /harmonics.

    They are Fourier coefficients over the last whole number of `fundamental` periods in the
    record, |2/L int s exp(-2 pi i h X / wavelength) dX|, by the trapezoidal rule with
    interpolated ends, after a straight line between the ends has been taken away.

    Parameters
    ----------
    position, signal : ndarray (n,)
        X, increasing [m], and the signal there, in whose unit the amplitudes (harmonics,) are.
    wavelength : float
        [m].
    fundamental : float, optional
        Period of the whole signal [m], a multiple of the wavelength; the wavelength itself when
        not given. Give the support spacing where that is longer: otherwise its ripple leaks.

    Raises
    ------
    InputError
        If the record is shorter than one period or not increasing.
    """
    import scipy.integrate

    x, s = np.asarray(position, dtype=float), np.asarray(signal, dtype=float)
    period = wavelength if fundamental is None else fundamental
    problems = []
    if x.ndim != 1 or x.shape != s.shape or len(x) < 3 or np.any(np.diff(x) <= 0.0):
        problems.append("passing_amplitude: position and signal must be equally long, X increasing")
    elif not 0.0 < wavelength <= period <= x[-1] - x[0]:
        problems.append(
            f"passing_amplitude: wavelength = {wavelength:g} m, period = {period:g} m:"
            f" must be above 0 and fit into the record of {x[-1] - x[0]:g} m"
        )
    if harmonics < 1:
        problems.append(f"passing_amplitude: harmonics = {harmonics}: must be at least 1")
    if problems:
        raise InputError(problems)
    length = period * math.floor((x[-1] - x[0]) / period * (1.0 + 1e-9))
    first = max(x[-1] - length, x[0])
    inside = x > first
    x, s = np.append(first, x[inside]), np.append(np.interp(first, x, s), s[inside])
    s = s - np.interp(x, x[[0, -1]], s[[0, -1]])
    orders = np.arange(1, harmonics + 1)
    waves = np.exp(-2j * np.pi * orders[:, None] * x / wavelength)
    return np.abs(2.0 / length * scipy.integrate.trapezoid(waves * s, x, axis=1))

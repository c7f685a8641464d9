"""Band-pass of a measured level."""

from pathlib import Path

import numpy as np

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.validation import raise_if

_FINER = 20
"""Equally spaced rows that may be made of one row of a file."""


def band_passed(
    file: Path,
    x: Array,
    level: Array,
    wavelengths: tuple[float, float],
    degree: int,
) -> tuple[Array, Array]:
    """Positions at equal spacing and the level there between two wavelengths [m].

    Fourth-order Butterworth run forwards and backwards; `degree` is that of the spline to equal
    spacing. ``InputError`` for wavelengths that rows or record cannot have, and too uneven rows.
    """
    from scipy.interpolate import make_interp_spline
    from scipy.signal import butter, sosfiltfilt

    step = np.diff(x)
    dx = float(np.median(step))
    if np.abs(step - dx).max() > 1e-6 * dx:
        count = round((x[-1] - x[0]) / dx) + 1
        if count > _FINER * len(x):
            raise InputError(
                f"{file}: half of the rows are at most {dx:g} m apart, which makes {count} equally "
                f"spaced ones of {len(x)}; allowed: up to {_FINER} times as many (leave out rows "
                "that stand close together)"
            )
        even = np.linspace(x[0], x[-1], count)
        spline = make_interp_spline(x, level, k=degree)
        x, level = even, np.asarray(spline(even), dtype=float)
        dx = float(x[1] - x[0])
    shortest, longest = wavelengths
    problems = []
    if shortest <= 2.0 * dx:
        problems.append(
            f"{file}: shortest wavelength is {shortest:g} m; allowed: above {2.0 * dx:g} m, twice "
            "the spacing of the rows"
        )
    if longest > x[-1] - x[0]:
        problems.append(
            f"{file}: longest wavelength is {longest:g} m; allowed: up to {x[-1] - x[0]:g} m, the "
            "length of the record"
        )
    raise_if(problems)
    sos = butter(4, (1.0 / longest, 1.0 / shortest), "bandpass", fs=1.0 / dx, output="sos")
    # mirrored ends longer than the longest wavelength let the filter settle outside the record
    pad = min(len(x) - 1, round(2.0 * longest / dx))
    return x, np.asarray(sosfiltfilt(sos, level, padlen=pad), dtype=float)

"""Wheel forces as EN 14363 takes them, and its limits, beside which those of a passage stand."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.validation import positive, raise_if

CUT_OFF = 20.0
"""Hz, of the low-pass filter of wheel forces."""
WINDOW = 2.0
"""m, of the sliding mean of Y/Q and of the track shift force."""
QUOTIENT = 0.8
"""Limit of Y/Q, sliding mean over 2 m."""
UNLOADING = 0.6
"""Limit of the unloading (Q_0 - Q)/Q_0 on twisted track, standing or slow."""
# line speed [km/h] up to which the wheel force may be as large [N]
_WHEEL_FORCE = ((160.0, 200e3), (200.0, 190e3), (250.0, 180e3), (300.0, 170e3), (np.inf, 160e3))


def sliding_mean(values: ArrayLike, spacing: float) -> Array:
    """Means over `WINDOW` of signals (..., n) with a spacing [m]; (..., n - m + 1) for m samples.

    Of a signal shorter than the window the mean of all of it.
    """
    raise_if(positive("spacing", spacing, "m"))
    signal = np.asarray(values, dtype=float)
    m = min(max(round(WINDOW / spacing), 1), signal.shape[-1])
    total = np.cumsum(np.concatenate([np.zeros((*signal.shape[:-1], 1)), signal], axis=-1), axis=-1)
    return np.asarray((total[..., m:] - total[..., :-m]) / m)


def track_shift_limit(axle_load: float, freight: bool = False) -> float:
    """Limit of the sum of both lateral forces of a wheelset, sliding mean over 2 m [N].

    ``k_1 (10 kN + 2 Q_0/3)``, 2 Q_0 the axle load [N]; k_1 = 0.85 for freight wagons, else 1.
    """
    raise_if(positive("axle_load", axle_load, "N"))
    return (0.85 if freight else 1.0) * (10e3 + axle_load / 3.0)


def wheel_force_limit(static: float, speed: float) -> float:
    """Limit of a vertical wheel force [N]: Q_0 + 90 kN, at most 200 to 160 kN by speed [m/s]."""
    raise_if(positive("static", static, "N") + positive("speed", speed, "m/s"))
    kmh = 3.6 * speed
    most = next(force for top, force in _WHEEL_FORCE if kmh <= top + 1e-6)
    return min(static + 90e3, most)

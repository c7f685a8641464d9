"""Amplitudes that railways have, over the wavelength: a limit, a spectrum, a measurement.

A third octave of the root mean square s is drawn as the wave that alone has it, of the amplitude
sqrt(2) s.
"""

from __future__ import annotations

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.chosen import Irregularity
from contactstudy.irregularity.limit import ISO_3095_LIMIT
from contactstudy.study.results import StudyResults


def limit_level() -> tuple[Array, Array]:
    """Wavelengths and amplitudes of waves that alone are at the limit of ISO 3095 [m]."""
    wave, level = np.array(sorted(ISO_3095_LIMIT.items())).T
    return wave, amplitude(level)


def paper_level() -> tuple[Array, Array]:
    """Wavelengths of Table 1's band, and amplitudes of waves with a third octave's variance [m]."""
    spectrum, (low, high) = Irregularity().formula(), Irregularity().band
    omega = np.geomspace(low, high, 60)
    # a two-sided density of the standard deviation s in a third octave: s^2 = 2 G(w) dw
    variance = 2.0 * spectrum(omega) * omega * (2 ** (1 / 6) - 2 ** (-1 / 6))
    return 2.0 * np.pi / omega, np.sqrt(2.0 * variance)


def measured_level(results: StudyResults) -> tuple[Array, Array] | None:
    """Wavelengths and amplitudes of the roughness that the study names, by wavelength [m]."""
    levels = results.config.get("roughness", {}).get("levels")
    if not levels:
        return None
    wave, level = np.array(levels, dtype=float).T
    return wave, amplitude(level)


def amplitude(level: Array) -> Array:
    """Amplitude [m] of a wave of a level in dB re 1 um."""
    return np.asarray(np.sqrt(2.0) * 1e-6 * 10.0 ** (level / 20.0))

"""Roughness at the limit of ISO 3095, as a profile."""

import numpy as np

from contactstudy.irregularity.profile import HarmonicProfile
from contactstudy.validation import raise_if

#: Wavelength [m] -> rail roughness level [dB re 1 um] per third octave; ISO 3095:2013, limit of
#: the acoustic rail roughness for type tests.
ISO_3095_LIMIT = {
    0.4: 17.1,
    0.315: 15.0,
    0.25: 13.0,
    0.2: 11.0,
    0.16: 9.0,
    0.125: 7.0,
    0.1: 4.9,
    0.08: 2.9,
    0.063: 0.9,
    0.05: -1.1,
    0.04: -3.2,
    0.0315: -5.0,
    0.025: -5.6,
    0.02: -6.2,
    0.016: -6.8,
    0.0125: -7.4,
    0.01: -8.0,
    0.008: -8.6,
    0.0063: -9.2,
    0.005: -9.8,
    0.004: -10.4,
    0.00315: -11.0,
}


def iso_3095_profile(
    seed: int, wavelengths: tuple[float, float] = (0.02, 0.4), lines: int = 5
) -> HarmonicProfile:
    """Random profile whose third-octave levels are the limit of ISO 3095.

    Each band has `lines` waves of equal amplitude and random phase at wavenumbers that share it
    equally on the logarithmic scale, so that ``lines a^2/2 = 10^(L/10) (1 um)^2``.

    The bands are those from the shortest to the longest nominal wavelength [m]. If there is none,
    or lines or seed are impossible, that is an ``InputError``.
    """
    low, high = wavelengths
    chosen = [w for w in ISO_3095_LIMIT if low * (1 - 1e-9) <= w <= high * (1 + 1e-9)]
    problems = []
    if not chosen:
        problems.append(f"wavelengths = {wavelengths} m: must hold a band from 0.00315 to 0.4 m")
    if lines < 1:
        problems.append(f"lines = {lines}: must be at least 1")
    if seed < 0:
        problems.append(f"seed = {seed}: must be a whole number from 0 on")
    raise_if(problems)
    share = (np.arange(lines) + 0.5) / lines - 0.5
    # the exact centre of a band is 10^(k/10), in 1/m; it is 10^(1/10) wide
    centre = 10.0 ** (np.rint(10.0 * np.log10(1.0 / np.array(chosen))) / 10.0)
    wavenumber = 2.0 * np.pi * centre[:, None] * 10.0 ** (0.1 * share)
    mean_square = 1e-12 * 10.0 ** (np.array([ISO_3095_LIMIT[w] for w in chosen]) / 10.0)
    amplitude = np.sqrt(2.0 * mean_square / lines)[:, None] * np.ones(lines)
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, wavenumber.shape)
    order = np.argsort(wavenumber.ravel())
    return HarmonicProfile(
        amplitude.ravel()[order], wavenumber.ravel()[order], phase.ravel()[order]
    )

"""Sample profiles of a spectrum: eqs (1) and (2) of the paper."""

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.irregularity.profile import HarmonicProfile
from contactstudy.validation import raise_if

DIRECTIONS = ("vertical", "transverse")


def sample_profile(
    spectrum: Callable[[ArrayLike], Array],
    seed: int,
    n_terms: int = 1000,
    band: tuple[float, float] = (0.08, 20.0),
    jitter: bool = False,
    direction: Literal["vertical", "transverse"] = "vertical",
) -> HarmonicProfile:
    """Random profile with a given two-sided spectral density; the defaults are Table 1's.

    The seed gives each direction its own stream, ``numpy.random.SeedSequence(seed).spawn(2)``
    (vertical, transverse); a stream first yields the phases, then the jitter. So the two
    directions are independent, and jitter leaves the phases as they are.

    Parameters
    ----------
    spectrum : callable
        Two-sided density [m^2/(rad/m)] at angular wavenumbers [rad/m], e.g. a ``Spectrum``.
    band : tuple of float
        Lower and upper angular wavenumber [rad/m].
    jitter : bool
        Put each wavenumber at random in its own interval of width (upper - lower)/N, instead
        of in its middle: the profile then does not repeat itself, and the expected variance is
        that of the spectrum.

    Raises
    ------
    InputError
        With every argument that is not allowed.
    """
    problems = []
    if isinstance(seed, bool) or int(seed) != seed or seed < 0:
        problems.append(f"seed is {seed}; allowed: whole numbers from 0 on")
    if isinstance(n_terms, bool) or int(n_terms) != n_terms or n_terms < 1:
        problems.append(f"number of terms is {n_terms}; allowed: whole numbers from 1 on")
    if not (np.all(np.isfinite(band)) and 0.0 < band[0] < band[1]):
        problems.append(f"band is {band} rad/m; allowed: 0 < lower < upper")
    if direction not in DIRECTIONS:
        problems.append(f"direction is '{direction}'; allowed: {', '.join(DIRECTIONS)}")
    raise_if(f"irregularity: {text}" for text in problems)
    lower, upper = band
    stream = np.random.SeedSequence(int(seed)).spawn(2)[DIRECTIONS.index(direction)]
    rng = np.random.default_rng(stream)
    phases = rng.uniform(0.0, 2.0 * np.pi, n_terms)
    place = rng.uniform(0.0, 1.0, n_terms) if jitter else np.full(n_terms, 0.5)
    # (2): omega_k = omega_l + (k - 1/2) d, d = (omega_u - omega_l)/N, a_k = 2 sqrt(G d):
    # with a two-sided G the variance sum a_k^2/2 = 2 sum G d is its integral over both signs
    step = (upper - lower) / n_terms
    wavenumbers: Array = lower + (np.arange(n_terms) + place) * step
    amplitudes = np.asarray(2.0 * np.sqrt(spectrum(wavenumbers) * step), dtype=float)
    return HarmonicProfile(amplitudes, wavenumbers, phases)

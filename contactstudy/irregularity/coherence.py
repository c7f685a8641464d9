"""What the irregularity of one rail says of the other's.

The two rails of a direction have the same spectral density S. How much one says of the other is
their coherence, gamma^2(omega) = |S_RL|^2 / (S_R S_L): 1 for rails that are alike, 0 for rails that
have nothing to do with each other.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.profile import HarmonicProfile
from contactstudy.irregularity.sample import DIRECTIONS

Coherence = Callable[[Array], Array]
"""Wavenumbers [rad/m] to gamma^2."""


def constant_coherence(value: float) -> Coherence:
    """The same gamma^2 at all wavelengths."""
    return lambda w: np.full(np.shape(w), float(value))


def decaying_coherence(wavelength: float) -> Coherence:
    """gamma^2 = exp(-l/lambda): long waves are those of both rails, short ones of each.

    At the wavelength l [m] the coherence is 1/e.
    """
    return lambda w: np.exp(-wavelength * np.asarray(w) / (2.0 * np.pi))


def other_rail(
    first: HarmonicProfile,
    coherence: Coherence,
    seed: int,
    direction: Literal["vertical", "transverse"] = "vertical",
) -> HarmonicProfile:
    """A profile of the density and the wavenumbers of `first` that has a coherence with it.

    With terms ``a exp(i phi)`` of the first rail and phases psi of its own, those of the other are
    ``a (gamma exp(i phi) + sqrt(1 - gamma^2) exp(i psi))``: their expected square is a^2, and the
    expected product with the first gamma a^2. The phases psi are streams 2 (vertical) and 3
    (transverse) of the seed, beside those of `sample_profile`; jitter is the first rail's.
    """
    squared = np.clip(coherence(first.wavenumbers), 0.0, 1.0)
    stream = np.random.SeedSequence(int(seed)).spawn(4)[2 + DIRECTIONS.index(direction)]
    own = np.random.default_rng(stream).uniform(0.0, 2.0 * np.pi, first.phases.size)
    together = np.sqrt(squared) * np.exp(1j * first.phases)
    terms = together + np.sqrt(1.0 - squared) * np.exp(1j * own)
    return HarmonicProfile(first.amplitudes * np.abs(terms), first.wavenumbers, np.angle(terms))

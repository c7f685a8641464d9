"""Spectral estimates of sampled signals: Welch's method and third-octave bands."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError


@dataclass(frozen=True, eq=False)
class SpectralEstimate:
    """Power spectral density of a sampled signal.

    Wavenumbers (n,) from 0 to Nyquist, in 1/m or rad/m (Hz or rad/s for a signal in time);
    density (n,), the signal squared per unit of wavenumber; number of averaged segments.
    """

    wavenumber: Array
    density: Array
    n_segments: int


def spectral_estimate(
    values: ArrayLike,
    dx: float,
    segment_length: float | None = None,
    sides: Literal["two", "one"] = "two",
    unit: Literal["rad/m", "1/m"] = "rad/m",
) -> SpectralEstimate:
    """Welch's estimate: Hann window, 50 % overlap, mean of each segment removed.

    Parameters
    ----------
    dx : float
        Spacing of the values [m] (or [s]).
    segment_length : float, optional
        Length of a segment, in the unit of ``dx``; an eighth of the record by default.
    sides : {"two", "one"}
        Two-sided, half of the variance lies at negative wavenumbers: as G_rr of eq. (3).
    unit : {"rad/m", "1/m"}
        Angular wavenumber or wavenumber.

    Raises
    ------
    InputError
        If the samples are too few or not finite, or an argument is not allowed.
    """
    signal = _checked(values, dx)
    if sides not in ("one", "two") or unit not in ("rad/m", "1/m"):
        raise InputError(
            f"spectral estimate: sides '{sides}', unit '{unit}'; "
            "allowed: 'one' or 'two', 'rad/m' or '1/m'"
        )
    length = signal.size * dx / 8.0 if segment_length is None else segment_length
    n = round(length / dx)
    if not 8 <= n <= signal.size:
        raise InputError(
            f"spectral estimate: segment length is {length:g}; allowed: {8 * dx:g} to "
            f"{signal.size * dx:g} (8 samples to the whole record)"
        )
    frequency, density, segments = _welch(signal, dx, n)
    turn = 2.0 * np.pi if unit == "rad/m" else 1.0
    # S_omega = S_f/(2 pi); the one-sided density is the double
    density = density / turn * (2.0 if sides == "one" else 1.0)
    return SpectralEstimate(turn * frequency, density, segments)


@dataclass(frozen=True, eq=False)
class ThirdOctaves:
    """Levels in third-octave bands (base ten, IEC 61260-1).

    Parameters
    ----------
    nominal, centre : ndarray, shape (n,)
        Nominal and exact centres 10^(k/10) [Hz], or [1/m] of a signal in space.
    mean_square : ndarray, shape (n,)
        Of the signal in each band.
    level : ndarray, shape (n,)
        10 lg(mean_square/reference^2) [dB]; -inf where the band is empty.
    """

    nominal: Array
    centre: Array
    mean_square: Array
    level: Array

    @property
    def wavelength(self) -> Array:
        """Centres as wavelengths [m] (periods [s])."""
        return 1.0 / self.centre


def third_octave_levels(
    values: ArrayLike,
    spacing: float,
    reference: float = 1e-6,
    segment_length: float | None = None,
    band: tuple[float, float] | None = None,
) -> ThirdOctaves:
    """Third-octave levels of a signal in space (roughness) or in time (a force).

    The density of Welch's estimate (Hann, 50 % overlap, mean removed) is integrated over each
    band, a spectral line counting with the part of its width that lies inside. Only bands at
    least as wide as the distance of two lines, and wholly below Nyquist, are given.

    Parameters
    ----------
    spacing : float
        Of the values [m] or [s].
    reference : float
        0 dB, in the signal's unit: 1e-6 m for roughness.
    segment_length : float, optional
        Length of a segment [m] or [s]; the whole record by default (the finest lines).
    band : tuple of float, optional
        Lowest and highest centre wanted [1/m] or [Hz].

    Raises
    ------
    InputError
        As ``spectral_estimate``; or if the reference is not positive.
    """
    signal = _checked(values, spacing)
    if not (np.isfinite(reference) and reference > 0.0):
        raise InputError(f"third-octave levels: reference is {reference}; allowed: above 0")
    length = signal.size * spacing if segment_length is None else segment_length
    estimate = spectral_estimate(signal, spacing, length, "one", "1/m")
    frequency, density = estimate.wavenumber, estimate.density
    line = float(frequency[1])
    low, high = (line, 0.5 / spacing) if band is None else band
    if not 0.0 < low <= high:
        raise InputError(f"third-octave levels: band is {band}; allowed: 0 < lowest <= highest")
    centre, lower, upper = third_octaves(low, high)
    keep = (upper - lower >= line) & (upper <= 0.5 / spacing)
    centre, lower, upper = centre[keep], lower[keep], upper[keep]
    # each line stands for [f - line/2, f + line/2]; the cumulative integral is linear there
    edges = np.append(frequency - 0.5 * line, frequency[-1] + 0.5 * line)
    total = np.concatenate([[0.0], np.cumsum(density * line)])
    mean_square = np.interp(upper, edges, total) - np.interp(lower, edges, total)
    with np.errstate(divide="ignore"):
        level = 10.0 * np.log10(np.maximum(mean_square, 0.0) / reference**2)
    return ThirdOctaves(nominal_centre(centre), centre, mean_square, level)


def third_octaves(lowest: float, highest: float) -> tuple[Array, Array, Array]:
    """Centres 10^(k/10), lower and upper ends of the bands with centres from lowest to highest."""
    k = np.arange(round(10.0 * np.log10(lowest)), round(10.0 * np.log10(highest)) + 1)
    centre = 10.0 ** (k / 10.0)
    return centre, centre * 10.0**-0.05, centre * 10.0**0.05


_NOMINAL = np.array([1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0])


def nominal_centre(centre: ArrayLike) -> Array:
    """Nominal value (1, 1.25, 1.6, ... times a power of ten) of exact band centres."""
    k = np.rint(10.0 * np.log10(np.asarray(centre, dtype=float))).astype(int)
    # rounded to 12 digits: 6.3 times 0.1 is 0.63, not 0.6300000000000001
    value = _NOMINAL[k % 10] * 10.0 ** (k // 10)
    return np.array([float(f"{v:.12g}") for v in value.ravel()]).reshape(value.shape)


def _welch(signal: Array, dx: float, n: int) -> tuple[Array, Array, int]:
    """Two-sided density over the frequencies 0 to Nyquist, and the number of segments.

    Written out, for loading SciPy's takes longer than many a study.
    """
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) / n)  # Hann's, periodic
    segments = np.lib.stride_tricks.sliding_window_view(signal, n)[:: n - n // 2]
    segments = segments - segments.mean(axis=1, keepdims=True)
    # S = |sum_j w_j r_j exp(-2 pi i j k/n)|^2 dx / sum_j w_j^2, averaged over the segments
    power = np.abs(np.fft.rfft(window * segments)) ** 2
    density = power.mean(axis=0) * dx / np.sum(window**2)
    frequency = np.arange(n // 2 + 1) / (n * dx)
    return frequency, density, len(segments)


def _checked(values: ArrayLike, dx: float) -> Array:
    signal = np.asarray(values, dtype=float)
    if not (np.isfinite(dx) and dx > 0.0):
        raise InputError(f"spectral estimate: spacing is {dx}; allowed: above 0")
    if signal.ndim != 1 or signal.size < 8 or not np.all(np.isfinite(signal)):
        raise InputError(
            f"spectral estimate: samples of shape {signal.shape}; allowed: 8 or more finite numbers"
        )
    return signal

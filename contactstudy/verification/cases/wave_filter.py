r"""The contact-patch filter: what a wheel under constant load takes from a wavy rail.

A small irregularity r(x), uniform across the rail, adds ``n_i r_i`` to the overlap at point i.
While the points A in contact stay the same, their forces and the approach delta obey

    M_AA lam_A = n_A (delta + r_A) - gap_A,   n_A^T lam_A = F,   M = W + diag(1/(eps A))

so at constant F, with lam' the change of force that r makes,

    -delta' = w^T r / w^T 1,   w = n_A * (M_AA^-1 n_A) = n_A * d lam_A/dF * (n_A^T M_AA^-1 n_A)

The wheel rises by the mean of r under the patch, weighted with the forces that come with more
load (`contactstudy.contact.press_table.load_weights`). (Points at the edge of the patch carry no
force, so that they enter or leave it only changes the second order.) For ``r = cos(k x)`` the ratio
of the amplitudes is

    H(k) = | sum_i w_i exp(i k x_i) | / sum_i w_i

On half-spaces Hertz's patch is an ellipse, and dp/dF is the pressure under a flat punch of its
shape, ``1/(2 pi a b sqrt(1 - x^2/a^2 - y^2/b^2))`` (Johnson 1985, Contact Mechanics, sec. 3.8,
and eq. (3.60) for how Hertz's pressure is built up of them). Its integral over y is 1/(2a)
wherever -a < x < a: the wheel takes the plain mean over the length of the patch,

    H(k) = | sin(k a) / (k a) |
"""

from dataclasses import dataclass

import numpy as np

from contactstudy.arrays import Array
from contactstudy.contact.complementarity import press


def ellipse_filter(semi_axis: float, wavelengths: Array) -> Array:
    """Filter of Hertz's patch on half-spaces, half length a and wavelengths (k,) in m.

    The filter (k,) is the ratio of the amplitude of the wheel's movement to that of the
    irregularity.
    """
    # numpy's sinc has the factor pi in it: sin(k a)/(k a) with k = 2 pi/wavelength
    return np.asarray(np.abs(np.sinc(2 * semi_axis / np.asarray(wavelengths, dtype=float))))


def small_amplitude_filter(weights: Array, x: Array, wavelengths: Array) -> Array:
    """Filter (k,) for an irregularity of small amplitude and wavelengths (k,) in m.

    The points at `x` (n,) in m along the rail have the weights (n,) of `load_weights`.
    """
    k = 2 * np.pi / np.asarray(wavelengths, dtype=float)
    return np.asarray(np.abs(np.exp(1j * k[:, None] * x) @ weights))


@dataclass(frozen=True)
class PatchPoints:
    """Contact points under a wheel.

    Attributes
    ----------
    M, gap, normal : ndarray (n, n), (n,), (n,)
        As in `contact.complementarity.press`.
    x : ndarray (n,)
        Positions along the rail in m.
    """

    M: Array
    gap: Array
    normal: Array
    x: Array


def pressed_filter(
    points: PatchPoints, load: float, wavelength: float, amplitude: float, positions: int = 12
) -> float:
    """Filter for an irregularity of any amplitude, from static presses along one wavelength.

    Parameters
    ----------
    load : float
        In N.
    wavelength, amplitude : float
        Of the irregularity in m.
    positions : int
        Equally spaced positions of the wheel at which it is pressed.

    Returns
    -------
    float
        First harmonic of the wheel's height over the amplitude.
    """
    phases = 2 * np.pi * np.arange(positions) / positions
    approach, last = np.empty(positions), None
    for i, phase in enumerate(phases):
        r = amplitude * np.cos(2 * np.pi * points.x / wavelength + phase)
        last = press(
            points.M,
            points.gap - points.normal * r,
            points.normal,
            load,
            None if last is None else last.active,
            None if last is None else last.approach,
        )
        approach[i] = last.approach
    return float(np.abs(2 / positions * (approach @ np.exp(1j * phases))) / amplitude)

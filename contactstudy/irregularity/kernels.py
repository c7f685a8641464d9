"""Sums of cosines at many positions."""

import math

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compiled import compiled

_BLOCK = 256  # positions handled side by side: fills the vector units, stays in the first cache


@compiled
def equally_spaced_sum(
    x: Array,
    first: float,
    spacing: float,
    real: Array,
    imag: Array,
    out: Array,
) -> None:
    """Sum of Re[c_k exp(i (first + k spacing) x)], k = 0..n-1, into ``out``.

    With w = exp(i spacing x) the sum is exp(i first x) times a polynomial in w, evaluated by
    Horner's rule: the rotation by w is the same for all k, so there is one sine and cosine a
    position instead of n, and |w| = 1 keeps the rounding errors from growing.
    """
    n = real.size
    zr, zi = np.empty(_BLOCK), np.empty(_BLOCK)
    wr, wi = np.empty(_BLOCK), np.empty(_BLOCK)
    for start in range(0, x.size, _BLOCK):
        m = min(_BLOCK, x.size - start)
        for j in range(m):
            angle = spacing * x[start + j]
            wr[j], wi[j] = math.cos(angle), math.sin(angle)
            zr[j], zi[j] = real[n - 1], imag[n - 1]
        for k in range(n - 2, -1, -1):
            cr, ci = real[k], imag[k]
            for j in range(m):
                t = zr[j] * wr[j] - zi[j] * wi[j] + cr
                zi[j] = zr[j] * wi[j] + zi[j] * wr[j] + ci
                zr[j] = t
        for j in range(m):
            angle = first * x[start + j]
            out[start + j] = zr[j] * math.cos(angle) - zi[j] * math.sin(angle)


@compiled
def direct_sum(
    x: Array,
    cycles: Array,
    offset: Array,
    amplitude: Array,
    out: Array,
) -> None:
    """Sum of amplitude_k cos(2 pi (cycles_k x + offset_k)) into ``out``.

    cos(2 pi t) with t folded to v = 1/4 - |t| in [-1/4, 1/4] is sin(2 pi v), whose Taylor
    series to the 21st power is exact to rounding there; unlike the library's cosine it is
    handled by the vector units, which makes it several times faster.
    """
    two_pi = 2.0 * math.pi
    acc = np.empty(_BLOCK)
    for start in range(0, x.size, _BLOCK):
        m = min(_BLOCK, x.size - start)
        acc[:m] = 0.0
        for k in range(cycles.size):
            c, o, a = cycles[k], offset[k], amplitude[k]
            for j in range(m):
                t = c * x[start + j] + o
                t -= math.floor(t + 0.5)
                s = two_pi * (0.25 - abs(t))
                q = s * s
                p = 1.0 - q / 420.0
                p = 1.0 - q / 342.0 * p
                p = 1.0 - q / 272.0 * p
                p = 1.0 - q / 210.0 * p
                p = 1.0 - q / 156.0 * p
                p = 1.0 - q / 110.0 * p
                p = 1.0 - q / 72.0 * p
                p = 1.0 - q / 42.0 * p
                p = 1.0 - q / 20.0 * p
                p = 1.0 - q / 6.0 * p
                acc[j] += a * s * p
        for j in range(m):
            out[start + j] = acc[j]

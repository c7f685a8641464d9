"""A measured record beside computed signals: laid over each other, and how they differ.

Channels are rows of (c, n). What the two clocks differ by, and a scale where it is unknown, is all
that is fitted, one value for all channels; of each channel its zero where that is unknown too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.compare import norms
from contactstudy.exceptions import InputError

METHOD = "largest correlation of all channels together, to a part of a sample"
"""How `aligned` finds the shift."""
_SHARE = 0.5  # of the shorter of two records, that must lie over the other
_REVERSED = 0.5  # correlation of a reversed channel, at least
_CLEARLY = 0.3  # by which it is above that of the channel as it is, each at its own shift


@dataclass(frozen=True)
class Alignment:
    """Record time plus `shift` [s] is the run's; `scale` times the computed is the measured.

    `zero` (c,) is what the channels read without load, and is taken off them; () where they read 0.
    """

    shift: float
    scale: float
    zero: tuple[float, ...] = ()


@dataclass(frozen=True)
class Overlay:
    """Signals at the same times (n,) of the run [s], both (c, n)."""

    time: Array
    computed: Array
    measured: Array


def aligned(
    computed: tuple[Array, Array],
    measured: tuple[Array, Array],
    shift: float | None = None,
    scale: float | None = None,
    zero: bool = False,
) -> Alignment:
    """Shift and scale that lay a record over computed signals; what is given is kept.

    Both are times (n,) that increase [s] and channels (c, n). The shift is that of the largest
    correlation coefficient over the common time, all channels taken together, of all shifts at
    which at least half of the shorter one is covered. The scale is that of least squares there,
    with `zero` together with a constant of each channel.

    Raises
    ------
    InputError
        If there is no common time, or a signal is zero there.
    """
    if shift is None:
        shift = _best_shift(computed, measured)
    over = overlaid(computed, measured, Alignment(shift, 1.0))
    energy = float(np.sum(over.computed**2))
    if not energy > 0.0 or not np.any(over.measured):
        raise InputError("the computed or the measured signals are zero over the common time")
    middle = [rows.mean(axis=1, keepdims=True) * zero for rows in (over.computed, over.measured)]
    if scale is None:
        a, b = over.computed - middle[0], over.measured - middle[1]
        scale = float(np.sum(a * b)) / float(np.sum(a**2))
    left = (middle[1] - scale * middle[0])[:, 0]
    return Alignment(shift, scale, tuple(left.tolist()) if zero else ())


def overlaid(
    computed: tuple[Array, Array], measured: tuple[Array, Array], found: Alignment
) -> Overlay:
    """Both at the record's samples within the run's time, the computed scaled, without zeros.

    Raises
    ------
    InputError
        If fewer than three samples are common.
    """
    (t, a), (t_record, b) = computed, measured
    moved = t_record + found.shift
    inside = (moved >= t[0]) & (moved <= t[-1])
    if np.count_nonzero(inside) < 3:
        raise InputError(
            f"the record has no common time with the run: shifted by {found.shift:.4g} s it goes "
            f"from {moved[0]:.4g} to {moved[-1]:.4g} s, the run from {t[0]:.4g} to {t[-1]:.4g} s"
        )
    at = moved[inside]
    resampled = np.array([np.interp(at, t, row) for row in a])
    zero = np.array(found.zero or [0.0])[:, None]
    return Overlay(at, found.scale * resampled, b[:, inside] - zero)


@dataclass(frozen=True)
class Agreement:
    """How a computed channel agrees with the measured one over the common time.

    Attributes
    ----------
    correlation : float
        Pearson's coefficient.
    peak_ratio : float
        Largest computed over largest measured value, of the measured peak's sign.
    normalised_error : float
        Relative L2 difference.
    sprague_geers : SpragueGeers
        Magnitude and phase error.
    timing : float
        By how much later the computed channel comes, by its own correlation [s].
    """

    correlation: float
    peak_ratio: float
    normalised_error: float
    sprague_geers: norms.SpragueGeers
    timing: float


def agreement(over: Overlay, channel: int) -> Agreement:
    """Of one channel."""
    t, a, b = over.time, over.computed[channel], over.measured[channel]
    sign = 1.0 if b.max() >= -b.min() else -1.0
    return Agreement(
        norms.correlation(a, b, t),
        float(np.max(sign * a) / np.max(sign * b)) if np.any(b) else np.nan,
        norms.relative_l2(a, b, t),
        norms.sprague_geers(a, b, t),
        _best_shift((t, a[None]), (t, b[None])),
    )


def is_reversed(
    computed: tuple[Array, Array], measured: tuple[Array, Array], shift: float, fitted: bool
) -> bool:
    """Whether a channel (1, n) agrees clearly better with the opposite sign.

    That is told at the shift [s]; if it was fitted also with each sign at the shift that suits it,
    for that of all channels together means nothing if many of them are reversed.
    """
    over = overlaid(computed, measured, Alignment(shift, 1.0))
    there = norms.correlation(over.computed, over.measured, over.time) < -_REVERSED
    if not fitted:
        return there
    t, b = measured
    own, opposite = (float(_over_shifts(computed, (t, s * b))[2].max()) for s in (1.0, -1.0))
    return opposite > max(_REVERSED, own if there else own + _CLEARLY)


def _best_shift(computed: tuple[Array, Array], measured: tuple[Array, Array]) -> float:
    lags, step, found = _over_shifts(computed, measured)
    best = int(np.argmax(found))
    # the record begins `lag` samples into the run
    return float(computed[0][0] - measured[0][0] + (lags[best] + _vertex(found, best)) * step)


def _over_shifts(
    computed: tuple[Array, Array], measured: tuple[Array, Array]
) -> tuple[Array, float, Array]:
    """Lags, samples of a step [s] that suits both, and the correlation at each lag."""
    (t, a), (t_record, b) = computed, measured
    step = max(_step(t), _step(t_record))
    grids = [np.arange(x[0], x[-1] + 0.5 * step, step) for x in (t, t_record)]
    ours = np.array([np.interp(grids[0], t, row) for row in a])
    theirs = np.array([np.interp(grids[1], t_record, row) for row in b])
    lags, found = _correlations(ours, theirs)
    return lags, step, found


def _correlations(a: Array, b: Array) -> tuple[Array, Array]:
    """Lags by which b (c, m) begins behind a (c, n), and the correlation over what is common."""
    from scipy.signal import correlate

    n, m = a.shape[1], b.shape[1]
    lags = np.arange(-(m - 1), n)
    ones_a, ones_b = np.ones(n), np.ones(m)

    def summed(x: Array, y: Array) -> Array:
        # sum over k of x[k] y[k - lag], for all lags
        return np.asarray(correlate(x, y, "full", "fft"))

    count = len(a) * np.maximum(summed(ones_a, ones_b).round(), 1.0)
    ab = sum(summed(p, q) for p, q in zip(a, b, strict=True))
    a1, b1 = sum(summed(p, ones_b) for p in a), sum(summed(ones_a, q) for q in b)
    aa, bb = sum(summed(p * p, ones_b) for p in a), sum(summed(ones_a, q * q) for q in b)
    of_a, of_b = aa - a1**2 / count, bb - b1**2 / count
    floor = 1e-9 * float(np.sum(a**2)) * float(np.sum(b**2))
    product = of_a * of_b
    found = np.where(product > floor, (ab - a1 * b1 / count) / np.sqrt(np.maximum(product, floor)),
                     -1.0)  # fmt: skip
    covered = count / len(a) >= _SHARE * min(n, m)
    return lags, np.where(covered, found, -1.0)


def _vertex(y: Array, k: int) -> float:
    """Place of the vertex of the parabola through y[k-1], y[k], y[k+1], from k, at most 1/2."""
    if not 0 < k < len(y) - 1 or min(y[k - 1], y[k + 1]) <= -1.0:
        return 0.0
    bend = y[k - 1] - 2.0 * y[k] + y[k + 1]
    return 0.0 if bend >= 0.0 else float(np.clip(0.5 * (y[k - 1] - y[k + 1]) / bend, -0.5, 0.5))


def _step(t: ArrayLike) -> float:
    return float(np.median(np.diff(np.asarray(t, dtype=float))))

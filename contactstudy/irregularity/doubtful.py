"""What in a measured level may be no rail: single rows far off their neighbours, coarse rounding.

Neither can be told from a bad weld or a very smooth rail with certainty, so both are warnings.
"""

from pathlib import Path

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.irregularity.estimate import spectral_estimate
from contactstudy.irregularity.measured import MeasuredProfile

_FAR = 20.0
"""Robust standard deviations of a row from its neighbours' cubic: sound records reach 14."""
_LEAST = 5e-5  # m: what no wheel feels at the spacing of a level
_SHOWN = 5
_ROWS = 10  # of one value that may stand together, or at the largest
_OFTEN = 10  # stretches of one value are no dead channel
_CUT = 0.01  # share of the rows that may stand at the largest
_COARSE = 0.02  # rounding of all levels, over their range


def doubtful(profile: MeasuredProfile, wavelengths: tuple[float, float]) -> list[str]:
    """Warnings of a level as measured (not band-passed), of which `wavelengths` [m] are used."""
    name = Path(profile.name).name
    quantum = _quantum(profile.levels)
    found = _dead(profile, quantum, wavelengths[0])
    off, spikes = _spikes(profile.levels, max(_LEAST, 2.0 * quantum))
    for k in spikes[:_SHOWN]:
        found.append(
            f"{name}: at X = {profile.positions[k]:.6g} m the level stands {1e3 * abs(off[k]):.3g} "
            "mm off a curve through the rows beside it: a spike of the measurement, or a bad joint?"
        )
    if len(spikes) > _SHOWN:
        found.append(f"{name}: and {len(spikes) - _SHOWN} more such rows")
    step = float(np.median(np.diff(profile.positions)))
    longest = _rounded_below(profile.levels, step, quantum, wavelengths)
    if longest is not None:
        found.append(
            f"{name}: the levels are given in steps of {1e3 * quantum:.3g} mm; waves shorter than "
            f"{longest:.3g} m are for the most part rounding"
        )
    return found


def _dead(profile: MeasuredProfile, quantum: float, shortest: float) -> list[str]:
    """Stretches of one value, longer than the `shortest` wave [m], and levels cut off at a limit.

    Rounded levels have plateaus on their crests: a dead stretch is twice as long as the tenth
    longest, and a level cut off stands at its limit twice as often as a rounded sinusoid,
    ``acos(1 - q/range)/pi`` of the rows.
    """
    x, level, name = profile.positions, profile.levels, Path(profile.name).name
    size = float(np.ptp(level))
    if size == 0.0 or quantum > _COARSE * size:
        return []
    edges = np.flatnonzero(np.diff(level, prepend=np.nan, append=np.nan))
    start, stop = edges[:-1], edges[1:] - 1
    rows = stop - start + 1
    usual = 2 * int(np.sort(rows)[-_OFTEN]) if rows.size > _OFTEN else 0
    long = (rows >= max(_ROWS, usual)) & (x[stop] - x[start] >= shortest)
    found = [
        f"{name}: from X = {x[a]:.6g} to {x[b]:.6g} m all levels are {1e3 * level[a]:.4g} mm: a "
        "dead channel?"
        for a, b in zip(start[long], stop[long], strict=True)
    ]
    found = found[:_SHOWN] + ([f"{name}: and more such stretches"] if long.sum() > _SHOWN else [])
    alive = np.ones(level.size, dtype=bool)
    for a, b in zip(start[long], stop[long], strict=True):
        alive[a : b + 1] = False
    most = max(_ROWS, level.size * max(_CUT, 2.0 * np.arccos(1.0 - quantum / size) / np.pi))
    for limit in (float(level.min()), float(level.max())):
        count = np.count_nonzero(alive & (level == limit))
        if count > most:
            found.append(
                f"{name}: {count} levels are {1e3 * limit:.4g} mm and none is beyond: cut off at "
                "the instrument's limit?"
            )
    return found


def _spikes(level: Array, least: float) -> tuple[Array, IntArray]:
    """How far each level (n,) is off its neighbours' cubic [m], and which rows are spikes."""
    # r_k - (-r_k-2 + 4 r_k-1 + 4 r_k+1 - r_k+2)/6: zero for every cubic
    off = np.zeros(level.shape)
    beside = (4.0 * (level[1:-3] + level[3:-1]) - level[:-4] - level[4:]) / 6.0
    off[2:-2] = level[2:-2] - beside
    size = np.abs(off)
    scatter = 1.4826 * float(np.median(size[2:-2])) if level.size > 4 else np.inf
    # a spike of height 1 is 1 off at its own row and 4/6 at both neighbours
    highest = np.zeros(level.shape, dtype=bool)
    highest[1:-1] = (size[1:-1] >= size[:-2]) & (size[1:-1] > size[2:])
    return off, np.flatnonzero(highest & (size > max(_FAR * scatter, least)))


def _quantum(level: Array) -> float:
    """Of what all levels are multiples [m], beside the first; 0 if they are not rounded."""
    values = np.unique(level)
    if values.size < 2:
        return 0.0
    quantum = float(np.diff(values).min())
    multiples = (values - values[0]) / quantum
    return quantum if np.abs(multiples - np.rint(multiples)).max() < 1e-3 else 0.0


def _rounded_below(
    level: Array, step: float, quantum: float, wavelengths: tuple[float, float]
) -> float | None:
    """Wavelength [m] below which rounding is most of the level, None if it is nowhere.

    Rounding to multiples of q adds noise of variance q^2/12, white up to Nyquist's wavenumber:
    its two-sided density is q^2/12 step/(2 pi) in rad/m.
    """
    if quantum == 0.0 or level.size < 64:
        return None
    # short segments, for a steady estimate of short waves
    estimate = spectral_estimate(level, step, max(level.size // 32, 16) * step)
    noise = quantum**2 / 12.0 * step / (2.0 * np.pi)
    low, high = 2.0 * np.pi / wavelengths[1], 2.0 * np.pi / wavelengths[0]
    used = np.flatnonzero((estimate.wavenumber >= low) & (estimate.wavenumber <= high))
    sound = used[estimate.density[used] > 2.0 * noise]
    if not used.size or (sound.size and sound[-1] == used[-1]):
        return None
    return 2.0 * np.pi / (float(estimate.wavenumber[sound[-1]]) if sound.size else low)

"""Whether a measured level is as large as one can be in the unit that is stated for it.

A factor of a thousand shows in the waves that a record covers, not in its standard deviation alone:
0.5 um is what acoustic roughness has below 0.1 m, and no track has from 3 m on.
"""

from pathlib import Path

import numpy as np

from contactstudy.arrays import Array

SMALLEST = 1e-7
"""Least standard deviation of a level about its trend [m]: polished rails have more."""
LONG, LEAST_LONG = 3.0, 5e-6
"""Waves [m] of which a track has more than this [m rms]: the lower edge of EN 13848's band D1, in
which the smoothest slab tracks have a tenth of a millimetre and straightened rails, before they are
laid, some hundredths. Records of roughness, from which such waves are filtered, are not meant: in
them shorter waves are more."""
SHORT, MOST_SHORT = 0.3, 1e-3
"""Waves [m] of which no rail has so much [m rms]: severe corrugation has a tenth of it, and what a
joint dipped by 10 mm has of them is less."""
_COVERED = 10  # longest of long waves that a record must hold
_LIKELY = {"long": (5e-5, 2e-2), "short": (1e-7, 2e-4)}  # m rms
_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6}


def wrong_size(file: Path, x: Array, level: Array, column: str, unit: tuple[str, float]) -> str:
    """Complaint of a level (n,) in the unit [name, m] at positions (n,) [m]; "" for none."""
    name, metre = unit
    if not np.ptp(level):
        return ""
    about, long, short = _of_waves(x, level * metre)
    told = f"{file}, column '{column}', read in {name}"
    if about < SMALLEST:
        return (
            f"{told}, has a standard deviation of {1e6 * about:.3g} um; allowed: at least "
            f"{1e6 * SMALLEST:g} um (is the unit right?)"
        )
    covered = float(x[-1] - x[0]) >= _COVERED * LONG
    if covered and long < LEAST_LONG and long**2 > 0.5 * about**2:
        return (
            f"{told}, has waves longer than {LONG:g} m of {1e6 * long:.3g} um rms; allowed: at "
            f"least {1e6 * LEAST_LONG:g} um; tracks have 0.1 to 10 mm"
            f"{_fitting(long, metre, 'long')}"
        )
    if short > MOST_SHORT:
        return (
            f"{told}, has waves shorter than {SHORT:g} m of {1e3 * short:.3g} mm rms; allowed: at "
            f"most {1e3 * MOST_SHORT:g} mm; rails have 0.1 to 200 um"
            f"{_fitting(short, metre, 'short')}"
        )
    return ""


def _fitting(rms: float, metre: float, waves: str) -> str:
    """In which unit the size would be a likely one."""
    low, high = _LIKELY[waves]
    fit = [name for name, one in _METRES.items() if low <= rms * one / metre <= high]
    return f" (is the unit {' or '.join(fit)}?)" if fit else " (is the unit right?)"


def _of_waves(x: Array, level: Array) -> tuple[float, float, float]:
    """Root mean squares [m] of a level (n,) about its trend, of its long and its short waves."""
    with np.errstate(
        over="ignore", invalid="ignore"
    ):  # values beyond all sense are named elsewhere
        level = level - np.polyval(np.polyfit(x, level, 1), x)
        about = float(np.std(level))
        spacing = float(np.median(np.diff(x)))
        count = min(round((x[-1] - x[0]) / spacing), 4 * len(x))  # rows may stand in clusters
        even = np.linspace(x[0], x[-1], count + 1)
        # Parseval: of a real series both signs count
        power = 2.0 * np.abs(np.fft.rfft(np.interp(even, x, level)) / len(even)) ** 2
        waves = np.fft.rfftfreq(len(even), float(even[1] - even[0]))
        long, short = (waves > 0.0) & (waves < 1.0 / LONG), waves > 1.0 / SHORT
        return about, float(np.sqrt(power[long].sum())), float(np.sqrt(power[short].sum()))

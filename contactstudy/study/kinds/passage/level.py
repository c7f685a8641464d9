"""The level of a study's irregularity along its track, as Fig. 1b shows it."""

from __future__ import annotations

import numpy as np

from contactstudy import irregularity as irr
from contactstudy.irregularity.shown import Level
from contactstudy.study.kinds.passage.schema import Study

PROFILE_STEP = 0.01  # m
DEFECT_STEP = 0.001  # m, where there are defects
_MOST = 1_000_000  # positions


def sampled(study: Study, profile: irr.Profile) -> Level:
    """The profile over the track, as far as it is known."""
    low, high = profile.domain
    start, end = max(low, 0.0), min(high, study.track.length)
    table, step, label = study.irregularity, PROFILE_STEP, "measured profile"
    if table.spectrum == "sinusoid":
        step = min(step, table.wavelength / 20)
        label = f"sinusoid, {1e3 * table.wavelength:.4g} mm"
    elif table.spectrum == "smooth":
        label = "smooth rail"
    elif table.spectrum != "measured":
        label = f"{table.spectrum.replace('_', ' ')}, seed {table.seed}"
    defects = [name for name in table.defects if name != "none"]
    if defects:
        step = min(step, DEFECT_STEP)
        label += f", with {' and '.join(name.replace('_', ' ') for name in defects)}"
    count = min(_MOST, max(2, round((end - start) / step) + 1))
    position = np.linspace(start, end, count)
    return Level(label, position, profile(position), deviations(table, profile))


def deviations(table: irr.Irregularity, profile: irr.Profile) -> str:
    """Standard deviation of a generated profile in the bands of EN 13848, "" for any other."""
    if not (table.generated and isinstance(profile, irr.HarmonicProfile)):
        return ""
    return ", ".join(map(str, irr.band_deviations(profile, table.band)))

"""Where along the scale of wavelengths the error of a scheme lies."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from contactstudy.compare.bands import SHORTEST_RECORD
from contactstudy.compare.signals import dynamic, side_by_side
from contactstudy.irregularity.estimate import third_octave_levels

if TYPE_CHECKING:
    import xarray as xr

_MOST = 0.5  # of the mean square, which the waves named hold at least


@dataclass(frozen=True)
class Waves:
    """Neighbouring third octaves with most of a signal: shortest and longest wave [m], share."""

    shortest: float
    longest: float
    share: float


def waves(run: xr.Dataset, reference: xr.Dataset, start: float) -> Waves | None:
    """The fewest neighbouring third octaves with half of the mean square of the difference.

    Of two contact forces, without their static values, behind the position `start` [m]; None for
    a difference that is zero or too short.
    """
    x, a, b = side_by_side(run, reference, partial(dynamic, name="contact_force"), start)
    if len(x) < SHORTEST_RECORD:
        return None
    bands = third_octave_levels(a - b, float(x[-1] - x[0]) / (len(x) - 1), reference=1.0)
    total = np.concatenate([[0.0], np.cumsum(bands.mean_square)])
    if not total[-1] > 0.0:
        return None
    for n in range(1, len(total)):
        share = (total[n:] - total[:-n]) / total[-1]
        k = int(share.argmax())
        if share[k] >= _MOST:
            edge = 10.0**0.05
            long, short = bands.wavelength[k] * edge, bands.wavelength[k + n - 1] / edge
            return Waves(float(short), float(long), float(share[k]))
    return None

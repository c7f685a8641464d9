"""Standard deviation in the wavelength bands of EN 13848."""

from dataclasses import dataclass

import numpy as np

from contactstudy.irregularity.profile import HarmonicProfile

BANDS = {"D0": (1.0, 3.0), "D1": (3.0, 25.0), "D2": (25.0, 70.0), "D3": (70.0, 150.0)}
"""Wavelengths [m] of the bands: D1 to D3 of EN 13848-1, and D0, which some texts add."""


@dataclass(frozen=True)
class BandDeviation:
    """Standard deviation [m] of the waves of a band, from `shortest` to `longest` [m].

    Where a profile covers part of the band these are the ends of that part.
    """

    band: str
    shortest: float
    longest: float
    deviation: float

    def __str__(self) -> str:
        part = "" if (self.shortest, self.longest) == BANDS[self.band] else "part of "
        return (
            f"{part}{self.band} ({self.shortest:.3g} to {self.longest:.3g} m) "
            f"{1e3 * self.deviation:.3g} mm"
        )


def band_deviations(
    profile: HarmonicProfile, wavenumbers: tuple[float, float]
) -> list[BandDeviation]:
    """Standard deviation of a generated profile in each band that it has waves of.

    sqrt(sum a_k^2/2) over the band; each term stands for its equal part of the wavenumbers from the
    first to the second [rad/m], and counts as far as that lies in the band.
    """
    edges = np.linspace(*wavenumbers, profile.wavenumbers.size + 1)
    ends = 2.0 * np.pi / wavenumbers[1], 2.0 * np.pi / wavenumbers[0]
    found = []
    for name, (low, high) in BANDS.items():
        inside = np.clip(edges, 2.0 * np.pi / high, 2.0 * np.pi / low)
        share = np.diff(inside) / np.diff(edges)
        if share.any():
            deviation = float(np.sqrt(0.5 * np.sum(share * profile.amplitudes**2)))
            found.append(BandDeviation(name, max(low, ends[0]), min(high, ends[1]), deviation))
    return found

"""Runs of one study at several levels of refinement, and how far they are from each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from contactstudy.arrays import Array
from contactstudy.compare import norms
from contactstudy.compare.refinement import convergence

BAND = 500.0
"""Hz. Table 1's roughness ends at 265 Hz at 300 km/h; what the contact force has above comes from
the discretisation: the rail's interface planes pass at 833 Hz and its multiples, and points enter
and leave the patch."""

QUANTITIES = (
    "contact force",
    "its dynamic part",
    f"dynamic part below {BAND:g} Hz",
    "peak pressure",
    "mean of the peak pressure",
)


@dataclass(frozen=True)
class Refinement:
    """Runs at several levels, coarsest first.

    Attributes
    ----------
    levels : tuple of float
        Value of what is refined.
    sizes : tuple of float
        What goes to zero: mesh size, time step, reciprocal of the penalty or of the number of
        modes; decreasing.
    default : int
        Level that has the program's default.
    algebraic : bool
        An error like a power of the size is expected.
    """

    levels: tuple[float, ...]
    sizes: tuple[float, ...]
    default: int
    runs: tuple[xr.Dataset, ...]
    algebraic: bool = True

    @property
    def against_finest(self) -> Array:
        """Differences of all levels but the last from the last, (levels - 1, quantities)."""
        return np.array([differences(run, self.runs[-1]) for run in self.runs[:-1]])

    @property
    def steps(self) -> Array:
        """Differences of neighbouring levels, (levels - 1, quantities)."""
        pairs = zip(self.runs[:-1], self.runs[1:], strict=True)
        return np.array([differences(a, b) for a, b in pairs])

    @property
    def orders(self) -> Array:
        """Observed order of each three neighbouring levels, (levels - 2, quantities).

        `compare.refinement` with the values 0, e21, e21 + e32, from the steps between the
        levels; nan where they do not become smaller.
        """
        steps, found = self.steps, np.full((len(self.runs) - 2, len(QUANTITIES)), np.nan)
        for k in range(len(found)):
            sizes = tuple(reversed(self.sizes[k : k + 3]))
            for q in range(len(QUANTITIES)):
                e32, e21 = steps[k, q], steps[k + 1, q]
                found[k, q] = convergence(sizes, (0.0, e21, e21 + e32)).order
        return found

    @property
    def left_at_default(self) -> Array:
        """Estimate of the error at the default, (quantities,).

        The difference from the finest level, and what that one has itself: with the last
        observed order p of one half at least ``e21/(r^p - 1)``, else e21.
        """
        e21, ratio = self.steps[-1], self.sizes[-2] / self.sizes[-1]
        p = self.orders[-1]
        clean = np.nan_to_num(p) >= 0.5 if self.algebraic else np.zeros(len(p), dtype=bool)
        own = e21 / np.where(clean, ratio ** np.where(clean, p, 1.0) - 1.0, 1.0)
        return np.asarray(np.append(self.against_finest, [0.0 * e21], axis=0)[self.default] + own)


def differences(run: xr.Dataset, reference: xr.Dataset) -> tuple[float, ...]:
    """How far a run is from another, for each of `QUANTITIES`.

    Relative L2 over the positions that both have, after the fade-in; for the dynamic part
    relative to it; the last is the relative difference of the means.
    """
    a, b = common(run, reference)
    x, static = b.position.values, np.float64(np.ravel(b.attrs["static_load"])[0])
    force, other = a.contact_force.values, b.contact_force.values
    p, q = a.peak_pressure.values, b.peak_pressure.values
    time = b.time.values
    return (
        norms.relative_l2(force, other, x),
        norms.relative_l2_dynamic(force, other, x, static, static),
        _below(force - other, time) / _below(other - static, time),
        norms.relative_l2(p, q, x),
        abs(float(p.mean() / q.mean()) - 1.0),
    )


def common(a: xr.Dataset, b: xr.Dataset) -> tuple[xr.Dataset, xr.Dataset]:
    """Both runs at the positions that both have, after the fade-in."""
    # positions are multiples of speed x time step: equal to rounding, or millimetres apart
    keys = [np.round(data.position.values * 1e8).astype(np.int64) for data in (a, b)]
    _, *rows = np.intersect1d(*keys, return_indices=True)
    start = float(a.position[0]) + float(a.attrs["fade_in"])
    late = a.position.values[rows[0]] >= start
    return a.isel(time=rows[0][late]), b.isel(time=rows[1][late])


def _below(signal: Array, time: Array) -> float:
    """Norm of the components below `BAND`, of the signal under a Hann window."""
    spectrum = np.fft.rfft(np.hanning(len(signal)) * signal)
    frequency = np.fft.rfftfreq(len(signal), time[1] - time[0])
    return float(np.linalg.norm(spectrum[frequency < BAND]))

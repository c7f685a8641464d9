"""Measured profiles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.irregularity.band_pass import band_passed
from contactstudy.irregularity.plausible import implausible, other_unit
from contactstudy.irregularity.profile import check_derivative
from contactstudy.irregularity.table import read_columns
from contactstudy.validation import raise_if

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6}
Interpolation = Literal["cubic", "linear"]
_DEGREE = {"cubic": 3, "linear": 1}


@dataclass(frozen=True, eq=False)
class MeasuredProfile:
    """Level given at positions, interpolated between them.

    Parameters
    ----------
    positions, levels : ndarray, shape (n,)
        Increasing positions X along the track [m]; levels, positive upwards [m].
    interpolation
        Cubic spline (not-a-knot ends, second derivative continuous), or straight lines, which
        have no second derivative.
    wavelengths
        Shortest and longest wavelength that the levels contain [m]; None if not filtered.
    name
        For messages and legends.
    """

    repeat_length = np.inf
    positions: Array
    levels: Array
    interpolation: Interpolation = "cubic"
    wavelengths: tuple[float, float] | None = None
    name: str = "measured profile"

    @property
    def domain(self) -> tuple[float, float]:
        """First and last position [m]."""
        return float(self.positions[0]), float(self.positions[-1])

    @property
    def sound(self) -> tuple[float, float]:
        """Positions between which the band-pass has settled [m]; low > high if it never does.

        What lies beyond the record's ends is unknown to it: over the longest wavelength from an end
        the level is wrong by its own size at first and by a twelfth of it in the end (RMS over
        records of steep spectrum, cut, against the same records whole).
        """
        margin = 0.0 if self.wavelengths is None else self.wavelengths[1]
        return self.domain[0] + margin, self.domain[1] - margin

    @cached_property
    def _spline(self) -> BSpline:
        from scipy.interpolate import make_interp_spline

        return make_interp_spline(self.positions, self.levels, k=_DEGREE[self.interpolation])

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value or derivative at positions x of any shape [m, 1, 1/m].

        Raises
        ------
        InputError
            For positions that the measurement does not cover, or the second derivative of
            straight lines.
        """
        check_derivative(derivative)
        if derivative == 2 and self.interpolation == "linear":
            raise InputError(f"{self.name}: linear interpolation has no second derivative")
        position = np.asarray(x, dtype=float)
        if position.size:
            ends = float(position.min()), float(position.max())
            raise_if(_uncovered(self.name, self.domain, *ends))
        inside = np.clip(position, *self.domain)  # a rounding error beyond the last position
        return np.asarray(self._spline(inside, nu=derivative), dtype=float)


def measured_profile(
    path: str | Path,
    level_column: str,
    level_unit: str,
    *,
    x_column: str = "x",
    origin: float = 0.0,
    wavelengths: tuple[float, float] | None = None,
    interpolation: Interpolation = "cubic",
    required: tuple[float, float] | None = None,
) -> MeasuredProfile:
    """Profile from a CSV file.

    Parameters
    ----------
    level_column, level_unit : str
        Column of the level, positive upwards, and its unit: m, mm or um.
    x_column : str
        Column of the position in m.
    origin : float
        Position in the file that is X = 0 of the track, e.g. the chainage 98000 m.
    wavelengths : tuple of float, optional
        Keep wavelengths between these two only [m]: Butterworth band-pass of fourth order run
        forwards and backwards, so without phase; both edges are damped by 6 dB.
    interpolation : {"cubic", "linear"}
        Between the positions, and to equal spacing before the filter if they are uneven.
    required : tuple of float, optional
        Range of X that has to be covered [m].

    Raises
    ------
    InputError
        With every fault of the file and the arguments, by file, line and column; the rules for
        gaps and values are in `contactstudy.irregularity.plausible`.
    """
    file = Path(path)
    problems = []
    if level_unit not in UNITS:
        problems.append(f"{file}: level unit is '{level_unit}'; allowed: m, mm, um")
    if interpolation not in _DEGREE:
        problems.append(f"{file}: interpolation is '{interpolation}'; allowed: cubic, linear")
    if not np.isfinite(origin):
        problems.append(f"{file}: origin is {origin} m; allowed: a finite position")
    if wavelengths is not None and not 0.0 < wavelengths[0] < wavelengths[1] < np.inf:
        problems.append(f"{file}: wavelengths are {wavelengths} m; allowed: 0 < shortest < longest")
    problems += other_unit(file, x_column, "m")
    if level_unit in UNITS:
        problems += other_unit(file, level_column, level_unit)
    try:
        x, level, lines = read_columns(file, (x_column, level_column))
    except InputError as error:
        raise InputError([*error.problems, *problems]) from None
    if level_unit in UNITS:
        shortest = None if wavelengths is None else wavelengths[0]
        unit = level_unit, UNITS[level_unit]
        problems += implausible(file, x, level, lines, level_column, unit, shortest)
    x = x - origin
    if required is not None:
        problems += _uncovered(str(file), (float(x[0]), float(x[-1])), *required)
    raise_if(problems)
    level = level * UNITS[level_unit]
    if wavelengths is not None:
        x, level = band_passed(file, x, level, wavelengths, _DEGREE[interpolation])
    return MeasuredProfile(x, level, interpolation, wavelengths, str(file))


def _uncovered(name: str, domain: tuple[float, float], start: float, end: float) -> list[str]:
    low, high = domain
    slack = 1e-9 * max(abs(low), abs(high), 1.0)
    if low - slack <= start and end <= high + slack:
        return []
    return [
        f"{name}: positions X from {start:g} m to {end:g} m are wanted; the file "
        f"covers {low:g} m to {high:g} m ('origin' is the file's position at X = 0)"
    ]

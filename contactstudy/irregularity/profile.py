"""What an irregularity is: a function of the position along the rail, with derivatives."""

import warnings
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from contactstudy.arrays import Array
from contactstudy.exceptions import InputError
from contactstudy.irregularity.kernels import direct_sum, equally_spaced_sum

EVERYWHERE = (-np.inf, np.inf)


class Profile(Protocol):
    """Irregularity r(X): positive raises the running surface."""

    @property
    def domain(self) -> tuple[float, float]:
        """Positions between which the profile is known [m]."""

    @property
    def repeat_length(self) -> float:
        """Length after which the profile repeats, or nearly so; infinite if it does not [m]."""

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value or derivative (0, 1 or 2) at positions of any shape [m, 1, 1/m].

        Raises
        ------
        InputError
            For another order of derivative, or positions outside ``domain``.
        """


class RepeatWarning(UserWarning):
    """A study runs longer than its irregularity takes to repeat itself."""


@dataclass(frozen=True)
class SmoothRail:
    """No irregularity."""

    domain = EVERYWHERE
    repeat_length = np.inf

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Zero at every position."""
        check_derivative(derivative)
        return np.zeros(np.shape(x))


@dataclass(frozen=True, eq=False)
class HarmonicProfile:
    """Sum of cosines, eq. (1): r(X) = sum a_k cos(omega_k X + phi_k).

    It is fixed by its terms and never by a sampling grid: the same position gives the same
    value, whatever other positions are asked for.

    Amplitudes a_k (n,) [m], wavenumbers omega_k (n,) [rad/m], phases phi_k (n,) [rad].

    Raises
    ------
    InputError
        If the three differ in length or are empty.
    """

    domain = EVERYWHERE
    amplitudes: Array
    wavenumbers: Array
    phases: Array

    def __post_init__(self) -> None:
        for name in ("amplitudes", "wavenumbers", "phases"):
            value = np.array(getattr(self, name), dtype=float, ndmin=1)
            value.flags.writeable = False
            object.__setattr__(self, name, value)
        shapes = {self.amplitudes.shape, self.wavenumbers.shape, self.phases.shape}
        if len(shapes) != 1 or self.amplitudes.ndim != 1 or self.amplitudes.size == 0:
            raise InputError(
                "harmonic profile: amplitudes, wavenumbers and phases must be equally long "
                f"lists of at least one number; their shapes are {sorted(shapes)}"
            )

    @classmethod
    def wave(cls, amplitude: float, wavelength: float, phase: float = 0.0) -> "HarmonicProfile":
        """One cosine of given amplitude [m], wavelength [m] and phase at X = 0 [rad]."""
        return cls(np.array([amplitude]), np.array([2.0 * np.pi / wavelength]), np.array([phase]))

    @cached_property
    def spacing(self) -> float | None:
        """Common distance of the wavenumbers [rad/m]; None if they are not equally spaced."""
        if self.wavenumbers.size < 2:
            return None
        step = np.diff(self.wavenumbers)
        mean = float(self.wavenumbers[-1] - self.wavenumbers[0]) / step.size
        # no more than the wavenumbers' own rounding, which the phases cannot tell apart
        rounding = 8.0 * np.finfo(float).eps * float(np.abs(self.wavenumbers).max())
        return mean if mean > 0.0 and np.abs(step - mean).max() < rounding else None

    @property
    def repeat_length(self) -> float:
        """2 pi/spacing [m], where all terms have turned by the same angle (modulo 2 pi).

        There r differs from the start only by that common angle 2 pi omega_1/spacing. With
        Table 1 it is 315.4 m and an angle near pi: r(X + 315.4) is almost -r(X).
        """
        return np.inf if self.spacing is None else 2.0 * np.pi / self.spacing

    @property
    def rms(self) -> float:
        """Root mean square over an infinite length [m]: sqrt(sum a_k^2/2)."""
        return float(np.sqrt(0.5 * np.sum(self.amplitudes**2)))

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Array:
        """Value or derivative at positions x of any shape [m, 1, 1/m]."""
        check_derivative(derivative)
        position = np.asarray(x, dtype=float)
        flat = np.ascontiguousarray(position).ravel()
        out = np.empty_like(flat)
        # d^n/dX^n cos(omega X + phi) = omega^n cos(omega X + phi + n pi/2)
        amplitude = self.amplitudes * self.wavenumbers**derivative
        phase = self.phases + derivative * (np.pi / 2.0)
        if self.spacing is not None:
            real, imag = amplitude * np.cos(phase), amplitude * np.sin(phase)
            equally_spaced_sum(flat, self.wavenumbers[0], self.spacing, real, imag, out)
        else:
            cycles = self.wavenumbers / (2.0 * np.pi)
            direct_sum(flat, cycles, phase / (2.0 * np.pi), amplitude, out)
        return out.reshape(position.shape)


def check_repeat(profile: Profile, length: float) -> bool:
    """Warn (`RepeatWarning`) if a study of this length [m] sees the same irregularity again."""
    repeat = profile.repeat_length
    if length <= repeat:
        return False
    warnings.warn(
        f"the study covers {length:.1f} m, but the irregularity nearly repeats itself (up to a "
        f"common phase) every {repeat:.1f} m because its wavenumbers are equally spaced; "
        "use jittered wavenumbers or more terms",
        RepeatWarning,
        stacklevel=2,
    )
    return True


def check_derivative(derivative: int) -> None:
    """Refuse orders of derivative other than 0, 1 and 2 with an ``InputError``."""
    if derivative not in (0, 1, 2):
        raise InputError(f"derivative {derivative} of an irregularity; allowed: 0, 1, 2")

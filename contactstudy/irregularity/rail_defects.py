"""Defects at one place of the rail: joint, weld, corrugation, difference in height.

Each is a level r(X), positive upwards, uniform across the rail, and is not faded in.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from contactstudy.arrays import Array
from contactstudy.irregularity.shapes import haversine, smoothstep
from contactstudy.validation import Key, Naming, Parameters, Usual, Variants, complaint
from contactstudy.validation import quantities as q


@dataclass(frozen=True)
class RailDefect(Parameters, ABC):
    """What all defects of the rail have."""

    at: Annotated[q.LengthOrZero, Key("rail_defect_at"), "X of its middle, or of the step"] = 12.0

    @property
    @abstractmethod
    def half_length(self) -> float:
        """How far it reaches to either side of `at` [m]."""

    @property
    def last(self) -> float:
        """Where it ends [m]."""
        return self.at + self.half_length

    @abstractmethod
    def level(self, x: Array) -> Array:
        """The running surface (...) at distances x (...) from `at`, both in m."""

    def __call__(self, x: Array) -> Array:
        """The running surface (...) at positions X (...), both in m."""
        return self.level(np.asarray(x, dtype=float) - self.at)


@dataclass(frozen=True)
class _LongDefect(RailDefect):
    length: Annotated[q.Length, Key("rail_defect_length"), "length from end to end"] = 1.0

    @property
    def half_length(self) -> float:
        """Half of the length."""
        return 0.5 * self.length


@dataclass(frozen=True)
class DippedJoint(_LongDefect):
    """Two rail ends that dip to their joint and meet there in a cusp.

    From the ends ``r = -d (1 - cos(pi u/l))``, u being the distance from the end: it leaves the
    level smoothly, and meets the other rail under the angle ``2 alpha = 2 pi d/l`` of the P1 and
    P2 formulas (the shape of STEM's rail joint).
    """

    depth: Annotated[q.Length, Usual(1e-5, 0.02), Key("rail_defect_depth"), "at the joint"] = 0.002

    @property
    def angle(self) -> float:
        """Total angle 2 alpha of the cusp [rad]."""
        return 2.0 * np.pi * self.depth / self.length

    def level(self, x: Array) -> Array:
        """See `RailDefect`."""
        u = np.maximum(self.half_length - np.abs(x), 0.0)
        return -self.depth * (1.0 - np.cos(np.pi * u / self.length))


@dataclass(frozen=True)
class Weld(_LongDefect):
    """A weld that stands up, or is ground too low: ``r = h/2 (1 + cos(2 pi x/l))``."""

    height: Annotated[
        q.Position, Usual(1e-6, 0.01), Key("rail_defect_height"), "of the weld or step, up"
    ] = 0.0003

    def level(self, x: Array) -> Array:
        """See `RailDefect`."""
        return self.height * haversine(x, self.length)


@dataclass(frozen=True)
class Corrugation(_LongDefect):
    """A stretch of corrugated rail, a cosine that grows and ends within one wavelength."""

    wavelength: Annotated[q.Length, Key("rail_defect_wavelength"), "of the corrugation"] = 0.05
    amplitude: Annotated[
        q.Length, Usual(1e-7, 2e-3), Key("rail_defect_amplitude"), "half from crest to trough"
    ] = 2.5e-5

    def problems(self, key: Naming) -> list[str]:
        """Too short to grow and to end."""
        if self.length >= 2.0 * self.wavelength:
            return []
        allowed = f"must be at least two wavelengths, {2.0 * self.wavelength:g} m"
        return [complaint(key("length"), self.length, allowed)]

    def level(self, x: Array) -> Array:
        """See `RailDefect`; it grows by `shapes.smoothstep`."""
        grown = smoothstep((self.half_length - np.abs(x)) / self.wavelength)
        return np.asarray(self.amplitude * grown * np.cos(2.0 * np.pi * x / self.wavelength))


@dataclass(frozen=True)
class Step(RailDefect):
    """A difference in height of two rail ends; behind it the rail stays at the new height."""

    height: Annotated[
        q.Position, Usual(1e-6, 0.01), Key("rail_defect_height"), "of the weld or step, up"
    ] = 0.0003
    half_length = 0.0

    def level(self, x: Array) -> Array:
        """See `RailDefect`."""
        return np.where(x >= 0.0, self.height, 0.0)


RAIL_DEFECTS = Variants(
    "rail_defect",
    {
        "none": None,
        "dipped_joint": DippedJoint,
        "weld": Weld,
        "corrugation": Corrugation,
        "step": Step,
    },
    "defect at one place of the rail, on top of the spectrum",
)

"""What the track is: rail, supports, length and ends, as frozen data.

The beam and the solid discretisation are both built from one `Track`. Values are per rail
(half a track) and SI. The default supports are the ballasted track of W. M. Zhai, K. Y. Wang
and J. H. Lin, J. Sound Vib. 270 (2004) 673, per rail seat.
"""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from contactstudy.track.rail import Direction, Rail
from contactstudy.validation import not_negative, one_of, positive, raise_if

Ends = Literal["clamped", "pinned", "free"]

NOMINAL_BAY = 0.6
"""m, length that is called a bay where the track has no discrete supports."""


@dataclass(frozen=True)
class Ballast:
    """Spring and damper from each half sleeper to the ground.

    Parameters
    ----------
    stiffness, damping : float
        Vertical, per rail seat [N/m], [N s/m].
    lateral_stiffness, lateral_damping : float
        The same for lateral motion of the sleeper.
    """

    stiffness: float = 137.75e6
    damping: float = 58.8e3
    lateral_stiffness: float = 50e6
    lateral_damping: float = 40e3

    def __post_init__(self) -> None:
        raise_if(
            positive("ballast stiffness", self.stiffness, "N/m")
            + not_negative("ballast damping", self.damping, "N s/m")
            + positive("ballast lateral_stiffness", self.lateral_stiffness, "N/m")
            + not_negative("ballast lateral_damping", self.lateral_damping, "N s/m")
        )


@dataclass(frozen=True)
class Slab:
    """A continuous slab: Euler beam with free ends on a uniform viscoelastic bed.

    A half sleeper, if any, is cast into the slab: its mass is lumped there.

    Parameters
    ----------
    bending_stiffness : float
        EI of half the slab, vertical bending [N m^2].
    mass_per_length : float
        Of half the slab [kg/m].
    stiffness, damping : float
        Of the bed under half the slab, per length [N/m^2], [N s/m^2].
    lateral_bending_stiffness, lateral_stiffness, lateral_damping : float
        The same for lateral motion.
    """

    bending_stiffness: float = 60e6
    mass_per_length: float = 730.0
    stiffness: float = 625e6
    damping: float = 83e3
    lateral_bending_stiffness: float = 1e9
    lateral_stiffness: float = 300e6
    lateral_damping: float = 83e3

    def __post_init__(self) -> None:
        raise_if(
            positive("slab bending_stiffness", self.bending_stiffness, "N m^2")
            + positive("slab mass_per_length", self.mass_per_length, "kg/m")
            + positive("slab stiffness", self.stiffness, "N/m^2")
            + not_negative("slab damping", self.damping, "N s/m^2")
            + positive("slab lateral_bending_stiffness", self.lateral_bending_stiffness, "N m^2")
            + positive("slab lateral_stiffness", self.lateral_stiffness, "N/m^2")
            + not_negative("slab lateral_damping", self.lateral_damping, "N s/m^2")
        )


@dataclass(frozen=True)
class DiscreteSupports:
    """Rail seats at X = j * spacing: pad, half sleeper, and the layer below.

    The pad acts on the average rail displacement over its footprint, which is cut off where the
    track ends; the pad's whole stiffness is kept there.

    Parameters
    ----------
    spacing : float
        [m].
    pad_stiffness, pad_damping : float
        Vertical, per seat [N/m], [N s/m].
    pad_length : float
        Length of the footprint along the rail [m]; 0 is a point support.
    sleeper_mass : float
        Half sleeper [kg].
    layer : Ballast or Slab
    lateral_pad_stiffness, lateral_pad_damping : float
        Per seat, for lateral motion of the rail against the sleeper [N/m], [N s/m].
    """

    spacing: float = 0.6
    pad_stiffness: float = 65e6
    pad_damping: float = 75e3
    pad_length: float = 0.16
    sleeper_mass: float = 125.5
    layer: Ballast | Slab = field(default_factory=Ballast)
    lateral_pad_stiffness: float = 20e6
    lateral_pad_damping: float = 50e3

    def __post_init__(self) -> None:
        problems = (
            positive("support spacing", self.spacing, "m")
            + positive("pad_stiffness", self.pad_stiffness, "N/m")
            + not_negative("pad_damping", self.pad_damping, "N s/m")
            + not_negative("pad_length", self.pad_length, "m")
            + not_negative("sleeper_mass", self.sleeper_mass, "kg")
            + positive("lateral_pad_stiffness", self.lateral_pad_stiffness, "N/m")
            + not_negative("lateral_pad_damping", self.lateral_pad_damping, "N s/m")
        )
        if self.pad_length >= self.spacing > 0.0:
            problems.append(
                f"pad_length = {self.pad_length:g} m: must be below the support spacing,"
                f" {self.spacing:g} m"
            )
        raise_if(problems)


@dataclass(frozen=True)
class WinklerFoundation:
    """Uniform springs and dampers under the rail.

    Parameters
    ----------
    stiffness, damping : float
        Vertical, per length [N/m^2], [N s/m^2].
    lateral_stiffness, lateral_damping : float, optional
        The same for lateral motion; as vertical when not given.
    """

    stiffness: float
    damping: float = 0.0
    lateral_stiffness: float | None = None
    lateral_damping: float | None = None

    def __post_init__(self) -> None:
        problems = positive("foundation stiffness", self.stiffness, "N/m^2") + not_negative(
            "foundation damping", self.damping, "N s/m^2"
        )
        if self.lateral_stiffness is not None:
            problems += positive("foundation lateral_stiffness", self.lateral_stiffness, "N/m^2")
        if self.lateral_damping is not None:
            problems += not_negative("foundation lateral_damping", self.lateral_damping, "N s/m^2")
        raise_if(problems)

    def values(self, direction: Direction = "Z") -> tuple[float, float]:
        """Stiffness [N/m^2] and damping [N s/m^2] per length in the direction given."""
        stiffness, damping = self.stiffness, self.damping
        if direction == "Y":
            stiffness = stiffness if self.lateral_stiffness is None else self.lateral_stiffness
            damping = damping if self.lateral_damping is None else self.lateral_damping
        return stiffness, damping

    def foot_values(self) -> tuple[tuple[float, float], ...]:
        """Stiffness and damping per length against vertical, lateral and roll motion of a foot.

        Roll is the rise of the foot's edge: springs spread evenly over the width b give
        ``integral of (k/b) (2y/b)^2 dy = k/3``.
        """
        k, c = self.values("Z")
        return (k, c), self.values("Y"), (k / 3, c / 3)


Support = DiscreteSupports | WinklerFoundation | None


@dataclass(frozen=True)
class Track:
    """One rail on its supports, from X = 0 to X = length.

    Parameters
    ----------
    rail : Rail
    support : DiscreteSupports, WinklerFoundation or None
        None: nothing but the ends carries the rail (a beam).
    length : float
        [m]; with discrete supports a whole number of spacings.
    ends : {"clamped", "pinned", "free"}
        Condition of the rail at both ends.
    """

    rail: Rail = field(default_factory=Rail)
    support: Support = field(default_factory=DiscreteSupports)
    length: float = 36.0
    ends: Ends = "clamped"

    def __post_init__(self) -> None:
        problems = positive("track length", self.length, "m") + one_of(
            "track ends", self.ends, ("clamped", "pinned", "free")
        )
        if isinstance(self.support, DiscreteSupports) and not problems:
            bays = self.length / self.support.spacing
            if round(bays) < 1 or abs(bays - round(bays)) > 1e-9 * bays:
                problems.append(
                    f"track length = {self.length:g} m: must be a whole number of support"
                    f" spacings of {self.support.spacing:g} m"
                )
        if self.support is None and self.ends == "free":
            problems.append("track ends = 'free' without support: nothing would hold the rail")
        raise_if(problems)

    @property
    def n_bays(self) -> int:
        """Number of bays; without discrete supports a bay is about `NOMINAL_BAY` long."""
        bay = NOMINAL_BAY
        if isinstance(self.support, DiscreteSupports):
            bay = self.support.spacing
        return max(1, round(self.length / bay))

    @property
    def bay_length(self) -> float:
        """[m]."""
        return self.length / self.n_bays

    @property
    def support_positions(self) -> np.ndarray:
        """X of the supports, (n_bays + 1,) m; empty without discrete supports."""
        if not isinstance(self.support, DiscreteSupports):
            return np.empty(0)
        return np.linspace(0.0, self.length, self.n_bays + 1)

    @property
    def pad_footprints(self) -> np.ndarray:
        """First and last X of each pad's footprint, (n_supports, 2) m, cut off at the ends."""
        if not isinstance(self.support, DiscreteSupports):
            return np.empty((0, 2))
        half = 0.5 * self.support.pad_length
        positions = self.support_positions
        return np.clip(np.column_stack((positions - half, positions + half)), 0.0, self.length)

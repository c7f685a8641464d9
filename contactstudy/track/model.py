"""What the track is: rail, supports, length and ends, as frozen data.

The beam and the solid discretisation are both built from one `Track`. Values are per rail
(half a track) and SI. The default supports are the ballasted track of W. M. Zhai, K. Y. Wang
and J. H. Lin, J. Sound Vib. 270 (2004) 673, per rail seat.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Annotated, ClassVar, Literal

import numpy as np

from contactstudy.arrays import Array
from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import DeckSection
from contactstudy.track.rail import RAILS, Direction, Rail
from contactstudy.track.rail import GivenRail as GivenRail
from contactstudy.validation import (
    Above,
    AtLeast,
    Key,
    Naming,
    Parameters,
    Unit,
    Usual,
    Variants,
    complaint,
)
from contactstudy.validation import quantities as q

Ends = Literal["clamped", "pinned", "free"]

NOMINAL_BAY = 0.6
"""m, length that is called a bay where the track has no discrete supports."""

MOST_BAYS = 50_000
"""Of a track: 30 km of sleepers."""


def whole(ratio: float) -> bool:
    """Whether a ratio of lengths that were given in decimal is a whole number."""
    return ratio > 0.5 and abs(ratio - round(ratio)) <= 1e-9 * ratio


@dataclass(frozen=True)
class Ballast(Parameters):
    """Spring and damper from each half sleeper to the ground."""

    stiffness: Annotated[
        q.Stiffness, Usual(1e6, 1e10), Key("ballast_stiffness"), "of the ballast"
    ] = 137.75e6
    damping: Annotated[q.Damping, Key("ballast_damping"), "of the ballast"] = 58.8e3
    lateral_stiffness: Annotated[
        q.Stiffness, Key("lateral_ballast_stiffness"), "of the ballast"
    ] = 50e6
    lateral_damping: Annotated[q.Damping, Key("lateral_ballast_damping"), "of the ballast"] = 40e3


@dataclass(frozen=True)
class Slab(Parameters):
    """A continuous slab: Euler beam with free ends on a uniform viscoelastic bed.

    A half sleeper, if any, is cast into the slab: its mass is lumped there.
    """

    bending_stiffness: Annotated[
        q.BendingStiffness, Key("slab_bending_stiffness"), "of half the slab"
    ] = 60e6
    mass_per_length: Annotated[q.MassPerLength, Key("slab_mass_per_length"), "of half the slab"] = (
        730.0
    )
    stiffness: Annotated[q.BedStiffness, Key("slab_bed_stiffness"), "of the bed below it"] = 625e6
    damping: Annotated[q.BedDamping, Key("slab_bed_damping"), "of the bed below it"] = 83e3
    lateral_bending_stiffness: Annotated[q.BendingStiffness, Key("")] = 1e9
    lateral_stiffness: Annotated[q.BedStiffness, Key("")] = 300e6
    lateral_damping: Annotated[q.BedDamping, Key("")] = 83e3


@dataclass(frozen=True)
class DiscreteSupports(Parameters):
    """Rail seats at X = j * spacing: pad, half sleeper, and the layer below.

    The pad acts on the average rail displacement over its footprint, which is cut off where the
    track ends; the pad's whole stiffness is kept there.
    """

    spacing: Annotated[q.Length, Usual(0.2, 3.0), "distance of the supports"] = 0.6
    pad_stiffness: Annotated[q.Stiffness, Usual(1e6, 1e10), "of a rail pad"] = 65e6
    pad_damping: Annotated[q.Damping, "of a rail pad"] = 75e3
    pad_length: Annotated[q.LengthOrZero, "length of the pad along the rail; 0 is a point"] = 0.16
    sleeper_mass: Annotated[q.MassOrZero, Usual(5.0, 1e4), "of half a sleeper"] = 125.5
    layer: Annotated[
        Ballast | Slab,
        Variants("layer", {"ballast": Ballast, "slab": Slab}, "what lies below the sleepers"),
    ] = field(default_factory=Ballast)
    lateral_pad_stiffness: Annotated[q.Stiffness, "of a rail pad"] = 20e6
    lateral_pad_damping: Annotated[q.Damping, "of a rail pad"] = 50e3

    def problems(self, key: Naming) -> list[str]:
        """Pads that overlap."""
        if self.pad_length < self.spacing:
            return []
        allowed = f"must be below the support spacing, {self.spacing:g} m"
        return [complaint(key("pad_length"), self.pad_length, allowed)]


@dataclass(frozen=True)
class WinklerFoundation(Parameters):
    """Uniform springs and dampers under the rail."""

    stiffness: Annotated[q.BedStiffness, Key("foundation_stiffness"), "of the bed"] = 30e6
    damping: Annotated[q.BedDamping, Key("foundation_damping"), "of the bed"] = 0.0
    lateral_stiffness: Annotated[float | None, Unit("N/m^2"), Above(0), Key("")] = None
    lateral_damping: Annotated[float | None, Unit("N*s/m^2"), AtLeast(0), Key("")] = None

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
class Track(Parameters):
    """One rail on its supports, from X = 0 to X = length, or both rails on a bridge.

    The length is a whole number of spacings of discrete supports; with a bridge, it is that of the
    bridge and its approaches. Without support nothing but the ends carries the rail (a beam).
    """

    rail: Annotated[Rail, RAILS] = field(default_factory=Rail)
    support: Annotated[
        Support,
        Variants(
            "support",
            {"discrete": DiscreteSupports, "winkler": WinklerFoundation, "none": None},
            "what carries the rail",
        ),
    ] = field(default_factory=DiscreteSupports)
    length: Annotated[q.Length, Usual(1.0, 2e4), "length of the track"] = 36.0
    ends: Annotated[Ends, "both ends of the rail"] = "clamped"
    structure: Annotated[
        Bridge | None,
        Variants(
            "structure",
            {"ground": None, "bridge": Bridge},
            "what the supports of the rails stand on",
        ),
    ] = None

    settled: ClassVar = ("length",)

    def settle(self) -> None:
        """The length of a track on a bridge is the bridge's."""
        if self.structure is not None:
            object.__setattr__(self, "length", self.structure.length)

    def problems(self, key: Naming) -> Iterable[str]:
        """Supports that do not fit the length, or do not hold the rail."""
        if self.structure is not None:
            return self._on_bridge(self.structure, key)
        if self.support is None and self.ends == "free":
            return [complaint(key("ends"), "free", "nothing holds a rail without support")]
        bay = self.support.spacing if isinstance(self.support, DiscreteSupports) else NOMINAL_BAY
        if self.length > MOST_BAYS * bay:
            allowed = f"must be at most {MOST_BAYS * bay:g} m, {MOST_BAYS} bays of {bay:g} m"
            return [complaint(key("length"), self.length, allowed)]
        if isinstance(self.support, DiscreteSupports):
            spacing = self.support.spacing
            if not whole(self.length / spacing):
                bays = max(1, math.floor(self.length / spacing))
                near = f"{bays * spacing:.10g} m or {(bays + 1) * spacing:.10g} m"
                allowed = f"must be a whole number of support spacings of {spacing:g} m: {near}"
                return [complaint(key("length"), self.length, allowed)]
        return []

    def _on_bridge(self, bridge: Bridge, key: Naming) -> Iterator[str]:
        if self.ends != "clamped":
            allowed = 'must be "clamped" on a bridge, whose approaches carry the rails\' ends'
            yield complaint(key("ends"), self.ends, allowed)
        if not isinstance(self.support, DiscreteSupports):
            yield f"{key('support')}: must be discrete supports on a bridge"
        elif (shortest := min((*bridge.spans, np.inf))) < 2.0 * self.support.spacing:
            allowed = f"must be at least two support spacings, {2.0 * self.support.spacing:g} m"
            yield complaint(key("spans"), shortest, allowed)
        if self.given("length") and abs(self.length - bridge.length) > 1e-6:
            allowed = f"is that of the bridge and its approaches, {bridge.length:g} m; leave it out"
            yield complaint(key("length"), self.length, allowed)

    @property
    def mass_on_structure(self) -> float:
        """What both rails, sleepers and a slab add to the mass of a deck [kg/m]."""
        half = self.rail.mass_per_length
        if isinstance(self.support, DiscreteSupports):
            half += self.support.sleeper_mass / self.support.spacing
            if isinstance(self.support.layer, Slab):
                half += self.support.layer.mass_per_length
        return 2.0 * half

    @property
    def loaded_deck(self) -> DeckSection | None:
        """A bridge's deck with the `mass_on_structure`: as it vibrates in the track; or None."""
        if self.structure is None:
            return None
        deck = self.structure.deck
        return replace(deck, mass_per_length=deck.mass_per_length + self.mass_on_structure)

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
    def middle(self) -> float:
        """X of the middle of the middle bay [m]."""
        return (self.n_bays // 2 + 0.5) * self.bay_length

    @property
    def support_positions(self) -> Array:
        """X of the supports, (n_bays + 1,) m; empty without discrete supports."""
        if not isinstance(self.support, DiscreteSupports):
            return np.empty(0)
        return np.linspace(0.0, self.length, self.n_bays + 1)

    @property
    def pad_footprints(self) -> Array:
        """First and last X of each pad's footprint, (n_supports, 2) m, cut off at the ends."""
        if not isinstance(self.support, DiscreteSupports):
            return np.empty((0, 2))
        half = 0.5 * self.support.pad_length
        positions = self.support_positions
        return np.clip(np.column_stack((positions - half, positions + half)), 0.0, self.length)

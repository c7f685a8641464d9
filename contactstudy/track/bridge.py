"""What a track on a bridge stands on: decks, bearings, piers, and the ground before and behind."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Annotated, Any, Literal

import numpy as np

from contactstudy.arrays import Array, IntArray
from contactstudy.track.deck import Antoing, Box32m, DeckSection, GivenDeck, rayleigh
from contactstudy.track.pier import Pier
from contactstudy.validation import (
    Above,
    AtLeast,
    AtMost,
    Naming,
    Parameters,
    Unit,
    Variants,
    When,
    Written,
    complaint,
    listed,
)
from contactstudy.validation import quantities as q

_REPEATED = re.compile(r"\s*(\d{1,4})\s*x\s*(.+)")


def _spans(value: Any, unit: str) -> Any:
    """Lengths of spans from "10 x 32 m", or from a list of such texts and lengths."""
    found = list[Any]()
    for one in listed(value):
        match = _REPEATED.fullmatch(one) if isinstance(one, str) else None
        found += [match[2]] * int(match[1]) if match else [one]
    return found


@dataclass(frozen=True)
class Bridge(Parameters):
    """Decks in a row with their ends at abutments and piers, between two approaches on the ground.

    A track's supports stand on it as on the ground: their layer, sleepers on ballast or a slab, is
    the same on the approaches. A deck is a beam; its axis, at Y = 0, runs through its centroids.
    The track lies beside it (`track_offset`) and above it (`track_height`). Two bearings stand
    below each support of a deck. They hold it up and laterally, along the track at one support
    only. Each span is measured between its bearings.

    Wheels come from rigid ground: over the entry length their load passes smoothly to the
    track, and leaves it so at the other end.
    """

    spans: Annotated[
        tuple[float, ...], Unit("m"), Above(0), Written(_spans, 'text like "10 x 32 m"'),
        "lengths of all spans",
    ] = (32.0,) * 10  # fmt: skip
    spans_per_deck: Annotated[
        tuple[int, ...], AtLeast(1), Written(listed),
        "of each deck how many spans it runs over; one number for all, 1 is simply supported",
    ] = (1,)  # fmt: skip
    deck: Annotated[
        DeckSection,
        Variants("deck", {"box_32m": Box32m, "antoing": Antoing, "given": GivenDeck}, "section"),
    ] = field(default_factory=Box32m)
    deck_damping: Annotated[
        Literal["rayleigh", "modal"],
        "of the deck: a M + b K, or its ratio for each of its modes up to a frequency",
    ] = "rayleigh"
    damping_frequencies: Annotated[
        tuple[float, float] | None, Unit("Hz"), Above(0), When("deck_damping", "rayleigh"),
        "where the deck has its damping ratio; first and second bending of the longest span if "
        "left out",
    ] = None  # fmt: skip
    modal_damping_up_to: Annotated[
        float | None, Unit("Hz"), Above(0), When("deck_damping", "modal"),
        "modes of a deck up to here have its damping ratio, others none; if left out, 30 Hz or ten "
        "times the first bending frequency of the shortest span",
    ] = None  # fmt: skip
    approach_before: Annotated[q.Length, "track on the ground before the bridge"] = 50.0
    approach_behind: Annotated[q.Length, "track on the ground behind the bridge"] = 50.0
    ground_stiffness: Annotated[
        float | None, Unit("N/m"), Above(0),
        "below the layer of the approaches, a rail seat; rigid if left out",
    ] = None  # fmt: skip
    entry_length: Annotated[q.Length, "over which wheels come onto the track and leave it"] = 10.0
    track_offset: Annotated[q.Position, "track's centre to the left of the deck's axis"] = 2.5
    track_height: Annotated[q.Position, "rails' feet above the deck's centroid"] = 1.5
    rail_distance: Annotated[q.Length, "between the two rails' axes"] = 1.5
    bearing_distance: Annotated[q.Length, "between the two bearings of a support"] = 4.5
    gauge_depth: Annotated[
        q.Position, "below the deck's centroid, where its strain along the track is recorded"
    ] = 1.0
    bearing_depth: Annotated[q.Position, "bearings below the deck's centroid"] = 2.0
    bearing_stiffness: Annotated[q.Stiffness, "of a bearing, vertical"] = 10e9
    bearing_damping: Annotated[q.Damping, "of a bearing, vertical"] = 0.0
    lateral_bearing_stiffness: Annotated[
        q.Stiffness, "of a bearing, across the track; along it that of the one support that holds"
    ] = 2e9
    fixed_support: Annotated[
        Literal["first", "last"], "of each deck, which holds it along the track"
    ] = "first"
    motion: Annotated[
        Literal["planar", "space"] | None,
        "of the track: vertical only, both rails as one; or in space; as the vehicle if left out",
    ] = None
    animation_frames: Annotated[
        int, AtLeast(0), AtMost(1000),
        "instants of the passage at which bridge and train are kept, for pictures, the animation "
        "and ParaView; 0 for none",
    ] = 60  # fmt: skip
    piers: Annotated[
        Pier | None,
        Variants("piers", {"rigid": None, "column": Pier}, "what inner supports stand on"),
    ] = None

    def problems(self, key: Naming) -> list[str]:
        """Decks that do not share out the spans, entries longer than an approach."""
        problems = []
        n, given = len(self.spans), self.spans_per_deck
        if not self.spans:
            problems.append(complaint(key("spans"), [], "must be one length at least (m)"))
        elif (len(given) == 1 and n % given[0]) or (len(given) != 1 and sum(given) != n):
            allowed = f"must add up to the {n} spans, or be one number that divides {n}"
            problems.append(complaint(key("spans_per_deck"), list(given), allowed))
        for name in ("approach_before", "approach_behind"):
            if getattr(self, name) < self.entry_length:
                allowed = f"must be at least the entry length, {self.entry_length:g} m"
                problems.append(complaint(key(name), getattr(self, name), allowed))
        pair = self.damping_frequencies
        if pair is not None and not pair[0] < pair[1]:
            problems.append(complaint(key("damping_frequencies"), list(pair), "must increase (Hz)"))
        return problems

    def resolved(self) -> dict[str, Any]:
        """As in `Parameters`; the damping's frequencies, without what is left out."""
        values = super().resolved()
        if (up_to := self.damped_up_to) is None:
            values["damping_frequencies"] = list(self._damped_at)
        else:
            values["modal_damping_up_to"] = up_to
        return {key: value for key, value in values.items() if value is not None}

    def planar_under(self, directions: Iterable[str]) -> bool:
        """Whether all moves vertically only, under contacts in some directions."""
        return self.motion == "planar" or (self.motion is None and "Y" not in directions)

    @property
    def length(self) -> float:
        """Of the whole track [m]."""
        return self.approach_before + sum(self.spans) + self.approach_behind

    @cached_property
    def supports(self) -> Array:
        """X of abutments and piers, (n_spans + 1,) m."""
        return self.approach_before + np.concatenate([[0.0], np.cumsum(self.spans)])

    def span_at(self, x: float) -> float:
        """Length of the span at X, beside the bridge of the nearest one [m]."""
        k = int(np.searchsorted(self.supports, x)) - 1
        return self.spans[min(max(k, 0), len(self.spans) - 1)]

    @cached_property
    def decks(self) -> tuple[Array, ...]:
        """X of the supports of each deck [m]."""
        counts = self.spans_per_deck
        if len(counts) == 1:
            counts = counts * (len(self.spans) // counts[0])
        ends = np.concatenate([[0], np.cumsum(counts)])
        return tuple(self.supports[a : b + 1] for a, b in itertools.pairwise(ends))

    @property
    def rayleigh(self) -> tuple[float, float] | None:
        """Coefficients a [1/s] and b [s] of the deck's damping a M + b K, if it is that."""
        if self.deck_damping == "modal":
            return None
        return rayleigh(self.deck.damping_ratio, *self._damped_at)

    @property
    def damped_up_to(self) -> float | None:
        """Up to which frequency a deck's modes have its ratio, if the damping is modal [Hz].

        Of a beam's frequencies, i^2 f_1, ten f_1 lets the third in; up to there, and up to 30 Hz,
        EN 1990, A2.4.4.2.1(4) counts the deck's acceleration.
        """
        if self.deck_damping == "rayleigh":
            return None
        return self.modal_damping_up_to or max(30.0, 10.0 * self.deck.frequency(min(self.spans)))

    @property
    def _damped_at(self) -> tuple[float, float]:
        first = self.deck.frequency(max(self.spans))
        return self.damping_frequencies or (first, 4.0 * first)

    @property
    def lateral_of_rails(self) -> tuple[float, float]:
        """Y of the right and of the left rail, seen along +X [m]."""
        half = 0.5 * self.rail_distance
        return self.track_offset - half, self.track_offset + half


GROUND = -1
"""In place of a deck: the approaches."""


@dataclass(frozen=True)
class Stretch:
    """Supports of the track on one deck or approach.

    Bays of equal length fit each span and each approach, as near to the spacing as they can be;
    a support stands in the middle of its bay.

    Attributes
    ----------
    start, end : float
        X [m].
    seats : ndarray
        (n,) X of the supports [m].
    bays : ndarray
        (n,) lengths of their bays [m].
    deck : int
        Number of the deck, or `GROUND`.
    """

    start: float
    end: float
    seats: Array
    bays: Array
    deck: int


def stretches(bridge: Bridge, spacing: float) -> tuple[Stretch, ...]:
    """Approaches and decks in their order along the track, supports about `spacing` [m] apart."""
    before, behind = bridge.supports[0], bridge.supports[-1]
    parts: list[tuple[Array, int]] = [(np.array([0.0, before]), GROUND)]
    parts += [(supports, number) for number, supports in enumerate(bridge.decks)]
    parts.append((np.array([behind, bridge.length]), GROUND))
    return tuple(_stretch(ends, deck, spacing) for ends, deck in parts)


def _stretch(ends: Array, deck: int, spacing: float) -> Stretch:
    seats, bays = list[Array](), list[Array]()
    for start, end in itertools.pairwise(ends):
        n = max(1, round((end - start) / spacing))
        bay = (end - start) / n
        seats.append(start + bay * (np.arange(n) + 0.5))
        bays.append(np.full(n, bay))
    return Stretch(
        float(ends[0]), float(ends[-1]), np.concatenate(seats), np.concatenate(bays), deck
    )


def nodes_of_rail(parts: tuple[Stretch, ...], per_bay: int) -> Array:
    """X of the rail's nodes [m]: at both ends and all seats, `per_bay` elements between seats."""
    seats = np.concatenate([part.seats for part in parts])
    inner = [np.linspace(a, b, per_bay + 1)[:-1] for a, b in itertools.pairwise(seats)]
    half = -(-per_bay // 2)
    first = np.linspace(parts[0].start, seats[0], half + 1)[:-1]
    last = np.linspace(seats[-1], parts[-1].end, half + 1)
    return np.concatenate([first, *inner, last])


def of_support(x: Array, supports: Array) -> IntArray:
    """Number in `supports` of each of positions x that is one."""
    return np.array([int(np.argmin(np.abs(supports - one))) for one in x], dtype=np.int64)

"""The track that a resolved study describes."""

from collections.abc import Mapping
from typing import Any

from contactstudy.track.bridge import Bridge
from contactstudy.track.deck import DeckSection
from contactstudy.track.model import Track
from contactstudy.validation import read


def bridge_of(track: Mapping[str, Any]) -> Bridge:
    """The bridge of a resolved study's track."""
    bridge = track_of(track).structure
    assert bridge is not None
    return bridge


def track_of(track: Mapping[str, Any]) -> Track:
    """The track of a resolved study."""
    made, problems = read(Track, track, "track")
    assert not problems
    return made


def loaded_deck_of(track: Mapping[str, Any]) -> DeckSection:
    """The deck of a resolved study's bridge, with the mass of the track on it."""
    deck = track_of(track).loaded_deck
    assert deck is not None
    return deck

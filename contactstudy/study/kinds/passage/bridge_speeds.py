"""Speeds at which a train is in resonance with a bridge, or leaves it at rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contactstudy.compare.bridge_codes import cancellation_speeds, resonance_speeds
from contactstudy.figures.resolved_track import bridge_of, loaded_deck_of
from contactstudy.figures.train import repeat_length
from contactstudy.plot.text import number
from contactstudy.study.kind import Marks
from contactstudy.study.results import StudyResults

_ORDERS = 12


def marks(results: StudyResults, key: str) -> list[Marks]:
    """Along the speed, where no key of the track or the vehicle varies with it."""
    varied = {str(name) for data in results.designs.values() for name in data["variant"].coords}
    others = [name for name in varied if name.startswith(("track.", "vehicle."))]
    return speed_marks(results.config) if key == "journey.speed" and not others else []


def speed_marks(config: Mapping[str, Any]) -> list[Marks]:
    """Of a resolved study: resonance, where the train has a repeat length, and cancellation."""
    track = config.get("track", {})
    if track.get("structure") != "bridge":
        return []
    span = max(bridge_of(track).spans)
    f1 = loaded_deck_of(track).frequency(span)
    of = f"f₁ = {number(f1, 3)} Hz with the track"
    made = []
    if length := repeat_length(config.get("vehicle", {})):
        speeds = resonance_speeds(f1, length, _ORDERS).tolist()
        text = f"resonance, v = f₁ L_c/i, {of}, L_c = {number(length, 3)} m (km/h)"
        made.append(Marks("resonance", speeds, text))
    speeds = cancellation_speeds(f1, span, _ORDERS).tolist()
    text = f"cancellation of the longest span, simply supported, v = 2 f₁ L/(2i + 1), {of}"
    text += f", L = {number(span, 3)} m (km/h)"
    return [*made, Marks("cancellation", speeds, text)]

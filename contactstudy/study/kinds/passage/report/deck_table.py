"""Table of the deck of a bridge beside the limits and formulas of EN 1990 and EN 1991-2."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from contactstudy.compare.bridge_codes import (
    Limit,
    amplification,
    counted_acceleration,
    cut_off,
    dynamic_factor,
    limits,
    track_twist,
)
from contactstudy.figures.deck import largest_station
from contactstudy.figures.resolved_track import bridge_of, loaded_deck_of
from contactstudy.plot.text import label, number
from contactstudy.report.blocks import Block, table
from contactstudy.solvers.bridge_frames import RAIL
from contactstudy.study.results import StudyResults

_COLUMNS = ["Run", "Deflection (mm)", "Static (mm)", "Dynamic factor", "Acceleration (m/s²)"]
_LIMITS = (
    "vertical acceleration of the deck",
    "vertical deflection",
    "twist over 3 m",
    "first lateral frequency, at least",
)


def deck_sentences(results: StudyResults) -> list[str]:
    """For the abstract: how far the deck moves, and how much more than under the static loads."""
    station = largest_station(results)
    if station is None:
        return []
    frequency = _span(results.config["track"], station)[1]
    factors, accelerations = dict[str, float](), dict[str, float]()
    for name, run in results.runs.items():
        here = run.sel(station=station)
        dynamic, static = here["deck_displacement"].values, here["deck_static"].values
        factors[name] = amplification(dynamic, static)
        if (counted := _counted(here["deck_acceleration"], frequency)) is not None:
            accelerations[name] = counted
    told = (
        f"The deck moves most at X = {number(station, 4)} m. There its deflection is "
        f"{_ends(factors)} times that under the static loads"
    )
    if accelerations:
        told += f", its acceleration up to {number(cut_off(frequency), 3)} Hz at most "
        told += f"{_ends(accelerations, 2)} m/s²"
    return [f"{told}."]


def _ends(values: dict[str, float], digits: int = 3) -> str:
    """Smallest and largest value with their runs."""
    low, high = (find(values, key=lambda name: values[name]) for find in (min, max))
    text = f"{number(values[low], digits)}"
    if len(values) > 1:
        text += f" ({label(low)}) to {number(values[high], digits)} ({label(high)})"
    return text


def deck_table(results: StudyResults) -> list[Block]:
    """Of each run the largest values at the station where a deck moves most."""
    station = largest_station(results)
    if station is None:
        return []
    rows, frequency = [], _span(results.config["track"], station)[1]
    twists = {name: _twist(run) for name, run in results.runs.items()}
    twisted = any(twist is not None for twist in twists.values())
    for name, run in results.runs.items():
        here = run.sel(station=station)
        dynamic, static = here["deck_displacement"].values, here["deck_static"].values
        counted = _counted(here["deck_acceleration"], frequency)
        rows.append(
            [
                label(name),
                number(1e3 * float(np.abs(dynamic).max()), 3),
                number(1e3 * float(np.abs(static).max()), 3),
                number(amplification(dynamic, static), 3),
                number(float(np.abs(here["deck_acceleration"]).max()), 2),
                "–" if counted is None else number(counted, 2),
            ]
        )
        if twisted:
            twist = twists[name]
            rows[-1].append("–" if twist is None else number(1e3 * twist, 2))
    caption = f"The deck at X = {number(station, 4)} m."
    columns = [*_COLUMNS, f"up to {number(cut_off(frequency), 3)} Hz"] + ["Twist (mm)"] * twisted
    return [table(columns, rows, caption, 1, _beside(results, station, twisted)) | {"size": 8}]


def _counted(acceleration: xr.DataArray, frequency: float) -> float | None:
    step = float(np.diff(acceleration["time"].values[:2])[0])
    return counted_acceleration(acceleration.values, step, frequency)


def _twist(run: xr.Dataset) -> float | None:
    """Of the track on the bridge, over 3 m, of all frames; None without two rails in frames."""
    if "frame_displacement" not in run:
        return None
    rails = run["node_part"].values == RAIL
    x, chain = run["node_x"].values[rails], run["node_chain"].values[rails]
    if chain.max() == 0:
        return None
    supports, up = run["support"].values, run["frame_displacement"].sel(axis="Z").values[:, rails]
    on = (x >= supports[0]) & (x <= supports[-1])
    right, left = on & (chain == 0), on & (chain == 1)
    return track_twist(x[right], up[:, right], up[:, left])


def _beside(results: StudyResults, station: float, twisted: bool = False) -> str:
    """What the codes say of the span under the station."""
    track = results.config["track"]
    speed = float(results.config["journey"]["speed"])
    span, frequency = _span(track, station)
    found = {one.name: one for one in limits(speed, track["layer"] == "ballast", span)}
    limit, deflection, twist, lateral = (found[name] for name in _LIMITS)
    factor, careful = (dynamic_factor(speed, frequency, span, c) for c in (False, True))
    told = [
        f"EN 1990: acceleration at most {number(limit.value, 2)} m/s² ({limit.source}), of "
        "frequencies up to the largest of 30 Hz, 1.5 times the first and the third; the column "
        "before it has all that the time step lets through",
        f"deflection at most L/600 = {number(1e3 * deflection.value, 3)} mm ({deflection.source}), "
        "under load model 71",
    ]
    if twisted:
        told.append(
            f"twist of the track at most {number(1e3 * twist.value, 2)} mm/3 m ({twist.source}), "
            f"here over 3 m the largest of {track['animation_frames']} instants"
        )
    told += _lateral(track, span, lateral)
    return (
        "; ".join(told) + ". EN 1991-2, annex C, for a simply supported span of "
        f"{number(span, 3)} m with the track on it, {number(frequency, 3)} Hz: "
        f"1 + φ' + φ'' = {number(factor, 3)}, "
        f"with carefully maintained track {number(careful, 3)}."
    )


def _lateral(track: dict[str, Any], span: float, limit: Limit) -> list[str]:
    """First lateral frequency of a span, simply supported, where the deck's section tells it."""
    frequency = loaded_deck_of(track).lateral_frequency(span)
    if frequency is None:
        return []
    return [
        f"first lateral frequency at least {limit.value:g} {limit.unit} ({limit.source}), here "
        f"{number(frequency, 3)} Hz simply supported"
    ]


def _span(track: dict[str, Any], station: float) -> tuple[float, float]:
    """Length of the span under a station [m], and its first frequency simply supported [Hz]."""
    span = bridge_of(track).span_at(station)
    return span, loaded_deck_of(track).frequency(span)

"""What is measured of one variant of a passage: errors against the reference, and each run's own.

::

    relative_l2 (run, signal, part), sprague_geers (run, signal, part, measure)
    correlation, linf, rms (run, signal)          all these against the reference
    static, smallest, largest (run, signal)       at rest, and behind the fade-in
    root_mean_square (run, signal, part)          of the dynamic and the irregularity's part
    largest_of_deck (run, signal)                 size, over all stations on decks; accelerations
                                                  up to the frequency that EN 1990 counts
    amplification (run)                           dynamic factor of the deck, where it moves most
    contact_lost (run)                            share of the way without contact
    of defects also those of `contactstudy.study.kinds.passage.impacts`

Parts are total, dynamic, and with ``compare.smooth`` irregularity, as in
`contactstudy.study.kinds.passage.metrics`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.compare.bridge_codes import amplification, counted_acceleration
from contactstudy.compare.signals import is_moving_force, position, same_way
from contactstudy.study.axes.measured import Measured, measured
from contactstudy.study.kinds.passage.impacts import closed_forms, impacts
from contactstudy.study.kinds.passage.metrics import behind, compare_runs, parts_of
from contactstudy.study.kinds.passage.schema import Study
from contactstudy.study.kinds.passage.twins import OF_DECK, SMOOTH, SOFTER, with_twins

if TYPE_CHECKING:
    import xarray as xr

    from contactstudy.track.model import Track

PARTS = ("total", "dynamic", "irregularity")
_RUN = ["run", "signal"]
_UNIT = "in the signal's SI unit"
_ERRORS = {
    "relative_l2": ("relative L2 difference from the reference", [*_RUN, "part"]),
    "rms": (f"root mean square of the difference from the reference, {_UNIT}", _RUN),
    "linf": (f"largest difference from the reference, {_UNIT}", _RUN),
    "correlation": ("Pearson's correlation with the reference", _RUN),
    "sprague_geers": ("errors of Sprague and Geers", [*_RUN, "part", "measure"]),
}
_OWN = {
    "static": (f"value at rest, {_UNIT}", _RUN),
    "smallest": (f"smallest value behind the fade-in, {_UNIT}", _RUN),
    "largest": (f"largest value behind the fade-in, {_UNIT}", _RUN),
    "root_mean_square": (f"root mean square of a part of the signal, {_UNIT}", [*_RUN, "part"]),
    "largest_of_deck": (
        f"largest size over the stations on decks, {_UNIT}; of the acceleration that up to the "
        "frequency of EN 1990, A2.4.4.2.1(4)",
        _RUN,
    ),
    "amplification": (
        "largest dynamic over largest static deflection of the deck, at the station of the largest",
        ["run"],
    ),
    "contact_lost": ("share of the way without contact", ["run"]),
}


def measure(study: Study, found: Mapping[str, Any]) -> Measured:
    """Measure the runs of a variant, from its finished pieces of work."""
    runs = with_twins(study, found)
    start = study.journey.start + study.journey.fade_in
    made = {n: measured("1", text, dims, {}) for n, (text, dims) in (_ERRORS | _OWN).items()}
    for name, run in runs.items():
        _own(run, start, lambda variable, name=name: made[variable]["values"].setdefault(name, {}))
        made["contact_lost"]["values"][name] = _lost(run, start)
        if most := largest_of_deck(run, study.track):
            made["largest_of_deck"]["values"][name] = most
        if (factor := _amplification(run)) is not None:
            made["amplification"]["values"][name] = factor
        reference = None if study.reference is None else runs[study.reference]
        if reference is not None and name != study.reference and same_way(run, reference):
            for signal, entry in compare_runs(run, reference, start, False).items():
                for variable, (_, dims) in _ERRORS.items():
                    value = entry[variable] if dims == _RUN else _by_part(entry, variable)
                    made[variable]["values"].setdefault(name, {})[signal] = value
    for name, force in closed_forms(study).items():
        made["largest"]["values"][name] = {"contact_force": force}
    return {name: entry for name, entry in made.items() if entry["values"]} | impacts(study, runs)


def against_finest(study: Study, found: Mapping[str, Any], finest: Mapping[str, Any]) -> Measured:
    """Measure how far the runs of a variant are from the same runs of the finest one.

    ::

        from_finest (run, signal, part)     relative L2 difference, 0 of runs that are the same
    """
    own, best = with_twins(study, found), with_twins(study, finest)
    start = study.journey.start + study.journey.fade_in
    values: dict[str, Any] = {
        name: {
            signal: _by_part(entry, "relative_l2")
            for signal, entry in compare_runs(run, best[name], start, False).items()
        }
        for name, run in own.items()
    }
    text = "relative L2 difference from the same run of the finest variant"
    return {"from_finest": measured("1", text, [*_RUN, "part"], values)}


def _by_part(entry: Mapping[str, Any], name: str) -> dict[str, Any]:
    keys = {part: name if part == "total" else f"{name}_{part}" for part in PARTS}
    return {part: entry[key] for part, key in keys.items() if key in entry}


def _own(run: xr.Dataset, start: float, of: Any) -> None:
    """Enter what a run's histories are by themselves."""
    x = position(run)
    for name, variable in run.data_vars.items():
        signal = str(name)
        twin = signal.endswith((SMOOTH, SOFTER))
        other = {"station", "support"} & set(variable.dims)
        given = signal == "contact_force" and is_moving_force(run)  # nothing to find out
        if variable.dims[-1:] != ("time",) or other or twin or given:
            continue
        values = np.asarray(variable.values, dtype=float)
        kept = behind(values, x, start)
        kept = kept[np.isfinite(kept)]  # Y/Q is not known where nothing touches
        if not kept.size:
            continue
        of("static")[signal] = float(values.flat[0])
        of("smallest")[signal] = float(kept.min())
        of("largest")[signal] = float(kept.max())
        parts = {k: behind(v, x, start) for k, v in parts_of(run, signal).items()}
        squares = {part: float(np.sqrt(np.nanmean(v**2))) for part, v in parts.items()}
        of("root_mean_square")[signal] = squares


def largest_of_deck(run: xr.Dataset, track: Track) -> dict[str, float]:
    """Of a run's `OF_DECK` the largest sizes, of those that are known at a station."""
    bridge, deck = track.structure, track.loaded_deck
    if bridge is None or deck is None:
        return {}
    found: dict[str, list[float | None]] = {signal: [] for signal in OF_DECK}
    for station in run["station"].values if "station" in run.dims else ():
        here = run.sel(station=station)
        if not np.isfinite(here["deck_displacement"].values).all():
            continue
        frequency = deck.frequency(bridge.span_at(float(station)))
        step = float(np.diff(here["time"].values[:2])[0])
        found["deck_displacement"].append(float(np.abs(here["deck_displacement"]).max()))
        counted = counted_acceleration(here["deck_acceleration"].values, step, frequency)
        found["deck_acceleration"].append(counted)
    known = {signal: [v for v in values if v is not None] for signal, values in found.items()}
    return {signal: max(values) for signal, values in known.items() if values}


def _amplification(run: xr.Dataset) -> float | None:
    """Of the deck at the station where it moves most; None without one."""
    if "deck_static" not in run or not np.isfinite(run["deck_displacement"].values).any():
        return None
    dynamic, static = run["deck_displacement"].values, run["deck_static"].values
    k = int(np.nanargmax(np.nanmax(np.abs(dynamic), axis=1, initial=0.0)))
    return amplification(dynamic[k], static[k]) if np.any(static[k]) else None


def _lost(run: xr.Dataset, start: float) -> float:
    force = behind(np.asarray(run["contact_force"].values), position(run), start)
    return float(np.mean(force <= 0.0))

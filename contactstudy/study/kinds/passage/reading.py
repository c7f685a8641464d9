"""From the content of a study file to a passage; everything that is wrong at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, cast

from contactstudy.exceptions import InputError
from contactstudy.given_files import is_file
from contactstudy.study.kinds.passage.checks import combined
from contactstudy.study.kinds.passage.runs import SOLVERS
from contactstudy.study.kinds.passage.schema import (
    SECTIONS,
    Study,
    fitted_journey,
    wrong_reference,
    wrong_runs,
)
from contactstudy.study.kinds.passage.wrong_files import wrong_files
from contactstudy.study.overrides import Overrides, override
from contactstudy.study.study import TEXTS, read_texts
from contactstudy.validation import (
    UnreadError,
    asked,
    complaint,
    did_you_mean,
    entries,
    read,
    resolve_paths,
    unknown,
    wrong_for_all,
)

_TOP_LEVEL = (*TEXTS, *SECTIONS, "runs", "compare")
_COMPARE = ("reference", "smooth", "rungs", "softer")
_SWITCHES = ("smooth", "rungs")
_SHARED = ("track", "vehicle", "journey", "solid", "wheelset", "scan")


def load_passage(
    path: Path, data: dict[str, Any], overrides: Overrides, main: Study | None = None
) -> Study:
    """Check the content of a passage's file, with overrides; files in it are relative to it."""
    companions = data.get("companions")
    if isinstance(companions, list):
        data["companions"] = [
            str(path.parent / c) if isinstance(c, str) and is_file(path.parent / c) else c
            for c in companions
        ]
    for key, table in SECTIONS.items():
        resolve_paths(table, data.get(key), path.parent)
    problems = override(data, overrides, SECTIONS, {"runs": SOLVERS})
    return parse_study(path.stem, data, problems, main)


def parse_study(
    name: str, data: Mapping[str, Any], problems: Iterable[str] = (), main: Study | None = None
) -> Study:
    """Check the content of a study file (as TOML gives it); further `problems` are included.

    Raises
    ------
    InputError
        Listing every problem.
    """
    found = list(problems)
    found += [unknown("", key, _TOP_LEVEL) for key in data if key not in _TOP_LEVEL]
    tables: dict[str, Any] = {}
    for key, table in SECTIONS.items():
        if main is not None and key in _SHARED and key not in data:
            tables[key] = getattr(main, key)
            continue
        made, wrong = read(table, data.get(key, {}), key)
        found += wrong
        if made is not None:
            tables[key] = made
    found += asked(_fit, tables, "solid" in data)
    runs, wrong = _runs(data.get("runs", {}))
    texts, wrong_texts = read_texts(data)
    compare, wrong_compare = _compare(data)
    found += wrong + combined(tables, runs) + wrong_texts + wrong_compare
    if found:
        raise InputError(dict.fromkeys(found + wrong_files(tables, runs)))
    return Study(name=name, **texts, **tables, runs=runs, **compare)


def _fit(tables: dict[str, Any], given: bool) -> Iterator[str]:
    """Fit solid (`given` or not) and journey to the other tables, in place."""
    track: Any = tables.get("track")
    journey, vehicle = tables.pop("journey", None), tables.get("vehicle")
    irregularity: Any = tables.get("irregularity")
    if track is None:
        return  # nobody knows how far the journey goes, nor how long a cell is
    if "solid" in tables and not (given and tables["solid"].given("cell_length")):
        with suppress(UnreadError):
            tables["solid"] = tables["solid"].fitting(track)
    on_bridge = track.structure is not None
    if journey is None or irregularity is None or (on_bridge and vehicle is None):
        return
    try:
        tables["journey"] = fitted_journey(journey, irregularity, track, cast(Any, vehicle))
    except InputError as error:  # of the others is complained elsewhere
        tables["journey"] = journey
        own = (p for p in error.problems if p.startswith("Journey."))
        yield from (p.replace("Journey.", "journey.") for p in own)


def _runs(data: Any) -> tuple[dict[str, Any], list[str]]:
    if not isinstance(data, Mapping):
        return {}, [complaint("runs", data, "must hold one table a run, [runs.NAME]")]
    runs, problems = {}, wrong_runs(data)
    for name, table in data.items():
        path = f"runs.{name}"
        if isinstance(table, Mapping) and "solver" in table:
            run, wrong = read(SOLVERS, table, path)
            problems += wrong
            if run is not None:
                runs[name] = run
            continue
        hint = did_you_mean(name, [other for other in data if other != name])
        misspelt = f"; or is the run's name misspelt{hint}" if hint else ""
        problems.append(f'{path}.solver: is missing; must be "point" or "surface"{misspelt}')
        if isinstance(table, Mapping):
            known = list(entries(SOLVERS))
            problems += [unknown(path, key, known) for key in table if key not in known]
            problems += wrong_for_all(SOLVERS, table, path)
    return runs, problems


def _compare(data: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    table, runs = data.get("compare", {}), data.get("runs", {})
    runs = list(runs) if isinstance(runs, Mapping) else []
    if not isinstance(table, Mapping):
        return {}, [complaint("compare", table, "must be a table")]
    problems = [unknown("compare", key, _COMPARE) for key in table if key not in _COMPARE]
    reference = table.get("reference", runs[0] if len(runs) > 1 else None)
    switches = {key: table.get(key, False) for key in _SWITCHES}
    problems += [
        complaint(f"compare.{key}", value, "must be true or false")
        for key, value in switches.items()
        if not isinstance(value, bool)
    ]
    softer = table.get("softer", 0.0)
    if isinstance(softer, bool) or not isinstance(softer, int | float) or not 0.0 <= softer <= 0.5:
        problems.append(complaint("compare.softer", softer, "must be a number from 0 to 0.5"))
        softer = 0.0
    problems += wrong_reference(reference, runs)
    chosen = {k: v is True for k, v in switches.items()} | {"softer": float(softer)}
    return {"reference": reference, **chosen}, problems

"""Study files: find, read, override, and report everything that is wrong with them at once."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from contactstudy.exceptions import InputError
from contactstudy.resources import resource
from contactstudy.study.kinds.passage import checks
from contactstudy.study.kinds.passage.scan import PATHS as SCAN_PATHS
from contactstudy.study.kinds.passage.schema import SECTIONS, SOLVERS, Study
from contactstudy.study.kinds.passage.tables import WHOLE, SolidTable, TrackTable
from contactstudy.study.kinds.passage.wheelset import PATHS as WHEELSET_PATHS
from contactstudy.study.messages import complaint, did_you_mean, from_validation, unknown
from contactstudy.study.overrides import override
from contactstudy.study.paths import resolve_paths
from contactstudy.study.results import IRREGULARITY_GROUP
from contactstudy.study.section import Section

_TOP_LEVEL = ("title", "description", "companions", *SECTIONS, "runs", "compare")
_RUN_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_SHARED = ("track", "vehicle", "journey", "solid", "wheelset", "scan")
_PATHS = ("file", "measured_overlay")


def shipped_studies() -> dict[str, Path]:
    """Name -> file of the studies that come with the program, in alphabetical order."""
    return {path.stem: path for path in sorted(resource("studies").glob("*.toml"))}


def find_study(study: str | Path) -> Path:
    """Path of a study given by path or by the name of a shipped one.

    Raises
    ------
    InputError
        With close matches when there is no such study.
    """
    path, name = Path(study), str(study)
    if path.is_file():
        return path
    shipped = shipped_studies()
    stem = name.removesuffix(".toml")
    if stem in shipped:
        return shipped[stem]
    hint = did_you_mean(Path(stem).name, shipped)
    raise InputError(
        f"study {name}: no such file nor shipped study{hint}; shipped: {', '.join(shipped)}"
    )


def load_study(
    study: str | Path, overrides: Iterable[str] = (), main: Study | None = None
) -> Study:
    """Read a study file, apply overrides, and check it.

    Parameters
    ----------
    study : str or Path
        A path, or the name of a shipped study.
    overrides : iterable of str
        ``key=value`` with dotted keys; values as in TOML, quotes around text may be left out.
    main : Study, optional
        The study that this one accompanies: track, vehicle, journey and solid are taken from
        it where the file has no such table, so that both are about the same wheel and rail.

    Raises
    ------
    InputError
        Listing every problem: unknown keys, wrong units, impossible values.
    """
    path = find_study(study)
    try:
        data = tomllib.loads(path.read_text("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: is not a TOML file ({error})") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from error
    if "positions" in data:
        raise InputError(
            f"study {study}: is a study of positions (table [positions]); only "
            "'contactstudy check', 'run' and 'reproduce' take it"
        )
    _resolve_paths(data, path.parent)
    problems = override(data, overrides)
    return parse_study(path.stem, data, problems, main)


def load_companions(study: Study) -> list[Study]:
    """Studies that accompany a study, on its track; their own companions are left out.

    Raises
    ------
    InputError
        Listing every problem of every companion.
    """
    found, problems = [], []
    for name in study.companions:
        try:
            found.append(replace(load_study(name, main=study), companions=()))
        except InputError as error:
            problems += [f"companion {name}: {problem}" for problem in error.problems]
    if problems:
        raise InputError(problems)
    return found


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
    sections: dict[str, Any] = {}
    for key, model in SECTIONS.items():
        if main is not None and key in _SHARED and key not in data:
            sections[key] = getattr(main, key)
            continue
        section, wrong = _section(model, data.get(key, {}), key)
        found += wrong
        if section is not None:
            sections[key] = section
    if "solid" in sections and sections["solid"].section == "whole":
        given = data.get("solid", {}) if main is None or "solid" in data else WHOLE
        sections["solid"] = sections["solid"].model_copy(
            update={key: value for key, value in WHOLE.items() if key not in given}
        )
    if {"track", "solid"} <= sections.keys() and "cell_length" not in data.get("solid", {}):
        sections["solid"] = _fitting_cells(sections["solid"], sections["track"])
    runs, wrong = _runs(data.get("runs", {}))
    found += wrong
    found += checks.combined(sections, runs) + checks.runs(runs)
    texts, wrong = _texts(name, data)
    found += wrong
    reference, wrong = _reference(data, list(data["runs"]) if runs else [])
    found += wrong
    if found:
        raise InputError(found)
    return Study(name=name, **texts, **sections, runs=runs, reference=reference)


def _fitting_cells(solid: SolidTable, track: TrackTable) -> SolidTable:
    """The default cell length, or the nearest to it that divides the support spacing."""
    length = track.spacing if track.support == "discrete" else track.length
    cells = max(1, round(length / solid.cell_length))
    if abs(length / cells - solid.cell_length) < 1e-9 * length:
        return solid
    return solid.model_copy(update={"cell_length": length / cells})


def _section(model: type[Section], data: Any, path: str) -> tuple[Any, list[str]]:
    if not isinstance(data, Mapping):
        return None, [complaint(path, data, "must be a table")]
    try:
        section = model.model_validate(data)
    except ValidationError as error:
        return None, from_validation(error, model, path)
    return section, checks.inapplicable(path, section)


def _runs(data: Any) -> tuple[dict[str, Any], list[str]]:
    if not isinstance(data, Mapping):
        return {}, [complaint("runs", data, "must hold one table a run, [runs.NAME]")]
    runs, problems = {}, []
    for name, table in data.items():
        path = f"runs.{name}"
        if not _RUN_NAME.fullmatch(name):
            problems.append(f"{path}: a run's name is letters, digits and _, a letter first")
        elif name == IRREGULARITY_GROUP:
            problems.append(f"{path}: a run cannot be called '{name}', which names its own group")
        if not isinstance(table, Mapping) or "solver" not in table:
            hint = did_you_mean(name, [other for other in data if other != name])
            misspelt = f"; or is the run's name misspelt{hint}" if hint else ""
            problems.append(f'{path}.solver: is missing; must be "point" or "surface"{misspelt}')
            continue
        solver = table["solver"]
        if not isinstance(solver, str) or solver not in SOLVERS:
            hint = did_you_mean(str(solver), SOLVERS)
            allowed = f'must be "point" or "surface"{hint}'
            problems.append(complaint(f"{path}.solver", solver, allowed))
            continue
        run, wrong = _section(SOLVERS[solver], table, path)
        problems += wrong
        if run is not None:
            runs[name] = run
    return runs, problems


def _texts(name: str, data: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    title, description = data.get("title", name), data.get("description", "")
    companions = data.get("companions", [])
    problems = [
        complaint(key, value, "must be text")
        for key, value in (("title", title), ("description", description))
        if not isinstance(value, str)
    ]
    if not isinstance(companions, list) or not all(isinstance(c, str) for c in companions):
        problems.append(complaint("companions", companions, "must be a list of names of studies"))
        companions = []
    texts = {"title": title, "description": description, "companions": tuple(companions)}
    return texts, problems


def _reference(data: Mapping[str, Any], runs: list[str]) -> tuple[str | None, list[str]]:
    table = data.get("compare", {})
    if not isinstance(table, Mapping):
        return None, [complaint("compare", table, "must be a table")]
    problems = [unknown("compare", key, ["reference"]) for key in table if key != "reference"]
    reference = table.get("reference", runs[0] if len(runs) > 1 else None)
    if reference is not None and reference not in runs:
        allowed = f"must be a run of the study: {', '.join(runs) or 'it has none'}"
        hint = did_you_mean(str(reference), runs)
        problems.append(complaint("compare.reference", reference, allowed + hint))
    return reference, problems


def _resolve_paths(data: dict[str, Any], base: Path) -> None:
    """Paths inside a study file are relative to the file."""
    companions = data.get("companions")
    if isinstance(companions, list):
        data["companions"] = [
            str(base / c) if isinstance(c, str) and (base / c).is_file() else c for c in companions
        ]
    resolve_paths(data.get("irregularity"), _PATHS, base)
    resolve_paths(data.get("scan"), SCAN_PATHS, base)
    resolve_paths(data.get("wheelset"), WHEELSET_PATHS, base, or_name=True)
    solid = data.get("solid")
    section = solid.get("wheel_section") if isinstance(solid, dict) else None
    if isinstance(section, str) and section.endswith(".toml"):
        data["solid"] = {**data["solid"], "wheel_section": str(base / section)}

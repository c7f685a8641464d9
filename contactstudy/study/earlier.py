"""What a folder of results already holds: other results are not written over unasked."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from contactstudy.code import code_digest
from contactstudy.exceptions import InputError
from contactstudy.files import file_digest
from contactstudy.store import Store
from contactstudy.study.overrides import flat
from contactstudy.study.plan import Plan
from contactstudy.study.results import FIGURES, OUTPUTS, RESULT_FILE, RUNS

FINISHED = "finished"
"""Entry with the checksums of all files of finished results."""
_SHOWN = 4  # differences


def refuse_other(plan: Plan, overwrite: bool) -> None:
    """Refuse a folder in which results cannot be written, or which holds another study's.

    What only has more runs, or more values along its axes, holds the earlier results too. The same
    study as another version of the program reads it is no other one: of its keys only those count
    that both versions have.

    Parameters
    ----------
    overwrite : bool
        Other results give way.

    Raises
    ------
    InputError
        Saying what differs.
    """
    problems = [problem for one in plan.all for problem in _in_the_way(one)]
    if not overwrite and not problems:
        for one in plan.all:
            if differences := list(_differences(one)):
                more = len(differences) - _SHOWN
                told = "; ".join(differences[:_SHOWN]) + (f"; {more} more" if more > 0 else "")
                problems.append(
                    f"{one.out_dir}: holds other results: {told}. "
                    "Give another folder with --out, or replace them with --overwrite"
                )
    if problems:
        raise InputError(problems)


def remove_stale(plan: Plan, written: Mapping[str, str]) -> None:
    """Remove the files of earlier results in a folder that are not among those `written` now.

    `written` are names in the folder with their checksums. What was changed since stays.
    """
    store = Store(plan.out_dir / RUNS)
    for entry in store.folder.glob(f"{FINISHED}-*.json"):
        key = entry.stem.removeprefix(f"{FINISHED}-")
        if key == plan.key():
            continue
        for name, digest in (store.load(FINISHED, key).value or {}).items():
            file = plan.out_dir / name
            with contextlib.suppress(OSError):
                if name not in written and file_digest(file) == digest:
                    file.unlink()
                    file.parent.rmdir()  # where it was the last one
        store.discard(FINISHED, key)


def _in_the_way(plan: Plan) -> Iterator[str]:
    """Complaints about folders where files shall be, and the other way round."""
    folders = [plan.out_dir / name for name in (FIGURES, RUNS)]
    for folder in (plan.out_dir, *folders):
        if folder.exists() and not folder.is_dir():
            yield f"{folder}: is a file; it must be a folder, so move it away"
    for name in (*OUTPUTS, *plan.kind.files):
        file = plan.out_dir / name
        if "." in name and file.is_dir():
            yield f"{file}: is a folder; it must be a file, so move it away"


def _differences(plan: Plan) -> Iterator[str]:
    """How the results in a plan's folder differ from what it will make; nothing without any."""
    held = _held(plan.out_dir / RESULT_FILE)
    if held is None:
        return
    if held["kind"] != plan.kind.name:
        yield f"the study {held['name']} there is of another kind ({held['kind']})"
        return
    there, here = flat(held["config"]), flat(_plain(plan.inputs.config))
    units = plan.study.units()
    same_program = held["provenance"].get("code") == code_digest()[:16]
    runs = held["config"].get("runs", {})
    for key in dict.fromkeys([*here, *there]):
        if key not in here or key not in there:
            table, _, name = key.rpartition(".")[0].partition(".")
            more = key in here and ((table == "runs" and name not in runs) or table == "compare")
            if same_program and not more:
                yield f"{key} is set only {'here' if key in here else 'there'}"
        elif here[key] != there[key] and not _more(key, here[key], there[key]):
            unit = units.get(key, "")
            yield f"{key} is {_told(there[key], unit)} there and {_told(here[key], unit)} here"
    files = held["provenance"].get("files") or {}
    for name, content in plan.inputs.files.items():
        if name in files and files[name] != content:
            yield f"the file {name} has changed"


def _more(key: str, here: Any, there: Any) -> bool:
    """Whether an axis has all the values that it had."""
    lists = isinstance(here, list) and isinstance(there, list)
    return lists and key.startswith("axes.") and all(value in here for value in there)


def _held(file: Path) -> dict[str, Any] | None:
    """Attributes of results; None where there are none, or none that can be read."""
    import h5netcdf

    try:
        with h5netcdf.File(file, "r") as data:
            found = dict(data.attrs)
        return found | {key: json.loads(found[key]) for key in ("config", "provenance")}
    except (OSError, ValueError, KeyError, TypeError, RuntimeError):
        return None


def _plain(config: Mapping[str, Any]) -> dict[str, Any]:
    """As it is read again."""
    read: dict[str, Any] = json.loads(json.dumps(config))
    return read


def _told(value: Any, unit: str) -> str:
    text = f"{value:.6g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False)
    return f"{text[:60]} {unit}".rstrip()

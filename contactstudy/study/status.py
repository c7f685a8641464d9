"""How far a study in a folder is: what is done, failed and left, and how long it will take."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from contactstudy.exceptions import InputError
from contactstudy.files import write_file
from contactstudy.plot.text import counted
from contactstudy.store import ARRAYS, Store
from contactstudy.study.axes.terminal import duration
from contactstudy.study.plan import FAILED, RUNS, Plan
from contactstudy.study.results import RESULT_FILE

PLAN_FILE = "plan.json"
"""In the folder of runs: the pieces of work of a study and its companions."""
_SHOWN = 12  # failures


def write_plan(plan: Plan, workers: int) -> None:
    """Note the pieces of work of a plan and its companions in its folder."""
    studies = []
    for one in plan.all:
        pieces = one.pieces
        number = {piece: k for k, piece in enumerate(pieces)}
        studies.append(
            {
                "folder": one.out_dir.relative_to(plan.out_dir).as_posix(),
                "plain": one.kind.form is None,
                "pieces": [
                    [p.work.name, p.key, p.label, one.kind.seconds(p.study, p.work.name)]
                    for p in pieces
                ],
                "variants": [[number[p] for p in v.pieces.values()] for v in one.variants.values()],
            }
        )
    text = json.dumps({"workers": workers, "studies": studies}) + "\n"
    write_file(plan.out_dir / RUNS / PLAN_FILE, text)


@dataclass(frozen=True)
class _Piece:
    name: str
    label: str
    done: bool
    #: Why it failed when it was tried last; "" otherwise.
    failure: str
    #: What it took, or, not done, a forecast.
    seconds: float


def status(out_dir: Path) -> list[str]:
    """Lines that say how far the study in a folder is.

    Raises
    ------
    InputError
        When no study was begun there.
    """
    path = Path(out_dir) / RUNS / PLAN_FILE
    try:
        plan = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{out_dir}: no study was begun here ({path} is missing)") from error
    pieces, variants, whole, lost = list[_Piece](), 0, 0, 0
    for study in plan["studies"]:
        own = list(_pieces(Path(out_dir) / study["folder"] / RUNS, study))
        pieces += own
        for numbers in study["variants"]:
            variants += 1
            whole += all(own[k].done for k in numbers)
            lost += any(own[k].failure and not own[k].done for k in numbers)
    left = [p for p in pieces if not p.done]
    failed = [p for p in left if p.failure]
    told = [f"runs: {len(pieces) - len(left)} of {len(pieces)} done, {len(failed)} failed"]
    if variants > len(plan["studies"]):
        told.append(f"variants: {whole} of {variants} have all their runs, {lost} failed")
    told += [f"failed: {p.failure}" for p in failed[:_SHOWN]]
    told += [f"failed: {len(failed) - _SHOWN} more"] if len(failed) > _SHOWN else []
    written = (Path(out_dir) / RESULT_FILE).is_file()
    if not left:
        ready = "results are written" if written else "results are still to be written"
        return [*told, f"nothing is left to compute; {ready}"]
    seconds = _time_left(pieces) / plan["workers"]
    long = duration(seconds)
    return [
        *told,
        f"left: {counted(len(left), 'run')}, about {long} with {plan['workers']} at a time",
    ]


def _pieces(folder: Path, study: dict[str, Any]) -> Iterator[_Piece]:
    store = Store(folder, None if study["plain"] else ARRAYS)
    for name, key, label, expected in study["pieces"]:
        about = store.about(name, key)
        if about is not None:
            yield _Piece(name, label, True, "", sum(about["seconds"].values()))
            continue
        reason = Store(folder).load(FAILED, key).value
        yield _Piece(name, label, False, "; ".join(reason or ()), float(expected))


def _time_left(pieces: list[_Piece]) -> float:
    """Seconds of what is not done: what others of the same name took, else the forecast."""
    took: dict[str, list[float]] = {}
    for piece in pieces:
        if piece.done:
            took.setdefault(piece.name, []).append(piece.seconds)
    return sum(
        sum(took[p.name]) / len(took[p.name]) if p.name in took else p.seconds
        for p in pieces
        if not p.done
    )

"""From pieces of work to tasks: which are computed together, under what names, and how."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from contactstudy.exceptions import ContactStudyError
from contactstudy.executor import Progress, Task
from contactstudy.process import peak_memory_mb
from contactstudy.study.kind import imported
from contactstudy.study.plan import Piece, Plan
from contactstudy.study.study import Study

BATCH = 64
"""Most pieces of work that are computed together."""


def groups(todo: Sequence[tuple[Plan, Piece]], workers: int) -> Iterator[list[tuple[Plan, Piece]]]:
    """Pieces that are computed together, at the place of the first of them."""
    batches: dict[tuple[int, str], list[tuple[Plan, Piece]]] = {}
    for one, piece in todo:
        if piece.work.batch and one.swept:
            batches.setdefault((id(one), piece.work.batch), []).append((one, piece))
    # some batches for each worker, so that all end at about the same time
    size = {key: min(BATCH, max(1, -(-len(own) // (2 * workers)))) for key, own in batches.items()}
    for one, piece in todo:
        if not (piece.work.batch and one.swept):
            yield [(one, piece)]
        elif own := batches.pop((id(one), piece.work.batch), None):
            step = size[id(one), piece.work.batch]
            yield from (own[k : k + step] for k in range(0, len(own), step))


class Names:
    """Gives equal tasks one name, and different ones different names."""

    def __init__(self) -> None:
        self._tasks, self._taken = dict[tuple[Any, ...], Task](), set[str]()

    def free(self, name: str) -> str:
        """A name that nothing else has."""
        made, number = name, 2
        while made in self._taken:
            made, number = f"{name} ({number})", number + 1
        self._taken.add(made)
        return made

    def tasks(self, tasks: Sequence[Task]) -> list[Task]:
        """Tasks under names of their own, also where they wait for each other; equal ones once."""
        made: dict[str, Task] = {}
        for task in tasks:
            after = tuple(made[name].name for name in task.after)
            key = (task.name, task.function, repr(task.arguments))
            if key not in self._tasks:
                self._tasks[key] = replace(task, name=self.free(task.name), after=after)
            made[task.name] = self._tasks[key]
        return list(made.values())


def execute(
    computing: str, batching: str, pieces: Sequence[tuple[Study, str]], progress: Progress
) -> list[tuple[Any, dict[str, Any]] | ContactStudyError]:
    """Compute pieces of work; the body of a worker process.

    Value and cost of each, or the error that ended it where there are several.
    """
    began = time.perf_counter()
    if len(pieces) == 1:
        ((study, name),) = pieces
        values = [imported(computing)(study, name, progress)]
    elif batching:
        values = imported(batching)(pieces, progress)
    else:
        values = [_one(imported(computing), study, name, progress) for study, name in pieces]
    each = (time.perf_counter() - began) / len(pieces)
    return [v if isinstance(v, ContactStudyError) else (v, _cost(v, each)) for v in values]


def _one(compute_one: Callable[..., Any], study: Study, name: str, progress: Progress) -> Any:
    try:
        return compute_one(study, name, progress)
    except ContactStudyError as error:
        return error


def _cost(value: Any, each: float) -> dict[str, Any]:
    attrs = getattr(value, "attrs", {"seconds_stepping": each})
    seconds = {k: float(attrs.get(f"seconds_{k}", 0.0)) for k in ("setup", "stepping")}
    return {"seconds": seconds, "peak_memory_mb": peak_memory_mb()}

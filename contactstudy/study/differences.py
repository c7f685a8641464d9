"""What is different between the results of two studies: keys, numbers, signals, provenance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from rich.table import Column, Table
from rich.text import Text

from contactstudy.study.results import StudyResults

_OF_THE_MACHINE = ("seconds", "peak_memory_mb")


@dataclass(frozen=True)
class Difference:
    """One thing that is not the same in both.

    Attributes
    ----------
    what : str
        "key", "norm", "signal" or "provenance".
    name : str
        Dotted.
    first, second : object
        What each has; None where it has no such thing. Of a signal its largest magnitude.
    relative : float
        Of numbers: the difference over the larger magnitude; of signals: the largest difference
        over the largest magnitude of the first. nan where there is no such number.
    """

    what: str
    name: str
    first: Any
    second: Any
    relative: float = float("nan")

    def beyond(self, tolerance: float) -> bool:
        """Whether it is no number, or one that is further apart than `tolerance`."""
        return not self.relative <= tolerance


def differences(first: StudyResults, second: StudyResults) -> list[Difference]:
    """All that is different, companions included; what depends on the machine is left out."""
    found = [
        *_of_values("key", first.config, second.config),
        *_of_values("norm", _numbers(first.metrics), _numbers(second.metrics)),
        *_of_signals(_datasets(first), _datasets(second)),
        *_of_values("provenance", first.provenance, second.provenance),
    ]
    theirs = {c.name: c for c in second.companions}
    for mine in first.companions:
        if mine.name in theirs:
            inner = differences(mine, theirs[mine.name])
            found += [
                Difference(d.what, f"{mine.name}: {d.name}", d.first, d.second, d.relative)
                for d in inner
            ]
    ours = {c.name for c in first.companions}
    found += [_only_one("companion", c, c in ours) for c in sorted(ours ^ set(theirs))]
    return found


def _numbers(metrics: Mapping[str, Any]) -> dict[str, Any]:
    return {
        key: _numbers(value) if isinstance(value, dict) else value
        for key, value in metrics.items()
        if key not in _OF_THE_MACHINE
    }


def _of_values(what: str, first: Any, second: Any, path: str = "") -> Iterator[Difference]:
    if isinstance(first, Mapping) and isinstance(second, Mapping):
        for key in [*first, *(key for key in second if key not in first)]:
            inner = f"{path}.{key}" if path else str(key)
            yield from _of_values(what, first.get(key), second.get(key), inner)
    elif first != second and not (_is_nan(first) and _is_nan(second)):
        yield Difference(what, path, first, second, _relative(first, second))


def _is_nan(value: Any) -> bool:
    return isinstance(value, float) and np.isnan(value)


def _relative(first: Any, second: Any) -> float:
    numbers = [v for v in (first, second) if isinstance(v, int | float) and not isinstance(v, bool)]
    if len(numbers) < 2:
        return float("nan")
    return abs(first - second) / max(abs(first), abs(second))


def _datasets(results: StudyResults) -> dict[str, xr.Dataset]:
    return {**results.groups, **results.runs}


def _of_signals(
    first: Mapping[str, xr.Dataset], second: Mapping[str, xr.Dataset]
) -> Iterator[Difference]:
    for name in [*first, *(name for name in second if name not in first)]:
        if name not in first or name not in second:
            yield _only_one("signal", name, name in first)
            continue
        a, b = first[name].variables, second[name].variables
        for variable in [*a, *(v for v in b if v not in a)]:
            full = f"{name}.{variable}"
            if variable not in a or variable not in b:
                yield _only_one("signal", full, variable in a)
            elif (d := _of_arrays(full, a[variable].values, b[variable].values)) is not None:
                yield d


def _only_one(what: str, name: str, in_first: bool) -> Difference:
    return Difference(what, name, "there" if in_first else None, None if in_first else "there")


def _of_arrays(name: str, a: np.ndarray, b: np.ndarray) -> Difference | None:
    """Both as numbers of one shape are compared by value, others by being equal."""
    if a.shape != b.shape:
        return Difference("signal", name, f"shape {a.shape}", f"shape {b.shape}")
    if not (np.issubdtype(a.dtype, np.number) and np.issubdtype(b.dtype, np.number)):
        return None if np.array_equal(a, b) else Difference("signal", name, "text", "other text")
    if np.array_equal(a, b, equal_nan=True):
        return None
    largest = [float(np.nanmax(np.abs(x), initial=0.0)) for x in (a, b)]
    apart = np.abs(a - b)[~(np.isnan(a) & np.isnan(b))]
    relative = float(np.max(apart)) / (largest[0] or largest[1])
    return Difference("signal", name, largest[0], largest[1], relative)


def table(found: Sequence[Difference], first: str, second: str, most: int) -> Table:
    """What `differences` found, for the terminal: of each sort the `most` that are furthest apart.

    What is no number comes first.
    """
    shown = Table(
        "what",
        Column("name", overflow="fold", min_width=36),
        *(Column(Text(head), overflow="fold") for head in (first, second, "relative")),
    )
    for what in dict.fromkeys(d.what for d in found):
        own = [d for d in found if d.what == what]
        own.sort(key=lambda d: -np.nan_to_num(d.relative, nan=np.inf))
        for d in own[:most]:
            relative = "" if np.isnan(d.relative) else f"{d.relative:.3g}"
            shown.add_row(what, *(Text(text) for text in (d.name, *_texts(d), relative)))
        if len(own) > most:
            shown.add_row(what, f"and {len(own) - most} more")
    return shown


def _texts(d: Difference) -> list[str]:
    return [_text(value) for value in (d.first, d.second)]


def _text(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, Mapping):
        return "there"
    return f"{value:.10g}" if isinstance(value, float) else str(value)

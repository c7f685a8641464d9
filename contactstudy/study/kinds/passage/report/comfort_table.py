"""Table of ride comfort in the cars of a passage."""

from collections.abc import Callable
from typing import Any

from contactstudy.plot.text import label, number
from contactstudy.report.blocks import Block, table
from contactstudy.study.results import StudyResults

Values = list[tuple[float, int]]
_NOTE = (
    "Of the middle of each car body, once the irregularity is faded in; the car with the largest "
    "value in brackets, counted from the front. Sperling's index of GB/T 5599; N(MV) of EN 12299 "
    "without accelerations along the track, and of less than its 5 minutes an estimate. Limits of "
    "the vertical acceleration in EN 1990, table A2.9: 1.0 m/s² very good, 1.3 good, 2.0 "
    "acceptable."
)


def comfort_table(results: StudyResults) -> list[Block]:
    """Of each run the worst car; nothing without car bodies."""
    found = results.metrics.get("comfort", {})
    if not found:
        return []
    lateral = any("Y" in car["sperling"] for run in found.values() for car in run["cars"])
    columns = ["Run", "Sperling, vertical"] + (["Sperling, lateral"] if lateral else [])
    columns += ["N(MV)", "Largest acceleration (m/s²)", "Time (s)"]
    rows = [_row(name, run, lateral) for name, run in found.items()]
    return [table(columns, rows, "Ride comfort in the cars.", 1, _NOTE)]


def _row(name: str, run: dict[str, Any], lateral: bool) -> list[str]:
    cells = [label(name), _worst(run, lambda car: car["sperling"]["Z"])]
    if lateral:
        cells.append(_worst(run, lambda car: car["sperling"].get("Y")))
    cells += [_worst(run, lambda car: car["n_mv"]), _worst(run, lambda car: car["largest"])]
    return [*cells, number(run["duration"], 3)]


def _worst(run: dict[str, Any], of: Callable[[dict[str, Any]], float | None]) -> str:
    known: Values = [
        (value, k + 1) for k, car in enumerate(run["cars"]) if (value := of(car)) is not None
    ]
    if not known:
        return "–"
    value, car = max(known)
    return f"{number(value, 3)} ({car})"

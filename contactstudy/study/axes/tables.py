"""Tables of a study with axes, as plain data for the terminal and for the report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from contactstudy.arrays import Array
from contactstudy.compare.statistics import spread
from contactstudy.plot.text import capital, label, number, resolved
from contactstudy.study.axes.axis import axis_of, title_of
from contactstudy.study.axes.convergences import OF_ORDER, Line, convergences
from contactstudy.study.axes.effects import effects, too_many
from contactstudy.study.axes.shown import Shown, drawn, shown
from contactstudy.study.results import StudyResults

_ROWS = 24


@dataclass(frozen=True)
class TableData:
    """Columns, the first `left` of them texts, and cells."""

    design: str
    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: int = 1


def tables(results: StudyResults) -> Iterator[TableData]:
    """Refinements; spreads of samples; values of small sweeps, ends of large ones."""
    found: dict[str, list[Shown]] = {}
    for quantity in shown(results):
        found.setdefault(quantity.data.attrs["design"], []).append(quantity)
    for design, quantities in found.items():
        data = quantities[0].data
        free = [d for d in quantities[0].axes if not drawn(data, d)]
        refined = data.attrs["refined"]
        if refined and data.sizes[refined] >= OF_ORDER:
            yield _refinement(design, quantities)
        elif not free:
            yield _sample(design, quantities)
        elif np.prod([data.sizes[d] for d in free]) * (len(quantities) if refined else 1) <= _ROWS:
            yield from (_values(design, quantity, free) for quantity in quantities)
        else:
            yield _ends(design, quantities, free)
            if too_many(quantities[0], free):
                yield _effects(design, quantities, free)


def _refinement(design: str, quantities: list[Shown]) -> TableData:
    data = quantities[0].data
    expected = data.attrs.get("expected_order")
    title = f"Refinement of the {title_of(data.attrs['refined'])}"
    title += f", expected order {expected:g}" if expected else ""
    title += ", no order expected" if data.attrs.get("why") and not expected else ""
    if sum(len(convergences(quantity)) for quantity in quantities) > _ROWS:
        return _widest(design, quantities, title)
    rows = [
        [
            quantity.title,
            line.name,
            _cell(line.values[-1]),
            _cell(line.limit),
            line.order_text.removeprefix("order "),
            _cell(line.uncertainty, 2),
            _cell(100.0 * line.index, 2),
            line.verdict,
        ]
        for quantity in quantities
        for line in convergences(quantity)
    ]
    columns = ["quantity", "run", "finest", "limit", "order", "band ±", "GCI (%)", "verdict"]
    return TableData(design, title, columns, rows, 2)


def _widest(design: str, quantities: list[Shown], title: str) -> TableData:
    """Of refinements at many points of other keys the widest band, and how many have a verdict."""
    rows = []
    for quantity in quantities:
        of_runs: dict[str, list[tuple[str, Line]]] = {}
        for line in convergences(quantity):
            place, _, run = line.name.rpartition(", ")
            of_runs.setdefault(run, []).append((place, line))
        for run, lines in of_runs.items():
            place, worst = max(lines, key=lambda one: np.nan_to_num(one[1].uncertainty))
            verdicts = Counter(line.verdict for _, line in lines)
            told = ", ".join(f"{n} {verdict}" for verdict, n in verdicts.items())
            cells = [_cell(worst.uncertainty, 2), place, _cell(100.0 * worst.index, 2)]
            rows.append([quantity.title, run, told, *cells])
    columns = ["quantity", "run", "verdicts", "widest band ±", "at", "GCI there (%)"]
    return TableData(design, title, columns, rows, 3)


def _sample(design: str, quantities: list[Shown]) -> TableData:
    rows = []
    for quantity in quantities:
        for run in quantity.runs:
            s = spread(quantity.of_run(run).values)
            widths = (s.half_width, s.deviation)
            if s.constant:
                cells = [_cell(s.mean, 4), "0", "0", *[_cell(s.mean, 4)] * 2]
            else:
                ends = [resolved(v, s.half_width) for v in (s.mean, s.low, s.high)]
                cells = [ends[0], *(_cell(w) for w in widths), *ends[1:]]
            rows.append([quantity.title, label(run), str(s.n), *cells])
    columns = ["quantity", "run", "samples", "mean", "± 95 %", "deviation", "least", "largest"]
    return TableData(design, "Spread over the sample", columns, rows, 2)


def _values(design: str, quantity: Shown, free: list[str]) -> TableData:
    axes = [axis_of(quantity.data, dim) for dim in free]
    means = [_mean(quantity, run, free) for run in quantity.runs]
    rows = [
        [*(a.names[k] for a, k in zip(axes, index, strict=True)), *(_cell(m[index]) for m in means)]
        for index in product(*(range(len(a.names)) for a in axes))
    ]
    columns = [*(title_of(d) for d in free), *(label(run) or "value" for run in quantity.runs)]
    return TableData(design, capital(quantity.title), columns, rows, len(free))


def _ends(design: str, quantities: list[Shown], free: list[str]) -> TableData:
    axes = [axis_of(quantities[0].data, dim) for dim in free]
    places = [", ".join(names) for names in product(*(a.names for a in axes))]
    rows = []
    for quantity in quantities:
        for run in quantity.runs:
            values = _mean(quantity, run, free).ravel()
            low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
            ends = [_cell(values[low]), places[low], _cell(values[high]), places[high]]
            rows.append([quantity.title, label(run), *ends])
    columns = ["quantity", "run", "least", "at", "largest", "at"]
    return TableData(design, "Smallest and largest values", columns, rows, 2)


def _effects(design: str, quantities: list[Shown], free: list[str]) -> TableData:
    rows = []
    for quantity in quantities:
        for run in quantity.runs:
            found = effects(quantity, run, free)
            for key in sorted(free, key=lambda k: found[k].change, reverse=True):
                names, median = axis_of(quantity.data, key).names, found[key].median
                low, high = int(np.nanargmin(median)), int(np.nanargmax(median))
                ends = [_cell(median[low]), names[low], _cell(median[high]), names[high]]
                rows.append([quantity.title, label(run), title_of(key), *ends])
    columns = ["quantity", "run", "key", "least median", "at", "largest median", "at"]
    title = "What each key changes: medians over all values of the others"
    return TableData(design, title, columns, rows, 3)


def _mean(quantity: Shown, run: str, free: list[str]) -> Array:
    over = [d for d in quantity.axes if d not in free]
    return np.asarray(quantity.of_run(run).mean(over).transpose(*free).values)


def _cell(value: float, digits: int = 3) -> str:
    return number(value, digits) if np.isfinite(value) else "–"

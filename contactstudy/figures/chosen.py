"""Signals that a user chooses from results: drawn over an abscissa, or as rows of a table."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from contactstudy.exceptions import InputError
from contactstudy.figures.signals import DECK, SIGNALS, Signal
from contactstudy.files import write_file, writing
from contactstudy.plot.style import (
    PNG_DPI,
    figure_legend,
    figure_style,
    legend_columns,
    new_figure,
    run_styles,
)
from contactstudy.plot.text import capital, pretty_unit
from contactstudy.study.results import StudyResults
from contactstudy.validation import did_you_mean

_UNDATED = {
    "png": {"Software": None},
    "svg": {"Date": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}
_TOLD_APART = 36
"""Curves of a picture: six colours with six dash patterns."""
_MOST = 1000
"""Curves of a signal."""
_SHOWN = {signal.name: signal for signal in (*SIGNALS, *DECK)}
_LARGER = {"N": ("kN", 1e-3), "1": ("", 1.0)}
"""Unit of the results -> that of a picture, and its scale; a displacement has mm."""


@dataclass(frozen=True)
class Trace:
    """A signal of a run over one abscissa; of several wheels or stations one.

    `labels` tells these apart: dimension -> coordinate.
    """

    run: str
    signal: str
    labels: dict[str, Any]
    x: np.ndarray
    values: np.ndarray
    attrs: dict[str, Any]
    abscissa: str
    abscissa_unit: str

    @property
    def label(self) -> str:
        """Of the curve."""
        told = (v if isinstance(v, str) else f"{d} {v:g}" for d, v in self.labels.items())
        return ", ".join([self.run, *told])


def traces(
    results: StudyResults, signals: Sequence[str], runs: Sequence[str], over: str = ""
) -> list[Trace]:
    """Choose signals of runs (of all without `runs`).

    `over` is a coordinate of numbers; without it the position if the run has one, else that of the
    last dimension that has one.

    Raises
    ------
    InputError
        Naming what there is instead.
    """
    known: dict[str, xr.Dataset] = {**results.runs, **results.groups}
    chosen = list(runs) or list(results.runs) or list(results.groups)
    problems = [
        f"run {name}: not in these results{did_you_mean(name, known)}; there are {', '.join(known)}"
        for name in chosen
        if name not in known
    ]
    found = list[Trace]()
    for signal in signals:
        having = [name for name in chosen if name in known and _drawable(known[name], signal)]
        if not having and not problems:
            there = dict.fromkeys(
                v for n in chosen for v in map(str, known[n].data_vars) if _drawable(known[n], v)
            )
            problems.append(
                f"signal {signal}: not in {', '.join(chosen)}{did_you_mean(signal, there)}; "
                f"there are {', '.join(there)}"
            )
        for name in having:
            found += _of_run(name, known[name], signal, over)
    abscissae = {t.signal: t.abscissa for t in found}
    if len(set(abscissae.values())) > 1:
        told = ", ".join(f"{signal} is over {name}" for signal, name in abscissae.items())
        problems.append(f"--signal: all must be over one abscissa; {told}; --over chooses one")
    if problems:
        raise InputError(problems)
    return found


def _drawable(data: xr.Dataset, signal: str) -> bool:
    """Whether it is numbers over at least one dimension with a coordinate of numbers."""
    if signal not in data.data_vars:
        return False
    return bool(np.issubdtype(data[signal].dtype, np.number) and _abscissae(data[signal]))


def _abscissae(values: xr.DataArray) -> dict[str, Any]:
    """Coordinates of numbers and their dimensions: those of the last first, a position before."""
    found: dict[str, Any] = {}
    numbers = {str(n): c for n, c in values.coords.items() if np.issubdtype(c.dtype, np.number)}
    for dim in reversed(values.dims):
        names = [n for n, c in numbers.items() if dim in c.dims and set(c.dims) <= {*values.dims}]
        for name in sorted(names, key=lambda name: (name != "position", name != dim)):
            found.setdefault(name, dim)
    return found


def _of_run(run: str, data: xr.Dataset, signal: str, over: str) -> Iterator[Trace]:
    values, names = data[signal], _abscissae(data[signal])
    if over and over not in names:
        raise InputError(f"--over {over}: {signal} of {run} is over {', '.join(names)}")
    name = over or next(iter(names))
    values = values.transpose(..., names[name])
    others = values.dims[:-1]
    count = int(np.prod([values.sizes[d] for d in others]))
    if count > _MOST:
        raise InputError(
            f"--over {name}: {signal} of {run} has {count} curves, more than {_MOST}; choose "
            f"another of {', '.join(names)}"
        )
    for place in np.ndindex(*(values.sizes[d] for d in others)):
        one = values.isel(dict(zip(others, place, strict=True)))
        labels = {
            str(d): one.coords[d].item() if d in one.coords else k + 1
            for d, k in zip(others, place, strict=True)
        }
        x = one.coords[name]
        unit = x.attrs.get("units", "")
        yield Trace(run, signal, labels, x.values, one.values, values.attrs, name, unit)


def within(found: Sequence[Trace], low: float, high: float) -> list[Trace]:
    """The part of each trace with ``low <= x <= high``, in SI; those without any are left out.

    Raises
    ------
    InputError
        If nothing is left.
    """
    cut = []
    for t in found:
        inside = (t.x >= low) & (t.x <= high)
        if inside.any():
            cut.append(replace(t, x=t.x[inside], values=t.values[inside]))
    if not cut:
        spans = [(float(t.x.min()), float(t.x.max()), t.abscissa_unit) for t in found]
        first = min(s[0] for s in spans)
        last = max(s[1] for s in spans)
        raise InputError(
            f"--x {low:g}..{high:g}: the signals reach from {first:g} to {last:g} {spans[0][2]}"
        )
    return cut


def write_traces(found: Sequence[Trace], reference: str | None, path: Path) -> None:
    """Write a picture, or with the ending .csv a table in SI units.

    Raises
    ------
    InputError
        For another ending, and more curves than a picture can tell apart.
    """
    if path.suffix == ".csv":
        write_file(path, _table(found))
        return
    if path.suffix[1:] not in _UNDATED:
        raise InputError(f"--out {path}: must end in .csv, .pdf, .png or .svg")
    found = [t for t in found if np.isfinite(t.values).any()] or found
    if (curves := len({t.label for t in found})) > _TOLD_APART:
        told = f"{curves} curves, more than the {_TOLD_APART} that a picture can tell apart"
        raise InputError(f"--out {path}: {told}; choose some, or write all of them as .csv")
    with figure_style():
        figure = _figure(found, reference)
        with writing(path) as unfinished:
            kind = path.suffix[1:]
            figure.savefig(unfinished, format=kind, dpi=PNG_DPI, metadata=_UNDATED[kind])


def _figure(found: Sequence[Trace], reference: str | None) -> Figure:
    signals = list(dict.fromkeys(t.signal for t in found))
    runs = list(dict.fromkeys(t.label for t in found))
    styles = run_styles(runs, reference)
    rows = len(runs) / legend_columns(runs)
    figure = new_figure(0.9 + 2.2 * len(signals) + 0.16 * rows)
    panels = figure.subplots(len(signals), 1, squeeze=False, sharex=True)[:, 0]
    for axes, signal in zip(panels, signals, strict=True):
        own = [t for t in found if t.signal == signal]
        shown = _shown(signal, own[0].attrs)
        # the reference is drawn last, on top
        for t in sorted(own, key=lambda t: t.run == reference):
            axes.plot(t.x, shown.scale * t.values, label=t.label, **styles[t.label].line)
        axes.set_title(own[0].attrs.get("long_name", signal.replace("_", " ")), loc="left")
        axes.set_ylabel(f"{shown.axis} ({shown.unit})" if shown.unit else shown.axis)
    # the legend is that of the first panel: it names the curves of all
    there = set(panels[0].get_legend_handles_labels()[1])
    for name in [name for name in runs if name not in there]:
        panels[0].plot([], [], label=name, **styles[name].line)
    if found[0].abscissa_unit == "Hz":
        panels[-1].set_xscale("log")
    abscissa = found[0].abscissa.replace("_", " ").capitalize()
    panels[-1].set_xlabel(f"{abscissa} ({found[0].abscissa_unit})")
    figure_legend(figure, panels[0])
    return figure


def _shown(signal: str, attrs: dict[str, Any]) -> Signal:
    """How a signal is drawn; one that the reports do not have, by what the results say of it."""
    if signal in _SHOWN:
        return _SHOWN[signal]
    text = attrs.get("long_name", signal.replace("_", " "))
    axis = capital(text.partition(" of ")[0].partition(",")[0])
    unit = attrs.get("units", "")
    larger = ("mm", 1e3) if (unit, axis) == ("m", "Displacement") else _LARGER.get(unit)
    unit, scale = larger or (pretty_unit(unit), 1.0)
    return Signal(signal, text, axis, unit, scale)


def _table(found: Sequence[Trace]) -> str:
    """A row for each run and abscissa, a column for each signal."""
    signals = list(dict.fromkeys(t.signal for t in found))
    dims = list(dict.fromkeys(d for t in found for d in t.labels))
    units = {t.signal: t.attrs.get("units", "") for t in found}
    groups: dict[tuple[Any, ...], dict[str, Trace]] = {}
    for t in found:
        groups.setdefault((t.run, *(t.labels.get(d, "") for d in dims)), {})[t.signal] = t
    out = io.StringIO()
    rows = csv.writer(out, lineterminator="\n")
    first = found[0]
    group = "group" if "run" in dims else "run"
    head = [f"{first.abscissa} ({first.abscissa_unit})", *(f"{s} ({units[s]})" for s in signals)]
    rows.writerow([group, *dims, *head])
    for key, own in groups.items():
        x = next(iter(own.values())).x
        columns = [
            [repr(float(v)) for v in own[s].values] if s in own else [""] * len(x) for s in signals
        ]
        for place, *values in zip(x, *columns, strict=True):
            rows.writerow([*key, repr(float(place)), *values])
    return out.getvalue()

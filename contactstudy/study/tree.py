"""Results as a notebook shows them: runs, their norms and units, what was measured over axes."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from contactstudy.plot.text import counted
from contactstudy.study.axes.axis import axis_of
from contactstudy.study.axes.dataset import FAILURE
from contactstudy.study.axes.tables import tables
from contactstudy.study.results import StudyResults
from contactstudy.study.study import NORMS

_TEXTS = {
    "relative_l2": ("relative L2 difference from the reference", "1"),
    "relative_l2_dynamic": ("relative L2 difference, dynamic part", "1"),
    "relative_l2_irregularity": ("relative L2 difference, part of the irregularity", "1"),
    "linf": ("largest difference from the reference", ""),
    "rms": ("root mean square of the difference", ""),
    "correlation": ("Pearson's correlation with the reference", "1"),
}
_DYNAMIC = "relative_l2_dynamic"
_SHOWN = {"relative_l2": "total (%)", _DYNAMIC: "dynamic (%)"}
_BOTH = "contact_force"
"""Of this signal both are shown, of others the dynamic part alone."""
KIND = "kind"
"""Attribute of what was measured: the kind of its study."""
_MOST = 6
"""Values of an axis that are listed."""


class ResultTree(xr.DataTree):
    """An `xarray.DataTree` whose page begins with the runs and their norms, or the variants."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        found = {str(name): node.to_dataset() for name, node in self.children.items()}
        designs = {name: data for name, data in found.items() if "design" in data.attrs}
        told = _measured(str(self.attrs.get("kind", "")), designs) if designs else ""
        title = f"<h4>{html.escape(title)}</h4>" if (title := self.attrs.get("title")) else ""
        return title + _overview(self) + told + str(super()._repr_html_())


class Measured(xr.Dataset):
    """What was measured of the variants of a design; its page begins with tables of it.

    What is left of it after a selection shows as xarray shows it.
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        kind, name = self.attrs.get(KIND, ""), self.attrs.get("design", "")
        whole = all(coord.ndim for key, coord in self.coords.items() if "." in str(key))
        shown = kind and name and whole and FAILURE in self
        return (_measured(kind, {name: self}) if shown else "") + str(super()._repr_html_())


def norms(
    comparisons: Mapping[str, Mapping[str, Any]], runs: Mapping[str, xr.Dataset]
) -> dict[str, xr.Dataset]:
    """The group `NORMS` of compared runs: run -> signal -> norm -> value; none without any.

    Norms are over (run, signal), nan where there is none; ``unit`` is that of the signal, in which
    those are that have no own.
    """
    signals = list(dict.fromkeys(s for own in comparisons.values() for s in own))
    if not signals:
        return {}
    data = xr.Dataset(coords={"run": list(comparisons), "signal": signals})
    for name, (text, unit) in _TEXTS.items():
        found = [
            [np.nan if (v := own.get(s, {}).get(name)) is None else v for s in signals]
            for own in comparisons.values()
        ]
        if np.isfinite(found).any():
            attrs = {"long_name": text} | ({"units": unit} if unit else {})
            data[name] = (("run", "signal"), np.array(found, dtype=float), attrs)
    having = [next((r[s] for r in runs.values() if s in r), None) for s in signals]
    units = ["" if one is None else str(one.attrs.get("units", "")) for one in having]
    return {NORMS: data.assign_coords(unit=("signal", units))}


def _overview(tree: xr.DataTree) -> str:
    """Runs with their norms, and signals with their units, as tables; "" without runs."""
    runs = {n: node for n, node in tree.children.items() if "solver" in node.attrs}
    if not runs:
        return ""
    found = tree.children[NORMS].to_dataset() if NORMS in tree.children else xr.Dataset()
    signals = found["signal"].values.tolist() if "signal" in found else []
    shown = [
        (s, n) for s in signals for n in _SHOWN if n in found and (s == _BOTH or n == _DYNAMIC)
    ]
    heads = ["run", "solver", "rail", *(f"{_words(s)}, {_SHOWN[norm]}" for s, norm in shown)]
    rows = []
    for name, node in runs.items():
        own = [name, *(str(node.attrs.get(key, "")) for key in heads[1:3])]
        for signal, norm in shown:
            value = _norm(found, name, signal, norm)
            reference = name == tree.attrs.get("reference")
            own.append("reference" if reference else f"{100 * value:.3g}".replace("nan", "–"))
        rows.append(own)
    units = {
        str(v): a.attrs["units"]
        for n in runs.values()
        for v, a in n.data_vars.items()
        if "time" in a.dims and "units" in a.attrs
    }
    histories = ", ".join(f"{name} ({unit})" for name, unit in units.items())
    told = f"<p>Histories: {html.escape(histories)}</p>" if histories else ""
    return _table(heads, rows) + told


def _measured(kind: str, designs: Mapping[str, xr.Dataset]) -> str:
    """Of each design how many variants there are, over which keys; and its tables."""
    parts = []
    for name, data in designs.items():
        failed = int((data[FAILURE] != "").sum())
        axes = "; ".join(_values(data, str(dim)) for dim in data["variant"].dims)
        told = f"{name}: {counted(data['variant'].size, 'variant')} over {axes}"
        parts.append(f"<p>{html.escape(told)}{f'; {failed} failed' if failed else ''}</p>")
    results = StudyResults("", "", "", {}, {}, {}, None, {}, kind=kind, groups=designs)
    for made in tables(results):
        parts.append(f"<p><b>{html.escape(made.title)}</b></p>{_table(made.columns, made.rows)}")
    return "".join(parts)


def _values(data: xr.Dataset, dim: str) -> str:
    """An axis, and its values or its ends."""
    axis = axis_of(data, dim)
    few = len(axis.names) <= _MOST
    told = ", ".join(axis.names) if few else f"{axis.names[0]} ... {axis.names[-1]}"
    return f"{axis.title.partition(' (')[0]} ({told})"


def _norm(found: xr.Dataset, run: str, signal: str, norm: str) -> float:
    if run not in found["run"].values:
        return float("nan")
    return float(found[norm].sel(run=run, signal=signal))


def _words(name: str) -> str:
    return name.replace("_", " ")


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [f"<th>{html.escape(head)}</th>" for head in heads]
    body = "".join(
        f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>" for row in rows
    )
    return f"<table><thead><tr>{''.join(lines)}</tr></thead><tbody>{body}</tbody></table>"

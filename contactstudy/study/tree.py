"""Results as one tree that shows, where pages can be shown, its runs, their norms and units."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

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


class ResultTree(xr.DataTree):
    """An `xarray.DataTree` whose page begins with the runs and their norms."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        return _overview(self) + str(super()._repr_html_())


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
    title = html.escape(str(tree.attrs.get("title", "")))
    return f"<h4>{title}</h4>{_table(heads, rows)}{told}"


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

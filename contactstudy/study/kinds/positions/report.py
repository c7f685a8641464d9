"""Report of a study of positions: every patch, and its course over the lateral shift."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contactstudy.files import writing
from contactstudy.plot.curves import Curve, Plot, curve
from contactstudy.plot.draw import draw
from contactstudy.plot.style import figure_style, save
from contactstudy.plot.text import label, number
from contactstudy.report.quantity import fixed, quantity
from contactstudy.report.tables import Block, table, text
from contactstudy.report.typesetting import typeset
from contactstudy.study.kinds.positions.terminal import COLUMNS

if TYPE_CHECKING:
    import xarray as xr

_DRAWN = ("y", "approach", "peak_pressure", "area")
_LABELS = {
    "y": ("Contact position", "Contact position on the rail (mm)"),
    "approach": ("Approach", "Approach (µm)"),
    "peak_pressure": ("Peak pressure", "Peak pressure (MPa)"),
    "area": ("Contact area", "Contact area (mm²)"),
}
_METHOD = (
    "A rigid-body position of the wheelset places both wheels; each wheel is then pressed straight "
    "down on its rail until the vertical force is reached. Both bodies are elastic half-spaces, "
    "the gap is the signed distance of the smooth surfaces along the rail's normal, contact is "
    "frictionless, and every patch is found and solved by itself. The contact position is the "
    "centroid of the overlap of the undeformed bodies, weighted with the square of its depth; the "
    "approach is the largest overlap; the area counts the cells under pressure."
)


def write_positions(data: xr.Dataset, out_dir: Path) -> Path:
    """Set out_dir/report.pdf; its figures go into out_dir/figures.

    Parameters
    ----------
    data : xarray.Dataset
        Of `contactstudy.study.kinds.positions.run.run_positions`.
    out_dir : Path
    """
    figures = {f"positions_{name}": _plot(data, name) for name in _DRAWN}
    with tempfile.TemporaryDirectory() as folder, writing(out_dir / "report.pdf") as path:
        root = Path(folder)
        (root / "figures").mkdir()
        with figure_style():
            for name, plot in figures.items():
                pdf, _ = save(draw(plot), out_dir / "figures", name)
                (root / "figures" / f"{name}.pdf").write_bytes(pdf.read_bytes())
        path.write_bytes(typeset(root, ("sections.typ",), _content(data, figures)))
    return out_dir / "report.pdf"


def _content(data: xr.Dataset, figures: dict[str, Plot]) -> dict[str, Any]:
    provenance = json.loads(data.attrs["provenance"])
    versions = ", ".join(f"{k} {v}" for k, v in provenance["versions"].items())
    description = [" ".join(p.split()) for p in data.attrs["description"].split("\n\n")]
    sides = list(dict.fromkeys(data.wheel.values.tolist()))
    return {
        "title": data.attrs["title"],
        "subtitle": f"Study {label(data.attrs['name'])} · contactstudy "
        f"{provenance['versions']['contactstudy']}",
        "name": data.attrs["name"],
        "summary": [text(p.replace("`", "“", 1).replace("`", "”", 1)) for p in description if p]
        + [text(_METHOD), _parameters(data)],
        "cases": [
            *({"title": f"{s.capitalize()} wheel", "blocks": [_patches(data, s)]} for s in sides),
            {
                "title": "Over the lateral shift",
                "blocks": [
                    {"kind": "figure", "file": f"{name}.pdf", "caption": plot.caption}
                    for name, plot in figures.items()
                ],
            },
        ],
        "provenance": [
            {
                "kind": "list",
                "items": [
                    f"Versions: {versions}.",
                    f"Hash of all inputs and of the program: {provenance['hash']}.",
                ],
            }
        ],
    }


def _parameters(data: xr.Dataset) -> Block:
    config, units = json.loads(data.attrs["config"]), json.loads(data.attrs["units"])
    rows = []
    for key, value in config.items():
        if isinstance(value, list) and len(value) > 4:
            ends = [quantity(v, units.get(key, ""))[0] for v in (value[0], value[-1])]
            shown = f"{len(value)} values, {ends[0]} … {ends[1]}"
            rows.append([label(key), shown, units.get(key, "")])
        else:
            rows.append([label(key), *quantity(value, units.get(key, ""))])
    return table(["Parameter", "Value", "Unit"], rows, "Parameters.", 3)


def _patches(data: xr.Dataset, side: str) -> Block:
    own = data.isel(row=data.wheel.values == side)
    headings = [h.rpartition(" ") for h, _, _ in COLUMNS.values()]
    columns = [f"{words} ({unit})" if words else unit for words, _, unit in headings]
    rows = [
        [fixed(scale * float(own[name].values[k]), decimals)
         for name, (_, scale, decimals) in COLUMNS.items()]
        for k in range(own.sizes["row"])
    ]  # fmt: skip
    caption = "Contact patches; y is the contact position on the rail, positive to the field side."
    made = table(columns, rows, caption, 0)
    return made | {"size": 8}


def _plot(data: xr.Dataset, name: str) -> Plot:
    words, axis = _LABELS[name]
    scale = COLUMNS[name][1]
    curves: list[Curve] = []
    for side in dict.fromkeys(data.wheel.values.tolist()):
        for first in (True, False):
            chosen = (data.wheel.values == side) & ((data.patch.values == 1) == first)
            if chosen.any():
                x, y = 1e3 * data.lateral.values[chosen], scale * data[name].values[chosen]
                if first:
                    curves.append(curve(f"{side} wheel", x, y, "both"))
                else:
                    curves.append(curve(f"{side} wheel, further patches", x, y, "points"))
    low, high = scale * float(np.min(data[name])), scale * float(np.max(data[name]))
    return Plot(
        f"{words} over the lateral shift of the wheelset, from "
        f"{number(low, 4)} to {number(high, 4)}.",
        "Lateral shift (mm)",
        axis,
        tuple(curves),
    )

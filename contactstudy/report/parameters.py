"""Tables of the resolved parameters of a study."""

import math
from typing import Any

from contactstudy.plot.text import exact
from contactstudy.report.blocks import Block, table
from contactstudy.report.quantity import quantity
from contactstudy.study.kind import find_kind
from contactstudy.study.results import StudyResults
from contactstudy.validation import Entry, entries

_SLOPES = ("rail_inclination",)
"""Angles that are given as slopes."""
_LONG = 8  # values of a list
_NAMES = {
    "from": "wheel from",
    "to": "wheel to",
    "spacing": "support spacing",
    "roughness": "roughness Aᵣ",
    "omega_1": "ω₁",
    "omega_2": "ω₂",
    "terms": "number of terms N",
    "jitter": "jittered wavenumbers",
    "band": "wavenumber band",
    "fade_in": "fade-in length",
    "layer": "layer below",
    "static_load": "static load",
    "pressure_at": "pressure fields at",
    "animation_frames": "frames of the animation",
    "animation_span": "animation between",
}


def parameter_tables(results: StudyResults) -> list[Block]:
    """One table for each table of the resolved study that its kind has a title for."""
    kind, made = find_kind(results.kind), []
    varied = {str(k) for d in results.designs.values() if not d.attrs["refined"] for k in d.coords}
    for section, title in kind.titles.items():
        if values := results.config.get(section):
            known, rows = entries(kind.tables[section]), []
            for key, value in values.items():
                shown, unit = _shown(value, results.units.get(f"{section}.{key}", ""))
                if key in _SLOPES and value:
                    shown, unit = f"1:{exact(1.0 / math.tan(value))}", ""
                given_by = origin(known.get(key), value)
                if f"{section}.{key}" in varied:
                    shown, unit, given_by = "varied", "", "study"
                name = _NAMES.get(key, key.replace("_", " "))
                name = name.replace("youngs", "Young's").replace("poisson ", "Poisson's ")
                rows.append([name, shown, unit, given_by])
            columns = ["Parameter", "Value", "Unit", "Given by"]
            made.append(table(columns, rows, f"{title}.", 1) | {"size": 8.5})
            made[-1]["columns"][2]["align"] = made[-1]["columns"][3]["align"] = "left"
    return made


def _shown(value: Any, unit: str) -> tuple[str, str]:
    """Value and unit; of a long list its ends."""
    if isinstance(value, list) and len(value) > _LONG:
        ends, unit = quantity([value[0], value[-1]], unit)
        return f"{len(value)} values, {ends.replace(', ', ' … ')}", unit
    return quantity(value, unit)


def origin(entry: Entry | None, value: Any) -> str:
    """Whether a value is the program's default or was set by the study."""
    parameter = entry.parameter if entry else None
    if parameter is None:
        return "study"
    defaults = parameter.by.defaults.values() if parameter.by else [parameter.default]
    return "default" if any(_equal(default, value) for default in defaults) else "study"


def _equal(default: Any, value: Any) -> bool:
    """Equality up to the rounding that the conversion of a unit leaves."""
    if isinstance(default, tuple) and isinstance(value, list | tuple):
        pairs = zip(default, value, strict=False)
        return len(default) == len(value) and all(_equal(d, v) for d, v in pairs)
    if isinstance(default, float) and isinstance(value, int | float):
        return math.isclose(default, value, rel_tol=1e-12)
    return bool(default == value)

"""Tables of the resolved parameters of a study."""

import math
from typing import Any

from contactstudy.report.quantity import quantity
from contactstudy.report.tables import Block, table
from contactstudy.study.kinds.passage.schema import SECTIONS
from contactstudy.study.results import StudyResults
from contactstudy.validation import entries

_TITLES = {
    "irregularity": "Irregularity",
    "track": "Track (per rail)",
    "vehicle": "Vehicle (per wheel)",
    "journey": "Journey",
    "solid": "Solid rail and wheel",
}
_NAMES = {
    "from": "wheel from",
    "to": "wheel to",
    "spacing": "support spacing",
    "roughness": "roughness Aᵣ",
    "omega_1": "ω₁",
    "omega_2": "ω₂",
    "terms": "number of terms N",
    "jitter": "jittered wavenumbers",
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "band": "wavenumber band",
    "fade_in": "fade-in length",
    "layer": "layer below",
    "static_load": "static load",
    "pressure_at": "pressure fields at",
    "animation_frames": "frames of the animation",
    "animation_span": "animation between",
}


def parameter_tables(results: StudyResults) -> list[Block]:
    """One table for each part of the resolved study except its runs."""
    made = []
    for section, title in _TITLES.items():
        values = results.config.get(section)
        if values:
            rows = [_parameter(results, section, key, value) for key, value in values.items()]
            made.append(
                table(
                    ["Parameter", "Value", "Unit", "Given by"],
                    [[r[0], r[1], r[2], r[3]] for r in rows],
                    f"{title}.",
                )
                | {"size": 8.5}
            )
            made[-1]["columns"][2]["align"] = made[-1]["columns"][3]["align"] = "left"
    return made


def _parameter(results: StudyResults, section: str, key: str, value: Any) -> list[str]:
    shown, unit = quantity(value, results.units.get(f"{section}.{key}", ""))
    return [_NAMES.get(key, key.replace("_", " ")), shown, unit, _origin(section, key, value)]


def _origin(section: str, key: str, value: Any) -> str:
    """Whether a value is the program's default or was set by the study."""
    parameter = entries(SECTIONS[section])[key].parameter
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
